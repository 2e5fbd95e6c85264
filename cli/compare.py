"""`lacuna compare`: variable-step against fixed-step lanes, or a model against another tool's file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from rich.console import Console
from rich.table import Table
import typer

from cli.errors import UserError, reported
from cli.options import MODEL_HELP, Assignments, assignments, default_folder, number

if TYPE_CHECKING:
    from analysis.comparison.scenarios import Scenario
    from analysis.comparison.study import Study
    import runtime


@reported
def compare(
    model: Annotated[str | None, typer.Argument(metavar="[MODEL]", help=MODEL_HELP)] = None,
    against: Annotated[Path | None, typer.Option(help="CSV of another tool: time first, columns by full name")] = None,
    tolerance: Annotated[float, typer.Option(help="With --against: largest allowed relative deviation")] = 1e-3,
    scenarios: Annotated[Path | None, typer.Option(help="Scenario file (TOML); default: the project's own")] = None,
    only: Annotated[list[str] | None, typer.Option(help="Only this scenario; repeat for more")] = None,
    steps: Annotated[str, typer.Option(help="With MODEL: fixed steps in s, coarse to fine")] = "1e-4,5e-5,2.5e-5",
    stop: Annotated[float | None, typer.Option(help="With MODEL: stop time, s")] = None,
    signal: Annotated[list[str] | None, typer.Option(help="With MODEL: signals to draw; repeat for more")] = None,
    parameter: Assignments = None,
    out: Annotated[Path | None, typer.Option(help="Folder for CSV, figures and report")] = None,
) -> None:
    """Compare solvers on all scenarios (no MODEL), on MODEL, or MODEL with a file made elsewhere (--against).

    Every signal of every run is set against IDA at a tight tolerance: deviations, event times, observed order of
    convergence, work. With --against the status is 1 when a column deviates by more than the tolerance.

    [bold]Example[/bold]: lacuna compare MyModel.mo --against simulink.csv --tolerance 1e-3
    """
    if against and not model:
        raise UserError("--against needs a MODEL to compare the file with")
    if model and against:
        _against(model, against, tolerance, parameter)
    else:
        chosen = [_own(model, steps, stop, signal, parameter)] if model else _project_scenarios(scenarios, only or [])
        _lanes(chosen, out or (default_folder("compare", model) if model else Path("out/compare")))


def _project_scenarios(file: Path | None, only: list[str]) -> list[Scenario]:
    from analysis.comparison.scenarios import DEFAULT_FILE, load

    known = load(file or DEFAULT_FILE)
    unknown = sorted(set(only) - {s.name for s in known})
    if unknown:
        raise UserError(f"no scenario called {', '.join(unknown)}; there are {', '.join(s.name for s in known)}")
    return [s for s in known if not only or s.name in only]


def _lanes(scenarios: list[Scenario], folder: Path) -> None:
    from analysis.comparison.compare import compare_lanes

    console = Console(stderr=True)
    with console.status("starting") as status:
        studies = compare_lanes(scenarios, _compiled, folder, lambda s, lane: status.update(f"{s.title}: {lane.label}"))
    for study in studies:
        Console().print(_table(study))
    typer.echo(f"wrote {folder / 'report.html'} and {folder / 'deviations.csv'}")
    failed = [f"{s.scenario.name}: {s.reference.failure}" for s in studies if s.reference.failure]
    if failed:
        raise UserError("\n".join(failed))


def _compiled(name: str) -> runtime.Model:
    from codegen.compile import compile_model
    import runtime

    return runtime.Model(compile_model(name).path)


def _own(model: str, steps: str, stop: float | None, signal: list[str] | None, parameter: list[str] | None) -> Scenario:
    """A scenario made from the command line for the user's own model."""
    from analysis.comparison.scenarios import Scenario

    loaded = _compiled(model)
    end = loaded.stop_time if stop is None else stop
    shown = signal or [name for name, v in loaded.variables.items() if v.kind == "state"][:3]
    values = {name: number(name, text) for name, text in assignments(parameter).items()}
    parts = tuple(number("--steps", part) for part in steps.split(","))
    return Scenario("model", loaded.name, model, end, loaded.interval or end / 500, parts, tuple(shown), values)


def _against(model: str, file: Path, tolerance: float, parameter: list[str] | None) -> None:
    from analysis.comparison.compare import compare_with_file, read_columns
    import runtime

    time, columns = read_columns(file)
    values = {name: number(name, text) for name, text in assignments(parameter).items()}
    loaded = _compiled(model)
    result = runtime.simulate(
        loaded, parameters=values, start=float(time[0]), stop=float(time[-1]), rtol=min(1e-8, 0.01 * tolerance),
        output_times=time, outputs=list(columns), events=False,
    )  # fmt: skip
    deviations = compare_with_file(result, time, columns)
    table = Table(
        "signal", "unit", "largest deviation", "at (s)", "RMS", "relative", "", title=f"{model} against {file}"
    )
    for d in deviations:
        verdict = "ok" if d.relative <= tolerance else "beyond tolerance"
        unit = loaded.variables[d.name].unit
        table.add_row(
            d.name, unit, f"{d.maximum:.3e}", f"{d.at_time:.6g}", f"{d.rms:.3e}", f"{d.relative:.2e}", verdict
        )
    Console().print(table)
    beyond = [d.name for d in deviations if not d.relative <= tolerance]
    if beyond:
        raise UserError(f"{', '.join(beyond)} deviate by more than {tolerance:g} of their largest magnitude")


def _table(study: Study) -> Table:
    from analysis.comparison.report import order_text

    table = Table(
        "run", "time", "largest relative deviation", "event times", "steps", "order", title=study.scenario.title
    )
    for result in study.lanes:
        order = study.orders.get(result.lane.family)
        error = f"{result.error:.2e}" if result.failure is None else result.failure
        table.add_row(
            result.lane.label, f"{result.seconds:.3f} s", error, f"{result.events.maximum:.1e} s",
            f"{result.counters['steps']:,}", "" if order is None else order_text(order),
        )  # fmt: skip
    return table
