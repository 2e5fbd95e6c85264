"""`lacuna case new`: from a model and recordings to a case that `lacuna explain` takes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import ClassName, Libraries, Model

app = typer.Typer(no_args_is_help=True, help="Cases: a model, its recordings and what is believed.")


@app.callback()
def case() -> None:
    """Cases: a model, its recordings and what is believed."""


@app.command("new")
@answered
def new(
    model: Model,
    data: Annotated[list[Path], typer.Argument(metavar="DATA...", help="Recordings as they come")],
    out: Annotated[Path, typer.Option(help="Folder of the new case")],
    class_name: ClassName = "",
    library: Libraries = None,
) -> Answer:
    """Write a commented case.toml, and the recordings beside it in the format of a case.

    Columns are matched to variables by name and unit (`Time \\[s]`, `n (rpm)`, `I_A/mA`); separators, decimal commas
    and encodings are found out. What it was unsure of is marked `# ?` in the file and said here.
    """
    name = f"{model}:{class_name}" if class_name else model
    made = lacuna.new_case(name, data, out, libraries=library or [])
    lines = [_line(*row) for row in made.columns]
    lines += [f"look at: {sentence}" for sentence in made.unsure]
    lines.append(f"next: lacuna explain {out}")
    content = {"columns": [list(row) for row in made.columns], "unsure": list(made.unsure)}
    return Answer(content, lines, [made.folder / "case.toml"])


def _line(column: str, variable: str, unit: str, role: str) -> str:
    return f"{column} -> {variable} [{unit}], {role}" if variable else f"{column}: fits no variable, left out"
