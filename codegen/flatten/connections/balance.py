"""Connectors are balanced: as many flows as potentials, and one flow where something streams (9.3.1, 15.1)."""

from __future__ import annotations

from collections.abc import Iterator

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import ArrayNode, Instance, Node
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import own_or_inherited
from lacuna.codegen.syntax import ast

CONSTRAINT = "equalityConstraint"


class Uneven(list[Instance]):
    """Connectors whose flows and potentials differ in number."""


def check_balance(connector: Instance, severity: str = "error") -> None:
    """Raises R077 for a connector with streams and not one flow, and notes it, of that severity, for one whose flows
    and potentials differ in number: connections give equations for each, and whether the whole model has as many as
    unknowns, its structure answers.

    One with an overdetermined type (9.4) has more potentials than flows.
    """
    leaves = list(_leaves(connector))
    if any(leaf is None for leaf in leaves):
        return
    flows = sum(len(leaf.names) for leaf in leaves if leaf.flow)
    streams = [leaf for leaf in leaves if leaf.stream]
    potentials = sum(len(leaf.names) for leaf in leaves if _is_potential(leaf))
    name, span = connector.cls.name, connector.cls.span
    if streams and flows != 1:
        hint = "declare one scalar flow beside the streams"
        raise Diagnostic("R077", f"the connector {name} has streams and {flows} flows", span, hint)
    if flows != potentials:
        hint = "declare one flow for each potential; or inputs and outputs"
        message = f"the connector {name} has {flows} flows and {potentials} potentials"
        connector.context.table(Uneven).append(connector)
        _note(Diagnostic("R077", message, span, hint, severity=severity), connector.context)


def _note(finding: Diagnostic, context: Context) -> None:
    if finding.severity == "error":
        raise finding
    if not any((w.code, w.span) == (finding.code, finding.span) for w in context.warnings):
        context.warnings.append(finding)


def _is_potential(leaf: Leaf) -> bool:
    return not (leaf.flow or leaf.stream or leaf.causality or leaf.is_structural)


def _leaves(node: Node | None) -> Iterator[Leaf | None]:
    """The variables below; None stands for what an overdetermined type or a bus holds."""
    if isinstance(node, Leaf):
        overdetermined = node.type.named is not None and _is_overdetermined(node.instance, node.type.named)
        yield None if overdetermined else node
    elif isinstance(node, ArrayNode):
        for item in node.items:
            yield from _leaves(item)
    elif isinstance(node, Instance):
        if node.cls.expandable or _is_overdetermined(node, node.cls):
            yield None
            return
        for child in node.children():
            yield from _leaves(child)


class _Overdetermined(dict[int, bool]):
    """Classes looked at, by identity."""


def _is_overdetermined(instance: Instance, cls: ast.Class) -> bool:
    known = instance.context.table(_Overdetermined)
    if id(cls) not in known:
        known[id(cls)] = own_or_inherited(instance.context.library, cls, CONSTRAINT) is not None
        instance.context.library.kept.append(cls)
    return known[id(cls)]
