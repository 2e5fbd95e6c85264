"""connect(a, b): sets of connected variables become equalities and sums of flows equal to zero."""

from __future__ import annotations

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.connections.connection_sets import ConnectionSets
from lacuna.codegen.flatten.connections.connectors import (
    End,
    Part,
    connectors_in_shape,
    is_outside,
    parts,
    refuse_element,
)
from lacuna.codegen.flatten.connections.overconstrained import constraint_values
from lacuna.codegen.flatten.connections.streams import stream_equations
from lacuna.codegen.flatten.expressions.constants import evaluate
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.syntax import ast

MAX_NAMES = 40  # in the text of a sum of flows

Connections = list[tuple[ast.Connect, Scope]]


def connection_equations(connections: Connections, context: Context) -> list[flat.Equation]:
    """Equations of all connections, and zero for each flow that nothing is connected to."""
    sets = context.table(ConnectionSets)
    equations: list[flat.Equation] = []
    for item, scope in connections:
        with context.attempt():
            _connect(item, scope, sets, equations)
    with context.attempt():
        sets.check_sources()
    for group in sets.ends.groups():
        root = sets.ends.find(group[0])
        span, origin = sets.span[root], sets.origin[root]
        names = list(dict.fromkeys(e.name for e in group))
        with context.attempt():
            _require_one_quantity(names, span, context)
        kind = sets.kind[group[0]]
        if kind == "flow":
            total = _sum([(ex.var(end.name), end.outside) for end in group])
            equations.append(flat.Equation(total, ex.ZERO, span, origin, f"sum of flows: {_shortened(names)}"))
        elif kind == "potential":
            for name in names[1:]:
                a, b = _variable(names[0], context), _variable(name, context)
                equations.append(flat.Equation(a, b, span, origin, f"connected: {names[0]} = {name}"))
    return equations + _unconnected(sets, context) + stream_equations(sets, context)


def _require_one_quantity(names: list[str], span: Span, context: Context) -> None:
    """Connected variables that name a quantity name the same (9.3). Raises R060."""
    named: dict[str, str] = {}
    for name in names:
        leaf, position = context.scalars[name]
        found = leaf.element(leaf.attribute("quantity"), position) if "quantity" in leaf.modifier.children else None
        if isinstance(found, str) and found:
            named.setdefault(found, name)
    if len(named) > 1:
        (one, first), (other, second) = list(named.items())[:2]
        message = f"{first} is of the quantity {one}, {second} of {other}"
        raise Diagnostic("R060", message, span, "connect what is of one quantity")


def _shortened(names: list[str]) -> str:
    more = f" and {len(names) - MAX_NAMES} more" if len(names) > MAX_NAMES else ""
    return " ".join(names[:MAX_NAMES]) + more


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
        flows = leaf.flow and leaf.instance.parent is not None and not leaf.is_structural
        passing = name in leaf.relayed and End(name, True) not in sets.ends.parent  # only others brought it to a bus
        if flows and (passing or End(name, False) not in sets.ends.parent):
            span = leaf.instance.span
            text = f"nothing is connected: {name} = 0"
            equations.append(flat.Equation(ex.var(name), ex.ZERO, span, leaf.instance.parent.name, text))
    return equations


def _connect(item: ast.Connect, scope: Scope, sets: ConnectionSets, equations: list[flat.Equation]) -> None:
    sides, sizes = [], []
    for ref, other in ((item.left, item.right), (item.right, item.left)):
        outside = is_outside(ref, scope)
        try:
            found, shape = connectors_in_shape(ref, scope)
        except Diagnostic:
            if not _is_there(other, scope):
                return  # nor is what it would have brought to a bus
            raise
        sizes.append(shape)
        for node in found:
            refuse_element(node, ref)
        sides.append([(node, parts(node, outside)) for node in found])
    left, right = sides
    if not (left and right):
        return  # a component that a condition removed
    if sizes[0] != sizes[1]:
        message = " with ".join(f"{_counted(n)} ({ref})" for n, ref in zip(sizes, (item.left, item.right), strict=True))
        raise Diagnostic("R060", f"connect: {message}", item.span, "both sides need the same size")
    for (one, a), (other, b) in zip(left, right, strict=True):
        if a.keys() != b.keys():
            kinds = [
                f"{ref} has {', '.join(k.lstrip('.') or 'one value' for k in e)}"
                for ref, e in ((item.left, a), (item.right, b))
            ]
            hint = "connect connectors of the same kind"
            raise Diagnostic("R060", f"the connectors do not match: {'; '.join(kinds)}", item.span, hint)
        residues = constraint_values(one, other, item, scope)
        for path, values in residues.items():
            text = f"equality of {path.lstrip('.')}: connect({item.left}, {item.right})"
            equations += [flat.Equation(v, ex.ZERO, item.span, scope.instance.name, text) for v in values]
        for key, part in a.items():
            if any(key == path or key.startswith((f"{path}.", f"{path}[")) for path in residues):
                continue
            _require_alike(part, b[key], item, scope)
            if part.kind != "fixed":
                sets.join(part, b[key], item.span, scope.instance.name)


def _is_there(ref: ast.Ref, scope: Scope) -> bool:
    try:
        return bool(connectors_in_shape(ref, scope)[0])
    except Diagnostic:
        return True


def _counted(sizes: tuple[int, ...]) -> str:
    return f"an array of {' x '.join(map(str, sizes))}" if sizes else "one connector"


def _require_alike(a: Part, b: Part, item: ast.Connect, scope: Scope) -> None:
    """Raises R060 for two scalars that are not of one kind (9.3)."""
    names, hint = f"{a.end.name} and {b.end.name}", "connect connectors of the same kind"
    if a.kind != b.kind:
        which = a.kind if a.kind not in ("potential", "fixed") else b.kind
        which = "a parameter" if which == "fixed" else f"a {which}"
        raise Diagnostic("R060", f"{names}: only one is {which}", item.span, hint)
    if (a.leaf.primitive, a.leaf.type.literals) != (b.leaf.primitive, b.leaf.type.literals):
        raise Diagnostic("R060", f"{names} are of different type", item.span, hint)
    if bool(a.leaf.causality) != bool(b.leaf.causality) and not (a.leaf.open_ended or b.leaf.open_ended):
        raise Diagnostic("R060", f"{names}: only one is input or output", item.span, hint)
    if a.kind == "fixed":
        _require_equal(a, b, item, scope.context)


def _require_equal(a: Part, b: Part, item: ast.Connect, context: Context) -> None:
    """Parameters and constants of connected connectors are equal (9.3)."""
    if a.leaf.variability != b.leaf.variability:
        names = f"{a.end.name} and {b.end.name}"
        raise Diagnostic("R060", f"{names}: only one is a constant", item.span, "connect connectors of the same kind")
    values = []
    for part in (a, b):
        value = part.leaf.element(part.leaf.binding(), part.position)
        if isinstance(value, ex.Expr):
            value = evaluate(value, context, item.span, part.end.name).value
        values.append(value)
    if values[0] != values[1]:
        message = f"{a.end.name} = {values[0]} and {b.end.name} = {values[1]} are connected"
        raise Diagnostic("R060", message, item.span, "give both the same value")
