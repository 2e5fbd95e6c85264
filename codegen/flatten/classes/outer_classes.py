"""Classes declared `outer`: the inner class of that name around a component stands for them (Modelica 3.6, 5.4)."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.names.component import Component
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import base_classes, member, own_or_inherited
from lacuna.codegen.flatten.names.views import view
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import ast


class _Outer(dict[int, dict[str, ast.Class]]):
    """What classes declare or inherit as outer, by their identities."""


def with_inner_classes(cls: ast.Class, around: Component | None, context: Context) -> ast.Class:
    """`cls` of a component inside `around`, with what is meant in place of its outer classes. Raises R013 where nothing
    is, R076 for an outer class that is modified. Where they were found before, they are what is meant there."""
    known = context.table(_Outer)
    if id(cls) not in known:
        known[id(cls)] = _outer_classes(context.library, cls)
        context.library.kept.append(cls)
    declared = {name: outer for name, outer in known[id(cls)].items() if name not in cls.redeclared}
    if not declared:
        return cls
    meant = {name: _inner(context.library, outer, around) for name, outer in declared.items()}
    return view(context.library, cls, cls.parent, meant, cls.whole)


def _outer_classes(library: Library, cls: ast.Class, depth: int = 0) -> dict[str, ast.Class]:
    found: dict[str, ast.Class] = {}
    for base in base_classes(library, cls) if depth <= 30 else ():
        found |= _outer_classes(library, base, depth + 1)
    own = {name: nested for name, nested in cls.classes.items() if nested.outer and not nested.inner}
    return found | {name: member(library, cls, name) or nested for name, nested in own.items()}


def _inner(library: Library, outer: ast.Class, around: Component | None) -> ast.Class:
    if outer.alias is not None and outer.alias.modification.arguments:
        raise Diagnostic("R076", f"the outer class {outer.name} is modified (5.4)", outer.span, "modify the inner one")
    while around is not None:
        found = own_or_inherited(library, around.cls, outer.name)
        if found is not None and found.inner:
            return found
        around = around.parent
    hint = f"declare in a class around it: inner {outer.kind} {outer.name}"
    raise Diagnostic("R013", f"no 'inner' matches the 'outer' class {outer.name}", outer.span, hint)
