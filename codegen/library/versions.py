"""Which version of a library a model was written for, and which one there is (18.8): what to say of a name without a
class."""

from __future__ import annotations

from typing import Protocol

from lacuna.codegen.syntax import ast


class Classes(Protocol):
    """The library, as far as this asks."""

    root: ast.Class

    def foreign_package(self, file: str) -> str: ...


def top_package(library: Classes, cls: ast.Class) -> ast.Class | None:
    """The library that a class belongs to; None where it is no library that was found by the search path."""
    while cls.parent is not None and cls.parent is not library.root and cls.parent.name:
        cls = cls.parent
    return cls if cls.name and library.foreign_package(cls.span.file) == cls.name else None


def not_in_copy(library: Classes, cls: ast.Class, name: str) -> str:
    """Says so where `cls` is a library, which has parts that not every copy has; else ""."""
    return f"this copy of the library {cls.name} has no {name}" if top_package(library, cls) is cls else ""


def other_version(package: ast.Class, user: ast.Class | None) -> str:
    """Says so where a class, or one around it, was written for another main version of a library; else ""."""
    version, wanted = _text(package.annotation, "version"), _used(package.name, user)
    if not version or not wanted or version.split(".")[0] == wanted.split(".")[0]:
        return ""
    return f"the model was written for {package.name} {wanted}, and this is {version}, where names may be others"


def _used(library: str, user: ast.Class | None) -> str:
    """The version in annotation(uses(library(version = "..."))), "" where there is none."""
    while user is not None:
        uses = _inside(_inside(user.annotation, "uses"), library)
        if uses is not None:
            return _text(uses, "version")
        user = user.parent
    return ""


def _inside(modification: ast.Modification | None, name: str) -> ast.Modification | None:
    arguments = modification.arguments if modification is not None else ()
    return next((a.modification for a in arguments if a.name == name), None)


def _text(modification: ast.Modification | None, name: str) -> str:
    found = _inside(modification, name)
    value = found.value if found is not None else None
    return value.value if isinstance(value, ast.Literal) and isinstance(value.value, str) else ""
