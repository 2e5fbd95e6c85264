"""`lacuna compare`: variable step against fixed step, or a model against a file from elsewhere."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from rich.console import Console
from rich.table import Table
import typer

from lacuna.cli.errors import UserError, nearest, reported
from lacuna.cli.options import MODEL_HELP, Assignments, assignments, default_folder, number
from lacuna.cli.output import console

if TYPE_CHECKING:
    from lacuna import runtime
    from lacuna.analysis.comparison.scenarios import Scenario
    from lacuna.analysis.comparison.study import Study

OWN_REFERENCE = 1e-10  # relative tolerance of the reference run of a user's model; tighter may be below its rounding


@reported
def compare(
    model: Annotated[str | None, typer.Argument(metavar="[MODEL]", help=MODEL_HELP)] = None,
    against: Annotated[Path | None, typer.Option(help="A CSV produced elsewhere; header: time and full names")] = None,
    tolerance: Annotated[float, typer.Option(help="Largest deviation from the file, of a signal's magnitude")] = 1e-3,
    only: Annotated[list[str] | None, typer.Option(help="Only this scenario; repeat for more")] = None,
    scenarios: Annotated[Path | None, typer.Option(help="Scenarios of your own, a TOML file")] = None,
    step: Annotated[list[float] | None, typer.Option(help="Fixed steps to try on MODEL, s; repeat for more")] = None,
    stop: Annotated[float | None, typer.Option(help="Stop time on MODEL, s")] = None,
    parameter: Assignments = None,
    out: Annotated[Path | None, typer.Option(help="Folder for tables, figures and report.html")] = None,
) -> None:
    """Compare solvers on the scenarios of the project, on MODEL, or MODEL with a file (--against).

    Deviation of every signal, of event times, observed order of convergence, work and time; as a table, CSV, figures
    and one report. With --against the exit status is 1 where a signal deviates by more than --tolerance.
    """
    if against:
        if model is None:
            raise UserError("--against needs a MODEL to compare the file with")
        _with_file(model, against, tolerance, parameter)
        return
    from lacuna.analysis.comparison.compare import compare_lanes
    from lacuna.analysis.comparison.report import findings

    chosen = [_own(model, step, stop, parameter)] if model else _chosen(scenarios, only)
    folder = out or (default_folder("compare", model) if model else Path("out/compare"))
    with Console(stderr=True).status("comparing") as status:
        studies = compare_lanes(chosen, _compiled, folder, lambda s, lane: status.update(f"{s.name}: {lane.label}"))
    for study in studies:
        console().print(_lanes(study))
    for text in findings(studies):
        typer.echo(text)
    typer.echo(f"written: {folder}")


def _compiled(name: str) -> runtime.Model:
    from lacuna.codegen.compile import compile_model
    from lacuna.runtime import Model

    return Model(compile_model(name).path)


def _chosen(file: Path | None, names: list[str] | None) -> list[Scenario]:
    from lacuna.analysis.comparison.scenarios import DEFAULT_FILE, load

    known = {scenario.name: scenario for scenario in load(file or DEFAULT_FILE)}
    for name in names or []:
        if name not in known:
            raise UserError(f"there is no scenario {name}{nearest(name, known)}")
    return [known[name] for name in names or known]


def _own(model: str, steps: list[float] | None, stop: float | None, parameter: list[str] | None) -> Scenario:
    """MODEL as a scenario: its experiment, its states in the overlay, steps from the output interval downwards."""
    from lacuna.analysis.comparison.scenarios import Scenario

    loaded = _compiled(model)
    end = stop or loaded.stop_time
    interval = loaded.interval or end / 1000
    values = {name: number(name, text) for name, text in assignments(parameter).items()}
    steps = steps or [interval / k for k in (1, 2, 4)]
    name, shown = loaded.name.rsplit(".", 1)[-1], tuple(loaded.states)[:4]
    return Scenario(name, loaded.name, model, end, interval, tuple(steps), shown, values, reference_rtol=OWN_REFERENCE)


def _lanes(study: Study) -> Table:
    from lacuna.analysis.comparison.report import order_text

    table = Table(title=f"{study.scenario.name}: {study.scenario.title}", title_justify="left")
    table.add_column("solver")
    for column in ("largest deviation", "event times, s", "events without partner", "order", "steps", "ms"):
        table.add_column(column, justify="right")
    for result in study.lanes:
        order = order_text(study, result.lane.family) if result.lane.step else ""
        table.add_row(
            result.lane.label, result.failure or f"{result.error:.1e}", f"{result.events.maximum:.1e}",
            str(result.events.unmatched), order, str(result.counters["steps"]),
            f"{1e3 * result.seconds:.1f}",
        )  # fmt: skip
    return table


def _with_file(model: str, file: Path, tolerance: float, parameter: list[str] | None) -> None:
    from lacuna import runtime
    from lacuna.analysis.comparison.compare import compare_with_file, read_columns

    loaded = _compiled(model)
    time, columns = read_columns(file)
    values = {name: number(name, text) for name, text in assignments(parameter).items()}
    result = runtime.simulate(
        loaded, parameters=values, start=time[0], stop=time[-1], output_times=time, outputs=list(columns), events=False
    )
    deviations = compare_with_file(result, time, columns)
    table = Table(title=f"{loaded.name} and {file}", title_justify="left")
    for column in ("signal", "largest deviation", "RMS", "of its magnitude", "at, s"):
        table.add_column(column, justify="left" if column == "signal" else "right")
    for d in deviations:
        table.add_row(d.name, f"{d.maximum:.3e}", f"{d.rms:.3e}", f"{d.relative:.3e}", f"{d.at_time:g}")
    console().print(table)
    beyond = [d.name for d in deviations if not d.relative <= tolerance]
    if beyond:
        raise UserError(f"beyond the tolerance of {tolerance:g}: {', '.join(beyond)}")
