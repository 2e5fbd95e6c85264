"""What annotations of connectors ask of their connections: mustBeConnected, mayOnlyConnectOnce (Modelica 3.6, 18.8)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.connections.connection_sets import ConnectionSets
from lacuna.codegen.flatten.connections.connectors import End, parts
from lacuna.codegen.flatten.expressions.constants import evaluate
from lacuna.codegen.flatten.names.annotations import warn_of_slips
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast

MUST, ONCE = "mustBeConnected", "mayOnlyConnectOnce"


def check_annotations(leaves: Iterable[Leaf], context: Context) -> None:
    """Raises R060 for a connector of a component that is connected from outside less or more than it says."""
    sets = context.table(ConnectionSets)
    for node, said in _annotated(leaves, context):
        with context.attempt():
            names = [part.end.name for part in parts(node, False).values() if part.kind in ("flow", "potential")]
            around = node.instance if isinstance(node, Leaf) else node.parent
            groups = [g for name in names for g in (_group(sets, around.name, name),) if g]
            if MUST in said and not groups:
                raise Diagnostic("R060", f"{node.name} is not connected: {said[MUST]}", node.span, "connect it")
            most = max((_elements(group, sets, context) for group in groups), default=0)
            if ONCE in said and most > 2:
                message = f"{node.name} is connected with {most - 1} others: {said[ONCE]}"
                raise Diagnostic("R060", message, node.span, "connect it once")


def _annotated(leaves: Iterable[Leaf], context: Context) -> Iterator[tuple[Leaf | Instance, dict[str, str]]]:
    """Connectors of components, each once, with the messages of their annotations."""
    seen: set[int] = set()
    for leaf in leaves:
        node: Leaf | Instance | None = leaf
        while node is not None and id(node) not in seen:
            seen.add(id(node))
            around = node.instance if isinstance(node, Leaf) else node.parent
            warn_of_slips(node.declaration.annotation if node.declaration else None, (MUST, ONCE), context)
            said = _messages(node.declaration)
            if said and around is not None and around.parent is not None:
                yield node, said
            node = around


def _messages(declaration: ast.Component | None) -> dict[str, str]:
    annotation = declaration.annotation if declaration is not None else None
    found = {}
    for a in annotation.arguments if annotation is not None else ():
        if a.name in (MUST, ONCE):
            value = a.modification.value
            found[a.name] = str(value.value) if isinstance(value, ast.Literal) else a.name
    return found


def _group(sets: ConnectionSets, component: str, name: str) -> list[End] | None:
    """The ends connected with a scalar of a connector of `component`, seen from outside; None where there are none."""
    end = End(name, False)
    if end not in sets.kind:
        return None
    if sets.kind[end] == "flow":
        return sets.members(end)
    outside = component.rpartition(".")[0]
    key = (outside, name)
    if key not in sets.causal:
        return None
    return [End(other, False) for _, other in sets.sources_of(key)]


def _elements(group: list[End], sets: ConnectionSets, context: Context) -> int:
    """How many count: of stream connectors those whose flow may be negative."""
    return sum(not (_streams(end, sets) and _never_negative(end, context)) for end in group)


def _streams(end: End, sets: ConnectionSets) -> bool:
    """Is it the flow of a connector with streams?"""
    instance = sets.parts[end].leaf.instance
    return any(e.declaration.stream for e in instance.elements.values())


def _never_negative(end: End, context: Context) -> bool:
    leaf, position = context.scalars[end.name]
    least = leaf.element(leaf.attribute("min"), position)
    return isinstance(least, Expr) and evaluate(least, context, leaf.span, f"min of {end.name}").value >= 0
