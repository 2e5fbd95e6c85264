"""connect(a, b): sets of connected variables become equalities and sums of flows equal to zero."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.context import Context
from lacuna.codegen.flatten.instance import Absent, ArrayNode, Node
from lacuna.codegen.flatten.leaf import Leaf
from lacuna.codegen.flatten.references import apply_subscripts, member, unknown_name
from lacuna.codegen.flatten.scope import Scope
from lacuna.codegen.flatten.values import Array, Value, scalars
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.syntax import ast

Connector = Node | tuple[Leaf, int]  # the latter: one scalar of a connector that is a variable


@dataclass(frozen=True)
class End:
    """One scalar of a connector in a connection; `outside` where the connector belongs to the connecting model."""

    name: str
    outside: bool


@dataclass
class ConnectionSets:
    """Union-find over the ends, flows and potentials apart; remembers a place and a text for each set."""

    parent: dict[End, End] = field(default_factory=dict)
    flow: dict[End, bool] = field(default_factory=dict)
    span: dict[End, Span] = field(default_factory=dict)
    origin: dict[End, str] = field(default_factory=dict)

    def find(self, end: End) -> End:
        root = end
        while self.parent.setdefault(root, root) != root:
            root = self.parent[root]
        while self.parent[end] != root:
            self.parent[end], end = root, self.parent[end]
        return root

    def join(self, a: End, b: End, flow: bool, span: Span, origin: str) -> None:
        root, other = self.find(a), self.find(b)
        self.parent[other] = root
        for end in (a, b):
            self.flow[end] = flow
        self.span.setdefault(root, span)
        self.origin.setdefault(root, origin)

    def groups(self) -> list[list[End]]:
        found: dict[End, list[End]] = {}
        for end in self.parent:
            found.setdefault(self.find(end), []).append(end)
        return list(found.values())


def connection_equations(connections: list[tuple[ast.Connect, Scope]], context: Context) -> list[flat.Equation]:
    """Equations of all connections, and zero for each flow that nothing is connected to."""
    sets = ConnectionSets()
    for item, scope in connections:
        with context.attempt():
            _connect(item, scope, sets)
    equations: list[flat.Equation] = []
    for group in sets.groups():
        root = sets.find(group[0])
        span, origin = sets.span[root], sets.origin[root]
        names = " ".join(dict.fromkeys(e.name for e in group))
        if sets.flow[group[0]]:
            total = _sum([(ex.var(end.name), end.outside) for end in group])
            equations.append(flat.Equation(total, ex.ZERO, span, origin, f"sum of flows: {names}"))
            continue
        unique = list(dict.fromkeys(e.name for e in group))
        for name in unique[1:]:
            a, b = _variable(unique[0], context), _variable(name, context)
            equations.append(flat.Equation(a, b, span, origin, f"connected: {unique[0]} = {name}"))
    return equations + _unconnected(sets, context)


def _sum(flows: list[tuple[ex.Expr, bool]]) -> ex.Expr:
    """All flows added, those marked with the other sign: from the left, and in halves where they are many."""
    if len(flows) > 64:
        middle = len(flows) // 2
        return ex.add(_sum(flows[:middle]), _sum(flows[middle:]))
    total = ex.ZERO
    for v, negative in flows:
        total = ex.sub(total, v) if negative else ex.add(total, v)
    return total


def _variable(name: str, context: Context) -> ex.Expr:
    return ex.var(name, context.scalars[name][0].primitive)


def _unconnected(sets: ConnectionSets, context: Context) -> list[flat.Equation]:
    equations = []
    for name, (leaf, _) in context.scalars.items():
        if leaf.declaration.flow and leaf.instance.parent is not None and End(name, False) not in sets.parent:
            span = leaf.instance.span
            text = f"nothing is connected: {name} = 0"
            equations.append(flat.Equation(ex.var(name), ex.ZERO, span, leaf.instance.parent.name, text))
    return equations


def _connect(item: ast.Connect, scope: Scope, sets: ConnectionSets) -> None:
    sides = []
    for ref in (item.left, item.right):
        nodes = _connector(ref, scope)
        sides.append([_ends(node, ref, _is_outside(ref, scope)) for node in nodes])
    left, right = sides
    if not (left and right):
        return  # a component that a condition removed
    if len(left) != len(right):
        message = f"connect: {len(left)} connectors with {len(right)}"
        raise Diagnostic("R060", message, item.span, "both sides need the same size")
    for a, b in zip(left, right, strict=True):
        if a.keys() != b.keys():
            kinds = [
                f"{ref} has {', '.join(k.lstrip('.') or 'one value' for k in e)}"
                for ref, e in ((item.left, a), (item.right, b))
            ]
            hint = "connect connectors of the same kind"
            raise Diagnostic("R060", f"the connectors do not match: {'; '.join(kinds)}", item.span, hint)
        for key, (end, flow) in a.items():
            other, other_flow = b[key]
            if flow != other_flow:
                hint = "connect connectors of the same kind"
                raise Diagnostic("R060", f"{end.name} and {other.name}: only one is a flow", item.span, hint)
            origin = scope.instance.name
            if flow:
                sets.join(end, other, True, item.span, origin)
            else:
                sets.join(replace(end, outside=False), replace(other, outside=False), False, item.span, origin)


def _is_outside(ref: ast.Ref, scope: Scope) -> bool:
    node = scope.instance.child(ref.names[0])
    if isinstance(node, ArrayNode):
        node = node.items[0]
    return _is_connector(node)


def _is_connector(node: Node) -> bool:
    if isinstance(node, Leaf):
        return node.causality in ("input", "output") or node.declaration.flow
    return node.cls.kind == "connector"


def _connector(ref: ast.Ref, scope: Scope) -> list[Connector]:
    """The connectors a name means: instances, or (leaf, position) of connectors that are scalars."""
    node = scope.instance.child(ref.names[0])
    if node is None:
        raise unknown_name(ref, scope)
    nodes: list[Connector] = [node]
    for at, subscripts in enumerate(ref.subscripts):
        if at:
            nodes = [member(n, ref, at) for n in nodes]
        nodes = [picked for n in nodes for picked in _pick(n, subscripts, ref, at, scope)]
    for n in nodes:
        if not _is_connector(n[0] if isinstance(n, tuple) else n):
            hint = "connect joins connectors, such as a.p or b.flange_a"
            raise Diagnostic("R061", f"{ref} is no connector", ref.span, hint)
    return nodes


def _pick(
    node: Node, subscripts: tuple[ast.Expression, ...] | None, ref: ast.Ref, at: int, scope: Scope
) -> list[Connector]:
    if isinstance(node, Absent):
        return []
    last = at == len(ref.names) - 1
    if isinstance(node, Leaf):
        if not last:
            raise Diagnostic("R061", f"{node.name} has no connectors", ref.span, "name a connector")
        if not node.shape:
            return [(node, 0)]
        picked = apply_subscripts(_numbers(node), subscripts, scope, ref)
        return [(node, position) for position in _chosen(picked, ref)]
    if isinstance(node, ArrayNode):
        picked = apply_subscripts(node.numbers, subscripts, scope, ref)
        return [node.items[number - 1] for number in _chosen(picked, ref)]
    if subscripts is not None:
        raise Diagnostic("R044", f"{node.name} is no array", ref.span, "remove the subscript")
    return [node]


def _chosen(value: Value, ref: ast.Ref) -> list[int]:
    items = scalars(value)
    if any(item.op != "const" for item in items):
        hint = "connections never change: use whole numbers, parameters or loop variables"
        raise Diagnostic("F021", f"the element of {ref} is not known at translation", ref.span, hint)
    return [item.value for item in items]


def _numbers(leaf: Leaf) -> Array:
    return Array(leaf.shape, tuple(ex.const(i) for i in range(len(leaf.names))))


def _ends(node: Node, ref: ast.Ref, outside: bool, prefix: str = "") -> dict[str, tuple[End, bool]]:
    """The scalars of one connector by their name relative to it."""
    if isinstance(node, tuple):
        leaf, position = node
        return {prefix: (End(leaf.names[position], outside), leaf.declaration.flow)}
    if isinstance(node, Leaf):
        if node.is_structural or node.primitive == "String":
            return {}
        return {
            prefix + name.removeprefix(node.name): (End(name, outside), node.declaration.flow) for name in node.names
        }
    if isinstance(node, Absent):
        return {}
    found: dict[str, tuple[End, bool]] = {}
    if isinstance(node, ArrayNode):
        for number, item in enumerate(node.items, 1):
            found |= _ends(item, ref, outside, f"{prefix}[{number}]")
        return found
    for name in node.elements:
        found |= _ends(node.child(name), ref, outside, f"{prefix}.{name}")
    return found
