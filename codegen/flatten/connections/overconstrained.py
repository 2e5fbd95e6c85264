"""Overdetermined connectors: the graph of Connections.branch, root and connect, its spanning trees and their roots
(Modelica 3.6, 9.4)."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.instance import ArrayNode, Instance, Node
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.connections.connectors import Connector, connectors
from lacuna.codegen.flatten.connections.structure import Structure, structural_items
from lacuna.codegen.flatten.expressions.constants import evaluate
from lacuna.codegen.flatten.expressions.lower import lower_scalar
from lacuna.codegen.flatten.functions.declared import call_function
from lacuna.codegen.flatten.functions.locals import signature_of
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope, own_or_inherited
from lacuna.codegen.flatten.names.values import Array, Record, Value, items_of, stack
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import INTEGER, Expr
from lacuna.codegen.symbolic.union_find import UnionFind
from lacuna.codegen.syntax import ast

CONSTRAINT = "equalityConstraint"
STATEMENTS = ("Connections.branch", "Connections.root", "Connections.potentialRoot")
_SUPER = "the roots"  # what all roots hang from


@dataclass
class Graph:
    """Nodes are overdetermined variables and records by their names."""

    branches: list[tuple[str, str, Span]] = field(default_factory=list)
    roots: dict[str, Span] = field(default_factory=dict)
    candidates: dict[str, int] = field(default_factory=dict)  # potential roots and their priorities
    connected: list[tuple[str, str, Span]] = field(default_factory=list)
    broken: set[tuple[str, str]] = field(default_factory=set)  # connections outside of the trees
    chosen: set[str] = field(default_factory=set)  # the roots, those chosen among the potential ones included
    depth: dict[str, int] = field(default_factory=dict)  # steps from the root

    def solve(self) -> None:
        """Choose the trees and their roots. Raises R080 where branches make a circle, join roots or lack one."""
        sets, edges = UnionFind(), []
        for name in self.candidates:
            sets.find(name)  # one that nothing is connected to is a tree of its own
        for a, b, span in self.branches:
            if sets.find(a) == sets.find(b):
                raise Diagnostic("R080", f"branches between {a} and {b} close a circle", span, "leave one out")
            sets.join(a, b)
            edges.append((a, b))
        for root, span in self.roots.items():
            if sets.find(root) == sets.find(_SUPER):
                raise Diagnostic("R080", f"{root} and another root are joined by branches", span, "keep one root")
            sets.join(_SUPER, root)
        for a, b, _ in self.connected:
            if sets.find(a) == sets.find(b):
                self.broken |= {(a, b), (b, a)}
            else:
                sets.join(a, b)
                edges.append((a, b))
        self.chosen = set(self.roots) | set(self._chosen_among(sets))
        self._measure(edges)

    def _chosen_among(self, sets: UnionFind) -> Iterator[str]:
        """One potential root for each tree without a root: the one of the lowest priority, the first of those."""
        places = {n: span for a, b, span in (*self.branches, *self.connected) for n in (a, b)}
        for group in sets.groups():
            names = [str(n) for n in group]
            if _SUPER in names:
                continue
            found = [n for n in self.candidates if n in set(names)]
            if not found:
                hint = "say Connections.root(...) or Connections.potentialRoot(...) of one of them"
                raise Diagnostic("R080", f"nothing can be the root of {', '.join(names[:5])}", places[names[0]], hint)
            yield min(found, key=self.candidates.__getitem__)

    def _measure(self, edges: list[tuple[str, str]]) -> None:
        beside: dict[str, list[str]] = {}
        for a, b in edges:
            beside.setdefault(a, []).append(b)
            beside.setdefault(b, []).append(a)
        waiting = deque(self.chosen)
        self.depth = dict.fromkeys(self.chosen, 0)
        while waiting:
            name = waiting.popleft()
            for other in beside.get(name, ()):
                if other not in self.depth:
                    self.depth[other] = self.depth[name] + 1
                    waiting.append(other)


@dataclass
class _Known:
    """The graph of this run, once somebody asks; the classes in which something is overdetermined."""

    graph: Graph | None = None
    inside: dict[int, bool] = field(default_factory=dict)


def graph_of(context: Context) -> Graph:
    known = context.table(_Known)
    if known.graph is None:
        known.graph = Graph()  # while it is being made, conditions on it see no roots
        made = Graph()
        for item, scope in structural_items(context.table(Structure).sections, context):
            if isinstance(item, ast.Connect):
                _note_connection(item, scope, made)
            elif str(item.call.function) in STATEMENTS:
                _note_statement(item.call, scope, made)
        made.solve()
        known.graph = made
    return known.graph


def _note_connection(item: ast.Connect, scope: Scope, graph: Graph) -> None:
    try:
        pairs = list(zip(connectors(item.left, scope), connectors(item.right, scope), strict=False))
    except Diagnostic:
        return  # connect itself says so, or an expandable connector does not have it yet
    for a, b in pairs:
        other = {path: node for path, node, _ in overdetermined(b, scope.context)}
        for path, node, _ in overdetermined(a, scope.context):
            if path in other:
                graph.connected.append((node.name, other[path].name, item.span))


def _note_statement(call: ast.Call, scope: Scope, graph: Graph) -> None:
    name = str(call.function)
    allowed = (2,) if name == "Connections.branch" else (1,) if name == "Connections.root" else (1, 2)
    arguments = [*call.args, *call.named.values()]
    if len(arguments) not in allowed or any(n != "priority" for n in call.named):
        raise Diagnostic("R050", f"{name} takes {' or '.join(map(str, allowed))} arguments", call.span, "see 9.4.1")
    node = name_of(arguments[0], scope)
    if name == "Connections.branch":
        graph.branches.append((node, name_of(arguments[1], scope), call.span))
    elif name == "Connections.root":
        graph.roots[node] = call.span
    else:
        priority = lower_scalar(arguments[1], scope, INTEGER) if len(arguments) == 2 else ex.ZERO
        graph.candidates[node] = int(evaluate(priority, scope.context, call.span, "the priority").value)


def name_of(e: ast.Expression, scope: Scope) -> str:
    """The name of the overdetermined variable or record that `e` means. Raises R080 for anything else."""
    found = {_node(c).name for c in connectors(e, scope)} if isinstance(e, ast.Ref) and len(e.names) > 1 else set()
    if len(found) != 1 or not list(overdetermined(connectors(e, scope)[0], scope.context)):
        hint = f"such as frame_a.R, of a type or record with a function {CONSTRAINT}"
        raise Diagnostic("R080", "this is no overdetermined element of a connector", e.span, hint)
    return found.pop()


def _node(found: Connector) -> Node:
    return found[0] if isinstance(found, tuple) else found


def overdetermined(found: Connector, context: Context, path: str = "") -> Iterator[tuple[str, Node, ast.Class]]:
    """(path from the connector, variable or record, its equalityConstraint) of what is overdetermined in it."""
    node = _node(found)
    if isinstance(node, ArrayNode):
        for number, item in enumerate(node.items, 1):
            yield from overdetermined(item, context, f"{path}[{number}]")
        return
    cls = node.cls if isinstance(node, Instance) else node.type.named if isinstance(node, Leaf) else None
    constraint = own_or_inherited(context.library, cls, CONSTRAINT) if cls is not None else None
    if constraint is not None and constraint.kind == "function":
        yield path, node, constraint
    elif isinstance(node, Instance):
        inside = context.table(_Known).inside
        if not node.cls.expandable and inside.get(id(node.cls)) is False:
            return
        results = [r for name in node.present for r in overdetermined(node.child(name), context, f"{path}.{name}")]
        inside[id(node.cls)] = bool(results)
        yield from results


def is_root(e: ast.Call, scope: Scope) -> Value:
    """Connections.isRoot(a.R): is it the root of its tree?"""
    return ex.const(_asked(e, scope) in graph_of(scope.context).chosen)


def rooted(e: ast.Call, scope: Scope) -> Value:
    """Connections.rooted(a.R): is it nearer to the root than what its one branch joins it with?"""
    name, graph = _asked(e, scope), graph_of(scope.context)
    others = [b if a == name else a for a, b, _ in graph.branches if name in (a, b)]
    if len(others) != 1 and graph.branches:
        hint = "it asks for the direction of the one branch at it"
        raise Diagnostic("R080", f"{name} has {len(others)} branches, not one", e.span, hint)
    return ex.const(bool(others) and graph.depth.get(name, 0) < graph.depth.get(others[0], 0))


def _asked(e: ast.Call, scope: Scope) -> str:
    if len(e.args) != 1 or e.named:
        raise Diagnostic("R050", f"{e.function} takes one argument", e.span, f"write {e.function}(frame_a.R)")
    return name_of(e.args[0], scope)


def constraint_values(a: Connector, b: Connector, item: ast.Connect, scope: Scope) -> dict[str, tuple[Expr, ...]]:
    """Of a connection: by path, the residues that stand for the equality of overdetermined elements where their
    connection closes a circle."""
    residues = {}
    other = {path: node for path, node, _ in overdetermined(b, scope.context)}
    for path, node, function in overdetermined(a, scope.context):
        if path in other and (node.name, other[path].name) in graph_of(scope.context).broken:
            call = ast.Call(item.span, ast.Ref(item.span, (function.name,), (None,)), [], {})
            names = [i.name for i in signature_of(function, scope.context).inputs]
            if len(names) != 2:
                hint = "it takes two of its type and gives their residues (9.4.1)"
                raise Diagnostic("R080", f"equalityConstraint has {len(names)} inputs", function.span, hint)
            given = dict(zip(names, (_value(node), _value(other[path])), strict=True))
            residues[path] = tuple(items_of(call_function(function, call, scope, given)[0]))
    return residues


def _value(node: Node) -> Value:
    if isinstance(node, Leaf):
        return node.value()
    if isinstance(node, ArrayNode):
        stacked = stack([_value(n) for n in node.items], node.items[0].span)
        return Array(node.shape + stacked.shape[1:], stacked.items)
    return Record(node.name, {name: _value(node.child(name)) for name in node.elements}, node.cls)
