"""What lies in the folder of a package: one class a file, each name once (Modelica 3.6, 13.4)."""

from __future__ import annotations

from pathlib import Path

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.library.search_path import PACKAGE_FILE, is_file
from lacuna.codegen.syntax import ast


def refuse_twice(package: ast.Class, folder: Path) -> None:
    """Raises R010 for a class that package.mo declares and a file or folder of the package, too."""
    for name, cls in package.classes.items():
        refuse_both(cls, [p for p in (folder / f"{name}.mo", folder / name / PACKAGE_FILE) if is_file(p)])


def refuse_both(cls: ast.Class, places: list[Path]) -> None:
    """Raises R010 where one of these files declares `cls` again."""
    if places:
        hint = "remove one of them"
        raise Diagnostic("R010", f"{cls.name} is declared in {places[0]}, too", cls.span, hint)


def only_class(classes: list[ast.Class], file: Path) -> ast.Class:
    """The class of a file in a package. Raises F003 for a second one."""
    if len(classes) > 1:
        hint = f"give {classes[1].name} a file of its own, or nest it in {classes[0].name}"
        raise Diagnostic("F003", f"{file.name} declares {classes[1].name}, too", classes[1].span, hint)
    return classes[0]
