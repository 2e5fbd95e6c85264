"""The names in a part of the syntax tree."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass

from lacuna.codegen.syntax import ast


def references(tree: object) -> Iterator[ast.Ref]:
    """Every name in a part of the syntax tree, those inside subscripts included."""
    if isinstance(tree, ast.Ref):
        yield tree
    if isinstance(tree, list | tuple):
        for part in tree:
            yield from references(part)
    elif isinstance(tree, dict):
        yield from references(list(tree.values()))
    elif is_dataclass(tree):
        for f in fields(tree):
            if f.name != "span":
                yield from references(getattr(tree, f.name))
