"""Strings that an equation of their own gives a value: it becomes their binding."""

from __future__ import annotations

from collections.abc import Iterable

from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.syntax import ast


def bind_texts(sections: Iterable[tuple[ast.Section, ast.Class, Instance]]) -> None:
    """Bind each String without a value that stands alone on a side of an equation, outside of loops and conditions."""
    for section, cls, instance in sections:
        if section.algorithm or section.initial:
            continue
        scope = Scope(instance.context, cls, instance)
        for item in section.items:
            if isinstance(item, ast.Equality):
                _bind(item, scope)


def _bind(item: ast.Equality, scope: Scope) -> None:
    for left, right in ((item.left, item.right), (item.right, item.left)):
        leaf = _open_text(left, scope)
        if leaf is not None:
            leaf.bind(right, scope)
            return


def _open_text(e: ast.Expression, scope: Scope) -> Leaf | None:
    """The String without a value that `e` names."""
    if not isinstance(e, ast.Ref) or e.absolute or any(e.subscripts):
        return None
    node: object = scope.instance
    for name in e.names:
        node = node.child(name) if isinstance(node, Instance) else None
    is_open = isinstance(node, Leaf) and node.primitive == "String" and node.modifier.value is None
    return node if is_open and not node.is_structural else None
