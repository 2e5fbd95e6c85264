"""The names in a part of the syntax tree."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass

from lacuna.codegen.syntax import ast


def calls_nothing(tree: object) -> bool:
    """Whether no function is called in a part of the syntax tree."""
    if isinstance(tree, list | tuple):
        return all(map(calls_nothing, tree))
    if isinstance(tree, dict):
        return all(map(calls_nothing, tree.values()))
    if not is_dataclass(tree):
        return True
    return not isinstance(tree, ast.Call) and all(calls_nothing(getattr(tree, f.name)) for f in fields(tree))


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
