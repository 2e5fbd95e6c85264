"""What is wrong with a model, found without compiling it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from lacuna.codegen.compile import Report, not_too_deep, prepare
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flat import FlatModel
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from lacuna.notebook import page, table, verbatim
from lacuna.sources import Source, Units


@dataclass(frozen=True)
class Finding:
    """What a check found: a flat model's size, and warnings with file, line and hint."""

    name: str
    variables: int
    states: int
    equations: int
    warnings: tuple[str, ...]

    def _repr_html_(self) -> str:
        rows = [("variables", self.variables), ("continuous", self.states), ("equations", self.equations)]
        return page(self.name, table(("", ""), rows), *map(verbatim, self.warnings))


def check(
    model: str | Path,
    *,
    class_name: str = "",
    libraries: Iterable[str | Path] = (),
    units: Units = "error",
    data: Iterable[str | Path] = (),
    allow_external: bool = False,
) -> Finding:
    """Names, types, units, structure of the language; a warning where the equations cannot be solved for the variables:
    a component that others connect to need not be a model by itself. Raises Diagnostic with all findings."""
    source = Source.of(model, class_name, libraries, units, data, allow_external)
    with not_too_deep(source.name):
        flat = flatten(Library(source.path, source.access), source.name, units=units)
        warnings = [*flat.warnings, *_unsolvable(flat)]
    continuous = sum(v.variability == "continuous" for v in flat.variables.values())
    return Finding(flat.name, len(flat.variables), continuous, len(flat.equations), tuple(map(str, warnings)))


def _unsolvable(model: FlatModel) -> list[Diagnostic]:
    try:
        prepare(model, Report())
    except Diagnostic as error:
        message = f"by itself this cannot be simulated: {error.message}"
        return [replace(error, message=message, severity="warning", others=[])]
    return []
