"""`lacuna compare`: variable step against fixed step, or a model against a file from elsewhere."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

from rich.table import Table
import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.complete import models
from lacuna.cli.options import MODEL_HELP, ClassName, Hold, Inputs, Libraries, Parameters, inputs, parameters
from lacuna.cli.progress import progress


@answered
def compare(
    model: Annotated[str | None, typer.Argument(metavar="[MODEL]", help=MODEL_HELP, autocompletion=models)] = None,
    class_name: ClassName = "",
    library: Libraries = None,
    against: Annotated[
        Path | None, typer.Option(help="A recording (time and full names as heads) or an .fmu of another tool")
    ] = None,
    tolerance: Annotated[
        float, typer.Option(min=0, help="Largest deviation from the file, of a signal's magnitude")
    ] = 1e-3,
    only: Annotated[list[str] | None, typer.Option(help="Only this scenario; repeat for more")] = None,
    scenarios: Annotated[Path | None, typer.Option(help="Scenarios of your own, a TOML file")] = None,
    step: Annotated[list[float] | None, typer.Option(help="Fixed steps to try on MODEL, s; repeat for more")] = None,
    stop: Annotated[float | None, typer.Option(help="Stop time on MODEL, s")] = None,
    parameter: Parameters = None,
    input: Inputs = None,
    hold: Hold = False,
    out: Annotated[Path | None, typer.Option(help="Folder for tables, figures and report.html")] = None,
) -> Answer:
    """Compare solvers on the scenarios of the project, on MODEL, or MODEL with a file or an FMU (--against).

    Deviation of every signal, of event times, observed order of convergence, work and time; as a table, CSV, figures
    and one report. With --against the exit status is 1 where a signal deviates by more than --tolerance.
    """
    values, driven = parameters(parameter), inputs(input, hold)
    if against:
        if model is None:
            raise lacuna.UserError("--against needs a MODEL to compare the file with")
        with progress() as tell:
            found = lacuna.compare_with_file(
                model, against, class_name=class_name, libraries=library or [], parameters=values, inputs=driven,
                tolerance=tolerance, stop=stop, progress=tell,
            )  # fmt: skip
        return _with_file(found)
    with progress() as tell:
        done = lacuna.compare(
            model, class_name=class_name, libraries=library or [], parameters=values, inputs=driven, only=only,
            scenarios=scenarios, steps=step, stop=stop, out=out, progress=tell,
        )  # fmt: skip
    tables = [_lanes(title, rows) for title, rows in done.tables.items()]
    data = {"scenarios": done.tables, "columns": lacuna.Comparison.columns, "findings": done.findings}
    return Answer(data, [*tables, *done.findings], [done.folder])


def _lanes(title: str, rows: tuple[tuple[str, ...], ...]) -> Table:
    first, *others = lacuna.Comparison.columns
    table = Table(first, title=title, title_justify="left")
    for column in others:
        table.add_column(column, justify="right")
    for row in rows:
        table.add_row(*row)
    return table


def _with_file(found: lacuna.Agreement) -> Answer:
    table = Table(title=f"{found.model} and {found.file}", title_justify="left")
    for column in ("signal", "largest deviation", "RMS", "of its magnitude", "at, s"):
        table.add_column(column, justify="left" if column == "signal" else "right")
    for name, maximum, rms, relative, at in found.rows:
        table.add_row(name, f"{maximum:.3e}", f"{rms:.3e}", f"{relative:.3e}", f"{at:g}")
    missing = [f"{name}: the file has no sample at {n} of {every} instants" for name, n, every in found.missing]
    failure = f"beyond the tolerance of {found.tolerance:g}: {', '.join(found.beyond)}" if found.beyond else ""
    return Answer(asdict(found) | {"beyond": found.beyond}, [table, *missing], failure=failure)
