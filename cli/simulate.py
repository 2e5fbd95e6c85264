"""`lacuna simulate`: one run of one model."""

from __future__ import annotations

from pathlib import Path
import time
from typing import TYPE_CHECKING, Annotated, Literal

from rich.table import Table
import typer

from lacuna.cli.errors import UserError, nearest, reported
from lacuna.cli.options import Assignments, Model, Units, assignments, default_folder, number
from lacuna.cli.output import console

if TYPE_CHECKING:
    from lacuna import runtime

Solver = Literal["ida", "dopri5", "rodas4", "rk4", "euler"]
Inputs = Annotated[
    list[str] | None,
    typer.Option("--input", "-u", metavar="NAME=FILE.csv[:COLUMN]", help="Drive an input by a recorded column (SI)"),
]


@reported
def simulate(
    model: Model,
    solver: Annotated[
        Solver, typer.Option(help="ida: reference; dopri5, rodas4: fast; rk4, euler: fixed step")
    ] = "ida",
    rtol: Annotated[float | None, typer.Option(help="Relative tolerance; default: the model's experiment")] = None,
    atol: Annotated[float | None, typer.Option(help="Absolute tolerance per nominal value; default: 0.01 rtol")] = None,
    step: Annotated[float | None, typer.Option(help="Fixed step of rk4 and euler, s")] = None,
    start: Annotated[float | None, typer.Option(help="Start time, s; default: the model's experiment")] = None,
    stop: Annotated[float | None, typer.Option(help="Stop time, s; default: the model's experiment")] = None,
    interval: Annotated[float | None, typer.Option(help="Output interval, s; default: the model's experiment")] = None,
    locate_events: Annotated[bool, typer.Option(help="Find events inside a step, or take them at its end")] = True,
    event_rows: Annotated[bool, typer.Option(help="Add a row before and a row after each event")] = True,
    parameter: Assignments = None,
    units: Units = "error",
    inputs: Inputs = None,
    hold: Annotated[bool, typer.Option("--hold", help="Hold recorded inputs between samples, not linear")] = False,
    signal: Annotated[list[str] | None, typer.Option(help="Record only these variables; repeat for more")] = None,
    out: Annotated[Path | None, typer.Option(help="Folder for the result; default: out/simulate/MODEL")] = None,
    plot: Annotated[bool, typer.Option("--plot", help="Draw the recorded signals as SVG beside the CSV")] = False,
) -> None:
    """Simulate MODEL and write its trajectories as CSV with a .meta.json beside it.

    A run that fails keeps its results so far, marked incomplete, says why with time, equation and source line, and
    ends with status 1.

    [bold]Example[/bold]: lacuna simulate Actuators.EccentricBldc -p zeta=0.3 --signal rotor.w --plot
    """
    from lacuna import runtime

    settings = assignments(parameter)
    loaded = _compiled(model, settings, units)
    values = {name: number(name, text) for name, text in settings.items() if loaded.variable(name).settable}
    begin = time.perf_counter()
    result = runtime.simulate(
        loaded, solver=solver, parameters=values, inputs=_recorded(inputs, hold), start=start, stop=stop,
        rtol=rtol, atol=atol, step=step, locate_events=locate_events, interval=interval, outputs=signal,
        events=event_rows,
    )  # fmt: skip
    seconds = time.perf_counter() - begin
    path = _destination(result, loaded, out or default_folder("simulate", model))
    written = [runtime.write_csv(result, path)]
    if plot:
        from lacuna.cli.plot import draw

        written.append(draw(result, signal, path.with_suffix(".svg")))
    _report(result, seconds, solver, written)
    if not result.complete:
        raise UserError(str(result.failure))


def _compiled(model: str, settings: dict[str, str], units: str) -> runtime.Model:
    """The model, translated anew where a parameter that decides its structure is among `settings`."""
    from lacuna import runtime
    from lacuna.codegen.compile import compile_model

    loaded = runtime.Model(compile_model(model, units=units).path)
    parameters = {name: v for name, v in loaded.variables.items() if v.kind == "parameter"}
    fixed = {
        name: number(name, text)
        for name, text in settings.items()
        if not loaded.variable(name, "parameter", parameters).settable
    }
    return runtime.Model(compile_model(model, modifications=fixed, units=units).path) if fixed else loaded


def _destination(result: runtime.Result, model: runtime.Model, folder: Path) -> Path:
    """The file for a result. A run that was refused before its first row gets none."""
    if not len(result):
        raise UserError(str(result.failure))
    return folder / f"{model.name.rsplit('.', 1)[-1]}.csv"


def _recorded(inputs: list[str] | None, hold: bool) -> dict[str, runtime.RecordedInput]:
    from lacuna.runtime import RecordedInput, read_csv

    recorded = {}
    for name, text in assignments(inputs, "--input").items():
        file, _, column = text.partition(":")
        columns, _ = read_csv(file)
        column = column or name
        if column not in columns:
            raise UserError(f"{file} has no column called {column}{nearest(column, columns)}")
        recorded[name] = RecordedInput(columns["time"], columns[column], "hold" if hold else "linear")
    return recorded


def _report(result: runtime.Result, seconds: float, solver: str, written: list[Path]) -> None:
    table = Table(show_header=False)
    covered = result.time[-1] - result.time[0] if len(result) else 0.0
    table.add_row("time covered", f"{covered:g} s in {seconds:.3f} s of computing with {solver}")
    for name, count in result.counters.items():
        table.add_row(name.replace("_", " "), f"{count}")
    for path in written:
        table.add_row("written", str(path))
    console().print(table)
