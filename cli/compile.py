"""`lacuna compile`: translate a model and show what the passes made of it."""

from __future__ import annotations

from typing import Annotated, Literal

from rich.table import Table
import typer

from lacuna.cli.errors import reported
from lacuna.cli.options import Model, Units
from lacuna.cli.output import console

Dump = Annotated[
    Literal["flat", "structure", "c"] | None,
    typer.Option(help="Print the flat equations, the structure (states, blocks, tears, relations) or the generated C"),
]


@reported
def compile(model: Model, dump: Dump = None, units: Units = "error") -> None:
    """Translate MODEL to C and compile it; print the seconds of each pass, or with --dump what the passes made.

    A model whose files are unchanged is neither translated nor compiled again.
    """
    from lacuna.codegen.compile import compile_model

    if dump:
        typer.echo(_dumped(model, dump, units), nl=False)
        return
    compiled = compile_model(model, units=units)
    for warning in compiled.report.warnings:
        typer.echo(str(warning), err=True)
    if compiled.report.cached:
        typer.echo(f"{compiled.name}: unchanged since it was compiled")
    else:
        console().print(_passes(compiled.name, compiled.report.seconds))
    typer.echo(compiled.path)


def _dumped(model: str, dump: str, units: str) -> str:
    """The flat model needs the front end alone, so it can be looked at where later passes refuse it."""
    from lacuna.codegen.compile import translate
    from lacuna.codegen.flat.text import dump_flat
    from lacuna.codegen.flatten import flatten
    from lacuna.codegen.library import Library
    from lacuna.codegen.report import dump as dumped

    if dump == "flat":
        return dump_flat(flatten(Library(), model, units=units))
    return dumped(translate(model, units=units)[0], dump)


def _passes(name: str, seconds: dict[str, float]) -> Table:
    table = Table(title=name, title_justify="left")
    table.add_column("pass")
    table.add_column("seconds", justify="right")
    for label, value in seconds.items():
        table.add_row(label, f"{value:.3f}")
    table.add_row("in all", f"{sum(seconds.values()):.3f}", style="bold")
    return table
