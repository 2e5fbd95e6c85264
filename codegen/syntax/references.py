"""The names in a part of the syntax tree."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache

from lacuna.codegen.syntax import ast


@cache
def parts_of(kind: type) -> tuple[str, ...]:
    """The fields of a kind of node that hold what is written there; of what is no node none."""
    return tuple(f.name for f in fields(kind) if f.name != "span") if is_dataclass(kind) else ()


def calls_nothing(tree: object) -> bool:
    """Whether no function is called in a part of the syntax tree."""
    if isinstance(tree, list | tuple):
        return all(map(calls_nothing, tree))
    if isinstance(tree, dict):
        return all(map(calls_nothing, tree.values()))
    return not isinstance(tree, ast.Call) and all(calls_nothing(getattr(tree, n)) for n in parts_of(type(tree)))


def references(tree: object) -> Iterator[ast.Ref]:
    """Every name in a part of the syntax tree, those inside subscripts included."""
    if isinstance(tree, ast.Ref):
        yield tree
    if isinstance(tree, list | tuple):
        for part in tree:
            yield from references(part)
    elif isinstance(tree, dict):
        yield from references(list(tree.values()))
    else:
        for name in parts_of(type(tree)):
            yield from references(getattr(tree, name))
