"""`lacuna case new`: from a model and recordings to a case that `lacuna explain` takes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import lacuna
from lacuna.cli.options import Libraries, Model, reported

app = typer.Typer(no_args_is_help=True, help="Cases: a model, its recordings and what is believed.")


@app.command("new")
@reported
def new(
    model: Model,
    data: Annotated[list[Path], typer.Argument(metavar="DATA...", help="Recordings as they come: text tables")],
    out: Annotated[Path, typer.Option(help="Folder of the new case")],
    library: Libraries = None,
) -> None:
    """Write a commented case.toml and the recordings beside it.

    Columns are matched to variables by name and unit (`Time [s]`, `n (rpm)`, `I_A/mA`), `;` and decimal commas are
    understood. What it was unsure of is marked `# ?` in the file and said here.
    """
