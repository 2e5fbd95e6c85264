"""sum, product, min and max of arrays, of `e for i in r`, and of two scalars (Modelica 3.6, 10.3.4)."""

from __future__ import annotations

from collections.abc import Callable
from math import prod
from sys import float_info

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.expressions.arrays import arguments_of, array_of
from lacuna.codegen.flatten.expressions.constants import AtRunTime
from lacuna.codegen.flatten.expressions.enumerations import enumeration_of, index_type, require_same
from lacuna.codegen.flatten.expressions.lower import OPERATORS, Handler, lower, lower_scalar, need_numbers
from lacuna.codegen.flatten.expressions.reduce.open_arrays import SIZES, Elements, is_open
from lacuna.codegen.flatten.names.index_types import literals_of
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Value, fold, holds_records, scalars, shape_of, shape_text
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, REAL, Expr
from lacuna.codegen.syntax import ast


def _reduction(join: Callable[[Expr, Expr], Expr], empty: Expr | None) -> Callable[[ast.Call, Scope], Value]:
    def build(e: ast.Call, scope: Scope) -> Value:
        try:
            arguments = arguments_of(e, scope, 1, 2 if empty is None else 1)
        except SIZES as reason:
            if len(e.args) != 1 or not is_open(reason, scope):
                raise
            return _over_open(e, join, empty, scope, reason)
        if len(arguments) == 2:
            return _of_two(*arguments, join, e, scope)
        values = array_of(arguments[0], e)
        bare = isinstance(e.args[0], ast.Comprehension) and not e.args[0].braces
        own = values.shape[len(e.args[0].iterators) :] if bare else ()
        if own:
            return _of_arrays(values, own, join, e)
        if holds_records(values) and str(e.function) == "sum":
            return fold(lambda a, b: scope.context.lowering.overloaded("+", [a, b], e.span, scope), list(values.items))
        if empty is None and values.items and all(isinstance(i, Expr) and i.type == BOOLEAN for i in values.items):
            return fold(ex.logical_and if str(e.function) == "min" else ex.logical_or, list(values.items))
        need_numbers(values, e.span, str(e.function))
        items = list(values.items)
        for item in items[1:] if empty is None else ():
            require_same(items[0], item, scope.context, e.span)
        if empty is not None and any(isinstance(i, Expr) and enumeration_of(i, scope.context) for i in items):
            message = f"{e.function} is of numbers, given values of an enumeration"
            raise Diagnostic("R025", message, e.span, "Integer(e) is the number of a literal")
        if not items and empty is None and isinstance(e.args[0], ast.Comprehension):
            return _extreme(e.args[0], str(e.function) == "min", scope)
        if not items and empty is None:
            raise Diagnostic("R051", f"{e.function} of an empty array", e.span, "it needs at least one element")
        return fold(join, items) if items else empty

    return build


def _over_open(
    e: ast.Call, join: Callable[[Expr, Expr], Expr], empty: Expr | None, scope: Scope, reason: AtRunTime | Diagnostic
) -> Value:
    """The reduction of `e for i in r` where r varies, or of an array whose size does."""
    written, required = e.args[0], []
    if not isinstance(written, ast.Comprehension):
        elements = Elements(written, scope)
        if not elements.bounds:
            raise reason
        written, scope, required = elements.each(), elements.scope, elements.required
    return _looped(written, lambda value: _begun(e, value, join, empty, scope), scope, required, reason)


def _looped(
    written: ast.Comprehension, begun: Callable[[Value], tuple], scope: Scope, required: list[Expr],
    reason: AtRunTime | Diagnostic,
) -> Value:  # fmt: skip
    """By a loop of the function that runs at run time; in a model by all elements that there are."""
    if isinstance(reason, AtRunTime):
        return scope.loop(written, begun, scope, required)
    return scope.context.lowering.expanded(written, begun, scope, required, reason)


def binary(e: ast.Binary, scope: Scope) -> Value:
    """An operation of two values; the scalar product of vectors whose size varies is a sum."""
    try:
        return OPERATORS[ast.Binary](e, scope)
    except SIZES as reason:
        if e.op != "*" or not is_open(reason, scope):
            raise
        elements = Elements(e, scope)
        call = elements.summed()
        if call is None:
            raise
        scope = elements.scope
        return _looped(
            call.args[0],
            lambda value: _begun(call, value, ex.add, ex.const(0), scope),
            scope,
            elements.required,
            reason,
        )


def _begun(
    e: ast.Call, value: Value, join: Callable[[Expr, Expr], Expr], empty: Expr | None, scope: Scope
) -> tuple[Expr, Callable[[Expr, Expr], Expr]]:
    """What the reduction of such values starts with, and what goes on with it. Raises R051 for what is none."""
    if shape_of(value) and not (isinstance(e.args[0], ast.Comprehension) and not e.args[0].braces):
        hint = f"reduce each of them: {e.function}({e.function}(e) for i in r)"
        raise Diagnostic("R051", f"{e.function} of arrays over a range that varies", e.span, hint)
    if shape_of(value) and str(e.function) != "sum":
        raise _of_scalars_only(e, shape_of(value))
    least = str(e.function) == "min"
    if empty is None and isinstance(value, Expr) and value.type == BOOLEAN:
        return (ex.TRUE, ex.logical_and) if least else (ex.FALSE, ex.logical_or)
    need_numbers(value, e.span, str(e.function), scope.context)
    kind = REAL if any(s.type == REAL for s in scalars(value)) else INTEGER
    start = (_GREATEST[kind] if least else -_GREATEST[kind]) if empty is None else empty.value
    return ex.const(float(start) if kind == REAL else start), join


def _of_two(a: Value, b: Value, join: Callable[[Expr, Expr], Expr], e: ast.Call, scope: Scope) -> Expr:
    if not (isinstance(a, Expr) and isinstance(b, Expr)) or (a.type == BOOLEAN) != (b.type == BOOLEAN):
        hint = "of an array: max(x); of two numbers: max(a, b)"
        raise Diagnostic("R051", f"{e.function} of two needs scalars of one kind", e.span, hint)
    require_same(a, b, scope.context, e.span)
    if a.type != BOOLEAN:
        return join(a, b)
    return ex.logical_and(a, b) if str(e.function) == "min" else ex.logical_or(a, b)


def _of_arrays(values: Array, own: tuple[int, ...], join: Callable[[Expr, Expr], Expr], e: ast.Call) -> Value:
    """sum of `e for i in r` where e is an array; other reductions are of scalars (10.3.4.1). Raises R051."""
    if str(e.function) != "sum":
        raise _of_scalars_only(e, own)
    need_numbers(values, e.span, "sum")
    step = prod(own)
    columns = [list(values.items[k::step]) for k in range(step)]
    return Array(own, tuple(fold(join, column) if column else ex.const(0) for column in columns))


def _of_scalars_only(e: ast.Call, shape: tuple[int, ...]) -> Diagnostic:
    message = f"{e.function} of arrays {shape_text(shape)}"
    return Diagnostic("R051", message, e.span, f"what {e.function}(e for i in r) goes over is a scalar")


_GREATEST = {INTEGER: 2**31 - 1, REAL: float_info.max}


def _extreme(e: ast.Comprehension, greatest: bool, scope: Scope) -> Expr:
    """min or max of `e for i in r` over nothing: the greatest, or the least, value of the type of e (10.3.4.1)."""
    first = {i.name: _first_of(i.range, scope) for i in e.iterators}
    try:
        body = lower_scalar(e.body, scope.with_locals(**first))
    except Diagnostic as error:
        if error.code != "R045":
            raise
        body = ex.const(0.0)  # an element of an array that has none: a Real, where nothing else is said
    if body.type == BOOLEAN:
        return ex.const(greatest)
    kind = enumeration_of(body, scope.context)
    if kind and body.op == "const":
        return ex.const(type(body.value)(len(literals_of(kind, scope)) if greatest else 1))
    value = _GREATEST[body.type]
    return ex.const(value if greatest else -value)


def _first_of(written: ast.Expression | None, scope: Scope) -> Value:
    """A value of the type that an iterator over `written` has."""
    if isinstance(written, ast.Range):
        return lower(written.first, scope)
    kind = index_type(written, scope) if written is not None else None
    return kind[0] if kind else ex.const(1)


FUNCTIONS: dict[str, Handler] = {
    "sum": _reduction(ex.add, ex.const(0)), "product": _reduction(ex.mul, ex.const(1)),
    "min": _reduction(ex.minimum, None), "max": _reduction(ex.maximum, None),
}  # fmt: skip
