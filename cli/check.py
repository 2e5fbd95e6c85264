"""`lacuna check`: the front end alone."""

from __future__ import annotations

import typer

from lacuna.cli.errors import reported
from lacuna.cli.options import Model, Units


@reported
def check(model: Model, units: Units = "error") -> None:
    """Parse, resolve, flatten and check the units of MODEL; print every finding with file, line and a hint."""
    from lacuna.codegen.flatten import flatten
    from lacuna.codegen.library import Library

    flat = flatten(Library(), model, units=units)
    for warning in flat.warnings:
        typer.echo(str(warning), err=True)
    states = sum(1 for v in flat.variables.values() if v.variability == "continuous")
    typer.echo(
        f"{flat.name}: {len(flat.variables)} variables ({states} continuous), {len(flat.equations)} equations, "
        f"{len(flat.warnings)} warnings; no errors"
    )
