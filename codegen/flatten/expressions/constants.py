"""Values known at translation: sizes, conditions of components, ranges. What is used so becomes structural."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.symbolic.leaves import leaves


class AtRunTime(Exception):
    """Inside a function: a value that must be known before its call turned out not to be."""


_ORDER = {"constant": 0, "parameter": 1, "discrete": 2, "continuous": 3}


def known(e: Expr, scope: Scope, span: Span, what: str) -> Expr:
    """`e` as a constant; inside a function only what does not depend on arguments, else AtRunTime is raised."""
    if scope.in_function and e.op != "const" and variability(e, scope.context) != "constant":
        raise AtRunTime(what, span)
    return evaluate(e, scope.context, span, what)


def evaluate(e: Expr, context: Context, span: Span, what: str = "this") -> Expr:
    """`e` as a constant. Raises F021 where it depends on more than constants and parameters with a value."""
    if e.op == "const":
        return e
    result = ex.transform(e, lambda n: _constant(n, context, span, what), {})
    if result.op != "const":
        hint = "use constants and parameters that have a value"
        raise Diagnostic("F021", f"{what} is not known at translation: {ex.to_text(e)}", span, hint)
    return result


def _constant(n: Expr, context: Context, span: Span, what: str) -> Expr | None:
    if n.op == "var":
        return _value_of(str(n.value), context, span, what)
    if n.op in ("noEvent", "smooth"):
        return evaluate(n.args[-1], context, span, what)
    if n.op == "annotated":
        return evaluate(n.args[0], context, span, what)
    if n.op == "if":  # the branch that does not hold need not have a value
        condition = evaluate(n.args[0], context, span, what)
        return evaluate(n.args[1] if condition.value else n.args[2], context, span, what)
    if n.op == "call" and n.value in context.functions:
        arguments = [evaluate_argument(a, context, span, what) for a in n.args]
        return context.lowering.run(str(n.value), arguments, context, span)
    return None


def evaluate_argument(e: Expr, context: Context, span: Span, what: str) -> Expr:
    if e.op == "array":
        return ex.array(*(evaluate(a, context, span, what) for a in e.args))
    return evaluate(e, context, span, what)


def _value_of(name: str, context: Context, span: Span, what: str) -> Expr:
    known = context.constants.get(name)
    if known is not None:
        context.evaluated.add(name)
        return known
    leaf, position = context.scalars[name]
    if not leaf.is_structural or leaf.is_free:
        hint = "only parameters and constants are known then"
        why = "which the initial equations determine" if leaf.is_free else "which varies in time"
        raise Diagnostic("F021", f"{what} depends on {name}, {why}", span, hint)
    if name in context.evaluating:
        circle = " -> ".join([*context.evaluating, name])
        raise Diagnostic("F022", f"parameters depend on each other: {circle}", leaf.span, "break the circle")
    context.evaluating.append(name)
    try:
        value = leaf.element(leaf.binding(), position)
        if value is None:
            value = leaf.element(leaf.attribute("start"), position)
        if value is None:
            raise Diagnostic("F023", f"{what} needs a value of {name}", leaf.span, "give it one: = ...")
        result = evaluate(value, context, leaf.span, name) if isinstance(value, Expr) else None
        kind = "String" if result is None else result.type
        if result is None or kind != leaf.primitive != ex.REAL:
            place = leaf.modifier.span if leaf.modifier.value is not None else leaf.span
            hint = f"give it a value of type {leaf.primitive}"
            raise Diagnostic("R024", f"{name} is {leaf.primitive}, its value {kind}", place, hint)
    finally:
        context.evaluating.pop()
    context.constants[name] = result
    context.evaluated.add(name)
    return result


def is_zero(e: Expr, context: Context, span: Span) -> bool:
    """Is `e` zero by the values that parameters have? Where it is they become structural, else not."""
    if not is_known(e, context):
        return False
    before = set(context.evaluated)
    if evaluate(e, context, span).value == 0:
        return True
    context.evaluated &= before
    return False


def is_known(e: Expr, context: Context) -> bool:
    """Does `e` depend on constants and parameters with a value only?"""
    return variability(e, context) in ("constant", "parameter") and not _depends_on_free(e, context)


def is_parameter(e: Expr, context: Context) -> bool:
    """Does `e` depend on constants and parameters only, those included that the initial equations determine?"""
    return variability(e, context) in ("constant", "parameter")


class _Free(dict[Expr, bool]):
    """Which expressions depend on a parameter with fixed = false."""


def _depends_on_free(e: Expr, context: Context) -> bool:
    memo = context.table(_Free)
    if e not in memo:
        entry = context.scalars.get(str(e.value)) if e.op == "var" else None
        memo[e] = (
            entry[0].is_free
            if entry
            else any(_depends_on_free(a, context) for a in (e.args[:1] if e.op == "annotated" else e.args))
        )
    return memo[e]


def variability(e: Expr, context: Context) -> str:
    """constant < parameter < discrete < continuous, by the variables in `e` and by the operators on them."""
    known = context.variabilities.get(e)
    if known is None:
        known = context.variabilities[e] = _variability(e, context)
    return known


def _variability(e: Expr, context: Context) -> str:
    if e.op == "var":
        entry = context.scalars.get(str(e.value))
        return entry[0].variability if entry else "continuous"
    if e.op in ("time", "der"):
        return "continuous"
    if e.op in ("pre", "sample", "initial", "terminal", "edge", "change"):
        return "discrete"
    if e.op == "noEvent":  # what is in it changes as its variables do (3.8.5)
        return max((variability(n, context) for n in leaves(e)), key=_ORDER.__getitem__, default="constant")
    parts = e.args[:1] if e.op == "annotated" else e.args
    found = max((variability(a, context) for a in parts), key=_ORDER.__getitem__, default="constant")
    by_events = e.op in ex.RELATIONS or (e.op == "call" and e.value in ("floor", "ceil", "integer", "div", "sign"))
    return "discrete" if by_events and found == "continuous" else found
