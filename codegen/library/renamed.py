"""Packages of the Modelica Standard Library 3 that version 4.0.0 renamed: models that name them are read as they were
meant, with a warning, where the library has the new name and not the old one."""

from __future__ import annotations

from typing import Protocol

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.syntax import ast

# By the package that is looked in and the name that it does not have: the old full name, and the new one. From the
# release notes of version 4.0.0 of the library.
_RENAMED = {
    ("Modelica", "SIunits"): ("Modelica.SIunits", "Modelica.Units.SI"),
    ("Modelica.Units.SI", "Conversions"): ("Modelica.SIunits.Conversions", "Modelica.Units.Conversions"),
    ("Modelica.Units.SI", "Icons"): ("Modelica.SIunits.Icons", "Modelica.Units.Icons"),
    ("Modelica.Units.Conversions", "NonSIunits"): ("Modelica.SIunits.Conversions.NonSIunits", "Modelica.Units.NonSI"),
    ("Modelica.Electrical", "MultiPhase"): ("Modelica.Electrical.MultiPhase", "Modelica.Electrical.Polyphase"),
    ("Modelica.Electrical", "QuasiStationary"): ("Modelica.Electrical.QuasiStationary",
                                                 "Modelica.Electrical.QuasiStatic"),
}  # fmt: skip
OLD_NAMES = frozenset(name for _, name in _RENAMED)


class Classes(Protocol):
    """The library, as far as this asks: classes by name, and where it notes what it did."""

    root: ast.Class
    renamed: dict[str, str]

    def member(self, cls: ast.Class, name: str) -> ast.Class | None: ...


def renamed(library: Classes, cls: ast.Class, name: str) -> ast.Class | None:
    """What `name`, which `cls` does not have, is called now; None where it never had it, or the new name is absent."""
    old, new = _RENAMED.get((cls.path, name), ("", ""))
    found: ast.Class | None = library.root if new else None
    for part in new.split("."):
        found = library.member(found, part) if found is not None else None
    if found is not None:
        library.renamed[old] = new
    return found


def warnings_of(library: Classes) -> list[Diagnostic]:
    """One for each old name that was read as the new one."""
    return [
        Diagnostic(
            "W016", f"{old} of version 3 of the library is read as {new}", hint=f"write {new}", severity="warning"
        )
        for old, new in library.renamed.items()
    ]
