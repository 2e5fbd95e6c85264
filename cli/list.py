"""`lacuna list`: what there is to name in other commands."""

from __future__ import annotations

from typing import Annotated

from rich.table import Table
import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import ClassName, Libraries, Model

app = typer.Typer(
    no_args_is_help=True, help="List models, effects, solvers, or the parameters and variables of a model."
)


@app.command()
@answered
def models(
    inside: Annotated[str, typer.Argument(metavar="[PACKAGE]", help="Only those of this package, file or folder")] = "",
    library: Libraries = None,
) -> Answer:
    """Models that can be simulated, of the libraries given and of the package Lacuna."""
    return _entries("models", lacuna.list_models(inside, libraries=library or []))


@app.command()
@answered
def effects(library: Libraries = None) -> Answer:
    """Effects of the catalogue, which an explanation chooses from."""
    return _entries("effects", lacuna.list_effects(libraries=library or []))


@app.command()
@answered
def solvers() -> Answer:
    """What `simulate --solver` takes."""
    return _entries("solvers", lacuna.list_solvers())


@app.command()
@answered
def parameters(model: Model, class_name: ClassName = "", library: Libraries = None) -> Answer:
    """Parameters of MODEL with their declared values, for -p; and its inputs, for -u."""
    loaded = lacuna.load(model, class_name=class_name, libraries=library or [])
    rows = [
        {
            "name": n,
            "value": v.start if v.kind == "parameter" else "input",
            "unit": v.unit,
            "description": v.description,
        }
        for n, v in (loaded.parameters | loaded.inputs).items()
    ]
    return _rows("parameters", rows, loaded.warnings)


@app.command()
@answered
def variables(model: Model, class_name: ClassName = "", library: Libraries = None) -> Answer:
    """Every variable of MODEL that a result has, for --signal."""
    loaded = lacuna.load(model, class_name=class_name, libraries=library or [])
    found = loaded.variables.items()
    rows = [{"name": n, "kind": v.kind, "unit": v.unit, "description": v.description} for n, v in found]
    return _rows("variables", rows, loaded.warnings)


def _entries(title: str, entries: list[lacuna.Entry]) -> Answer:
    return _rows(title, [{"name": e.name, "description": e.description} for e in entries], [])


def _rows(title: str, rows: list[dict[str, object]], warnings: list[str]) -> Answer:
    table = Table(*(rows[0] if rows else ["name"]), box=None, pad_edge=False)
    for row in rows:
        table.add_row(*(f"{v:.6g}" if isinstance(v, float) else str(v) for v in row.values()))
    return Answer({title: rows}, [table], warnings=warnings)
