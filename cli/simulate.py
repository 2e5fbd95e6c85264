"""`lacuna simulate`: one run of one model."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated, Any, Literal

from rich.markup import escape
from rich.table import Table
import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import (
    AllowExternal,
    ClassName,
    Data,
    Hold,
    Inputs,
    Libraries,
    Model,
    Parameters,
    Signals,
    Units,
    default_folder,
    inputs,
    parameters,
)
from lacuna.cli.progress import progress
from lacuna.cli.watch import Port, Watch, watched
from lacuna.texts import file_name

Solver = Literal["ida", "dopri5", "rodas4", "rk4", "euler"]
By = Annotated[Solver, typer.Option(help="ida: reference; dopri5, rodas4: fast; rk4, euler: fixed step")]
Format = Literal["csv", "parquet", "mat"]
Interval = Annotated[
    float | None, typer.Option(help="Output interval, s; default: the model's experiment, else 500 points")
]


@answered
def simulate(
    model: Model,
    class_name: ClassName = "",
    library: Libraries = None,
    solver: By = "ida",
    rtol: Annotated[float | None, typer.Option(help="Relative tolerance; default: the model's experiment")] = None,
    atol: Annotated[float | None, typer.Option(help="Absolute tolerance per nominal value; default: 0.01 rtol")] = None,
    step: Annotated[float | None, typer.Option(help="Fixed step of rk4 and euler, s")] = None,
    start: Annotated[float | None, typer.Option(help="Start time, s; default: the model's experiment")] = None,
    stop: Annotated[float | None, typer.Option(help="Stop time, s; default: the model's experiment")] = None,
    interval: Interval = None,
    locate_events: Annotated[bool, typer.Option(help="Find events inside a step, or take them at its end")] = True,
    event_rows: Annotated[bool, typer.Option(help="Add a row before and a row after each event")] = False,
    parameter: Parameters = None,
    units: Units = "error",
    data: Data = None,
    allow_external: AllowExternal = False,
    input: Inputs = None,
    hold: Hold = False,
    signal: Signals = None,
    format: Annotated[Format, typer.Option(help="csv; parquet: large results; mat: MATLAB and Modelica tools")] = "csv",
    out: Annotated[Path | None, typer.Option(help="Folder for the result; default: out/simulate/MODEL")] = None,
    plot: Annotated[bool, typer.Option("--plot", help="Draw the recorded signals as SVG beside the file")] = False,
    watch: Watch = False,
    port: Port = 0,
) -> Answer:
    """Simulate MODEL and write its trajectories with a .meta.json beside them.

    A run that fails keeps its results so far, marked incomplete, says why with time, equation and source line, and
    ends with status 1.

    [bold]Example[/bold]: lacuna simulate Actuators.EccentricBldc -p zeta=0.3 --signal rotor.w --plot
    """
    loading: dict[str, Any] = {
        "class_name": class_name, "libraries": library or [], "parameters": parameters(parameter), "units": units,
        "data": data or [], "allow_external": allow_external,
    }  # fmt: skip
    running: dict[str, Any] = {
        "solver": solver, "inputs": inputs(input, hold), "start": start, "stop": stop, "rtol": rtol, "atol": atol,
        "step": step, "locate_events": locate_events, "interval": interval, "outputs": signal, "event_rows": event_rows,
    }  # fmt: skip
    if watch:
        return watched(partial(_drawn, model, loading, running), model, library or [], port)
    loaded = lacuna.load(model, **loading)
    result, failure = _run(loaded, **running)
    folder = out or default_folder("simulate", class_name or model)
    written = result.save(folder / f"{file_name(result.model)}.{format}")
    written += result.save_plot(written[0].with_suffix(".svg"), *(signal or [])) if plot else []
    return Answer(_data(result), [_table(result, solver)], written, loaded.warnings + result.warnings, failure)


def _drawn(model: str, loading: dict[str, Any], running: dict[str, Any]) -> Any:
    """The figure of a run of the model as it is now."""
    return lacuna.load(model, **loading).simulate(**running).plot(*(running["outputs"] or []))


def _run(model: lacuna.Model, **settings: Any) -> tuple[lacuna.Result, str]:
    """The result and, of a run that ended early, why."""
    try:
        with progress() as tell:
            return model.simulate(**settings, progress=tell), ""
    except lacuna.IncompleteRun as ended:
        if not len(ended.result):  # refused before its first row
            raise
        return ended.result, str(ended)


def _data(result: lacuna.Result) -> dict[str, object]:
    return {
        "model": result.model, "complete": result.complete, "terminated": result.terminated,
        "seconds": result.seconds, "rows": len(result),
        "counters": result.counters, "last": {name: float(result[name][-1]) for name in ("time", *result)},
    }  # fmt: skip


def _table(result: lacuna.Result, solver: str) -> Table:
    table = Table(show_header=False)
    covered = float(result.time[-1] - result.time[0])
    table.add_row("time covered", f"{covered:g} s in {result.seconds:.3f} s of computing with {solver}")
    if result.terminated is not None:
        table.add_row("ended by the model", f"{escape(result.terminated)}, at time {float(result.time[-1]):g} s")
    for name, count in result.counters.items():
        table.add_row(name.replace("_", " "), f"{count}")
    return table
