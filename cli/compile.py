"""`lacuna compile`: translate a model and show what the passes made of it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from rich.console import Console
from rich.table import Table
import typer

from cli.check import Units
from cli.errors import reported
from cli.options import Model

Dump = Annotated[
    Literal["flat", "structure", "c"] | None,
    typer.Option(help="Print the flat equations, the sorted blocks with their unknowns, or the generated C"),
]


@reported
def compile(model: Model, dump: Dump = None, units: Units = "error") -> None:
    """Translate MODEL to C and compile it; print the seconds of each pass, or with --dump what a pass made.

    An unchanged model is neither translated nor compiled again.
    """
    from codegen.compile import compile_model
    from codegen.dump import dump_text

    if dump:
        typer.echo(dump_text(model, dump, units=units))
        return
    compiled = compile_model(model, units=units)
    for warning in compiled.warnings:
        typer.echo(str(warning), err=True)
    console = Console()
    console.print(_passes(compiled.name, compiled.report.seconds))
    console.print(f"{Path(compiled.path)}")


def _passes(name: str, seconds: dict[str, float]) -> Table:
    table = Table(title=name, title_justify="left")
    table.add_column("pass")
    table.add_column("seconds", justify="right")
    for label, value in seconds.items():
        table.add_row(label, f"{value:.3f}")
    table.add_row("in all", f"{sum(seconds.values()):.3f}", style="bold")
    return table
