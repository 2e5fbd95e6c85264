"""Imports of a class name what there is: packages, and public elements of packages (Modelica 3.6, 13.2.1)."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.names.scope import base_classes, find_class, imported_class
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import ast
from lacuna.suggest import did_you_mean


def check_imports(cls: ast.Class, library: Library) -> None:
    """Raises R002, R017 or R075 for an import of `cls` that brings in nothing, or what must not be imported."""
    for item in cls.imports:
        if imported_class(library, item) is None:
            _check_constant(item, library)


def _check_constant(item: ast.Import, library: Library) -> None:
    *around, name = item.path.names
    path = replace(item.path, names=tuple(around), subscripts=(None,) * len(around))
    package = find_class(library, library.root, path)
    found = _component(library, package, name)
    if found is not None and package.kind != "package":
        hint = "declare the constant in a package, or write its full name"
        raise Diagnostic("R075", f"import: {package.name} is a {package.kind}, not a package", item.span, hint)
    if found is None:
        hint = did_you_mean(name, library.members(package), "declare it, or import its package")
        raise Diagnostic("R002", f"import: there is nothing named {name} in {package.path}", item.span, hint)
    if found.protected:
        raise Diagnostic("R017", f"{name} is protected in {package.name}", item.span, "make it public to import it")


def _component(library: Library, cls: ast.Class, name: str) -> ast.Component | None:
    own = next((c for c in cls.components if c.name == name), None)
    if own is not None:
        return own
    return next(filter(None, (_component(library, base, name) for base in base_classes(library, cls))), None)
