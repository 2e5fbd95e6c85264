"""Stream connectors: inStream(h), actualStream(h) and the balance where flows mix (Modelica 3.6, chapter 15).

inStream(c.h) becomes a variable of its own, with the equation that the connections of c give it.
"""

from __future__ import annotations

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.connections.connection_sets import ConnectionSets
from lacuna.codegen.flatten.connections.connectors import End
from lacuna.codegen.flatten.expressions.constants import evaluate, is_known
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Value, elementwise
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast

SMALL_FLOW = 1e-10  # of each flow into a mixture, in its unit: the mean of all where nothing flows (15.2)


class _Asked(dict[str, Span]):
    """Stream variables whose inStream is asked for, and where."""


def in_stream(e: ast.Call, scope: Scope) -> Value:
    """What flows in through a connector would bring."""
    return elementwise(lambda x: _incoming(_stream_name(x, e, scope), e.span, scope.context), [_argument(e, scope)],
                       e.span, "inStream")  # fmt: skip


def actual_stream(e: ast.Call, scope: Scope) -> Value:
    """What flows through a connector, by the direction of the flow."""

    def build(x: Expr) -> Expr:
        name = _stream_name(x, e, scope)
        inward = ex.relation(">", _flow_of(name, scope.context), ex.const(0.0))
        return ex.if_else(inward, _incoming(name, e.span, scope.context), x)

    return elementwise(build, [_argument(e, scope)], e.span, "actualStream")


def _argument(e: ast.Call, scope: Scope) -> Value:
    if len(e.args) != 1 or e.named:
        raise Diagnostic("R050", f"{e.function} takes one argument", e.span, f"write {e.function}(port.h)")
    return lower(e.args[0], scope)


def _stream_name(x: Expr, e: ast.Call, scope: Scope) -> str:
    entry = scope.context.scalars.get(str(x.value)) if x.op == "var" else None
    if entry is None or not entry[0].stream:
        raise Diagnostic("R052", f"{e.function} is of a stream variable", e.args[0].span, "such as port.h_outflow")
    return str(x.value)


def _incoming(name: str, span: Span, context: Context) -> Expr:
    context.table(_Asked).setdefault(name, span)
    return ex.var(f"inStream({name})")


def _flow_of(name: str, context: Context) -> Expr:
    """The flow variable of the connector that a stream variable is of."""
    leaf = context.scalars[name][0]
    for element in leaf.instance.elements:
        sibling = leaf.instance.child(element)
        if isinstance(sibling, Leaf) and sibling.flow and not sibling.shape:
            return ex.var(sibling.name)
    hint = "a stream connector has exactly one flow variable"
    raise Diagnostic("R077", f"{leaf.instance.name} has a stream and no flow", leaf.span, hint)


def stream_equations(sets: ConnectionSets, context: Context) -> list[flat.Equation]:
    """Equations of all inStream that are asked for, and of stream variables of connectors seen from inside."""
    groups: dict[End, list[End]] = {}
    for group in sets.ends.groups():
        if sets.kind[group[0]] == "stream":
            groups |= dict.fromkeys(group, group)
    equations, done = [], set()
    for end, group in groups.items():
        if end.outside:
            root = sets.ends.find(end)
            value = _mixture(end, group, sets.span[root], context)
            text = f"mixed stream: {end.name}"
            equations.append(flat.Equation(ex.var(end.name), value, sets.span[root], sets.origin[root], text))
    asked = context.table(_Asked)
    while len(done) < len(asked):
        for name, span in list(asked.items()):
            if name not in done:
                done.add(name)
                end = End(name, False)
                value = _mixture(end, groups.get(end, [end]), span, context)
                variable = ex.var(f"inStream({name})")
                equations.append(flat.Equation(variable, value, span, "", f"inStream({name})"))
    return equations


def stream_variables(model: flat.FlatModel, context: Context) -> None:
    """Add the variables that stand for inStream(...), each like the one it is of."""
    for name in context.table(_Asked):
        like = model.variables[name]
        new = f"inStream({name})"
        model.variables[new] = flat.Variable(
            new, like.span, like.type, flat.CONTINUOUS, unit=like.unit, nominal=like.nominal, start=like.start
        )


def _mixture(end: End, group: list[End], span: Span, context: Context) -> Expr:
    """What the other connectors of a set bring to `end`: the mean, weighted by their flows into the set."""
    others = [e for e in group if e != end]
    if len(others) > 1:
        feeding = [e for e in others if _may_feed(e, span, context)]
        others = feeding if feeding or not end.outside else others
    inside = [e for e in others if not e.outside]
    outside = [e for e in others if e.outside]
    contents = [ex.var(e.name) for e in inside] + [_incoming(e.name, span, context) for e in outside]
    if not contents:
        return ex.var(end.name)
    if len(contents) == 1:
        return contents[0]
    small = ex.const(SMALL_FLOW)
    flows = [ex.neg(_flow_of(e.name, context)) for e in inside] + [_flow_of(e.name, context) for e in outside]
    weights = [_at_least(flow, small) for flow in flows]
    total, carried = weights[0], ex.mul(weights[0], contents[0])
    for weight, content in zip(weights[1:], contents[1:], strict=True):
        total, carried = ex.add(total, weight), ex.add(carried, ex.mul(weight, content))
    return ex.div(carried, total)


def _may_feed(end: End, span: Span, context: Context) -> bool:
    """Does a connector ever bring something to the set? None does whose flow is bound to one direction (15.2)."""
    leaf, position = context.scalars[str(_flow_of(end.name, context).value)]
    bound = leaf.element(leaf.attribute("max" if end.outside else "min"), position)
    if not isinstance(bound, Expr) or not is_known(bound, context):
        return True
    least = evaluate(bound, context, span, "a bound of a flow").value
    return least > 0 if end.outside else least < 0


def _at_least(flow: Expr, small: Expr) -> Expr:
    return ex.special("noEvent", ex.if_else(ex.relation(">", flow, small), flow, small), type=ex.REAL)
