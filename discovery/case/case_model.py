"""Which class a case believes in, and where it and what it uses are looked up.

The class may be one of the package Lacuna, of a library, or of a file beside case.toml. Whatever is built upon it (what
a search tries, the amended model, the judge) sees the same places.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.search_path import outermost, search_path
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import references

UNITS = "warn"  # what the numbers of a run do not need is said, and hinders nothing: units, the balance of a component


@dataclass(frozen=True)
class CaseModel:
    """The class's full name, the paths where names are looked up, the user's file (None: it is in a library)."""

    name: str
    search_path: tuple[str, ...]
    file: Path | None = None

    def library(self) -> Library:
        return Library(self.search_path)


def case_model(folder: Path, model: str, libraries: Sequence[str | Path]) -> CaseModel:
    """Resolve `model` and `libraries` as case.toml in `folder` writes them.

    Raises Diagnostic where a path is of no use, a file does not parse, or a class is not there.
    """
    paths = search_path([folder / entry for entry in libraries])
    file_name, colon, inner = model.partition(":")
    if not file_name.endswith(".mo"):
        return CaseModel(Library(paths).find(model).path, tuple(paths))
    file = (folder / file_name).resolve()
    top = outermost(file.parent)
    cls = Library(paths).find(f"{file}{colon}{inner}")
    beside = [str(top)] if top else [str(file), str(file.parent)]
    found = CaseModel(cls.path, (*beside, *paths), file)
    other = found.library().find(cls.path)
    if other.span.file != cls.span.file:  # what is built upon it would be built upon another one
        message = f"the class {cls.path} is also in {other.span.file}, which comes first"
        raise Diagnostic("F004", message, cls.span, "give one of the two another name")
    return found


def written_values(cls: ast.Class) -> set[str]:
    """Of components' parameters those whose numbers stand in the class, `shaft.J` of `Inertia shaft(J=2e-4)`: they are
    believed as its own are. What a component's class says by itself is no statement about this machine."""
    components = (value for c in cls.components for value in _written(c.modification.arguments, c.name))
    return {*components, *(value for e in cls.extends for value in _written(e.modification.arguments, ""))}


def _written(arguments: Sequence[ast.Argument], owner: str) -> Iterator[str]:
    for argument in arguments:
        name = f"{owner}.{argument.name}" if owner else argument.name
        if argument.modification.value is not None and not any(references(argument.modification.value)):
            yield name
        yield from _written(argument.modification.arguments, name)
