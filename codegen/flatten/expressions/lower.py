"""Expressions of the source to values: names resolved, arrays spread into scalars, types checked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.choices import beside_unchosen, chosen_value
from lacuna.codegen.flatten.expressions.chosen_texts import are_texts, compared, joined, joined_arrays
from lacuna.codegen.flatten.expressions.constants import is_known, known
from lacuna.codegen.flatten.expressions.enumerations import enumeration_of, require_same
from lacuna.codegen.flatten.names.arithmetic import ARITHMETIC
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import (
    Array,
    ChosenText,
    Record,
    Value,
    concatenate,
    elementwise,
    holds_records,
    promote,
    scalars,
    shape_of,
    stack,
    with_scalars,
)
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, REAL, Expr
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import calls_nothing, references

Handler = Callable[..., Value]


def lower(e: ast.Expression, scope: Scope) -> Value:
    """The value of `e`. Raises R... for names, types and sizes that do not fit."""
    return scope.context.lowering.nodes[type(e)](e, scope)


def lower_results(e: ast.Expression, scope: Scope, wanted: int) -> list[Value]:
    """All results of a call, for a list of so many variables on the left. Raises R023 for anything but a call, and for
    one of fewer results."""
    if not isinstance(e, ast.Call):
        raise Diagnostic("R023", "a list on the left needs a call on the right", e.span, "(a, b) = f(x)")
    results = scope.context.lowering.results(e, scope)
    if wanted > len(results):
        message = f"{e.function} has {len(results)} results, {wanted} are wanted"
        raise Diagnostic("R023", message, e.span, "leave some out")
    return results


def lower_scalar(e: ast.Expression, scope: Scope, kind: str = "") -> Expr:
    """As `lower`, for what must be a scalar (of type `kind`; Integer serves as Real)."""
    value = lower(e, scope)
    if not isinstance(value, Expr):
        found = (
            "a String"
            if isinstance(value, str | ChosenText)
            else "a record"
            if isinstance(value, Record)
            else "an array"
        )
        raise Diagnostic("R020", f"{found} where a scalar is needed", e.span, "use one element of it")
    if kind and value.type != kind and not (kind == REAL and value.type == INTEGER):
        raise Diagnostic("R020", f"this is {value.type}, {kind} is needed", e.span, _conversion(value.type, kind))
    return value


def _conversion(have: str, need: str) -> str:
    if have == BOOLEAN:
        return "write if b then 1 else 0"
    if need == BOOLEAN:
        return "use a comparison, such as x > 0"
    return "integer(x) gives the whole number at or below x"


def modifier_value(modifier: Modifier) -> Value:
    """The value of a modifier in the scope it was written in, narrowed to its array element."""
    value = modifier.value
    if not isinstance(value, Value):
        value = lower(value, modifier.scope)
    for position, size in () if modifier.each else modifier.index:
        if not isinstance(value, Array):
            hint = "write each before it to give every element the same value"
            raise Diagnostic("R036", "one value for an array of components", modifier.span, hint)
        if value.shape[0] != size:
            message = f"{value.shape[0]} values for an array of {size} elements"
            raise Diagnostic("R036", message, modifier.span, "both need the same size")
        value = value.rows()[position - 1]
    return value


def _literal(e: ast.Literal, scope: Scope) -> Value:
    return e.value if isinstance(e.value, str) else ex.const(e.value)


def _need(value: Value, kinds: tuple[str, ...], span: Span, op: str) -> None:
    items = value.items if isinstance(value, Array) else (value,)
    for item in items:
        if not isinstance(item, Expr) or item.type not in kinds:
            found = "record" if isinstance(item, Record) else "String" if isinstance(item, str) else item.type
            wanted = " or ".join(kinds)
            hint = _conversion(found, kinds[0]) if isinstance(item, Expr) else "use numbers, or fields of the record"
            raise Diagnostic("R021", f"{op} is applied to a {found}; it needs {wanted}", span, hint)


def need_numbers(value: Value, span: Span, op: str, context: Context | None = None) -> None:
    """Raises R021 for anything but numbers; where `context` is given, for values of an enumeration too (4.9.5)."""
    _need(value, (REAL, INTEGER), span, op)
    for item in value.items if context and isinstance(value, Array) else (value,) if context else ():
        if item.type == INTEGER and enumeration_of(item, context):
            hint = "Integer(e) is the number of a literal"
            raise Diagnostic("R021", f"{op} is applied to a value of an enumeration", span, hint)


def _unary(e: ast.Unary, scope: Scope) -> Value:
    value = lower(e.operand, scope)
    if holds_records(value) and e.op != "+":
        return scope.context.lowering.overloaded(e.op, [value], e.span, scope)
    if e.op == "not":
        _need(value, (BOOLEAN,), e.span, "not")
        return elementwise(ex.logical_not, [value], e.span, "not")
    need_numbers(value, e.span, e.op, scope.context)
    return elementwise(ex.neg, [value], e.span, "a sign") if "-" in e.op else value


def _binary(e: ast.Binary, scope: Scope) -> Value:
    left = lower(e.left, scope)
    decided = e.op in ("and", "or") and isinstance(left, Expr) and ex.is_const(left) and left.value == (e.op == "or")
    try:
        right = lower(e.right, scope)
    except Diagnostic as error:
        if not decided or error.code not in (*NOT_THERE, "R051"):  # R051: the largest element of none
            raise
        return left
    if holds_records(left) or holds_records(right):
        return scope.context.lowering.overloaded(e.op, [left, right], e.span, scope)
    if e.op in ("and", "or"):
        for value in (left, right):
            _need(value, (BOOLEAN,), e.span, e.op)
        return elementwise(ex.logical_and if e.op == "and" else ex.logical_or, [left, right], e.span, e.op)
    texts = isinstance(left, str | ChosenText) and isinstance(right, str | ChosenText)
    if texts and (e.op == "+" or e.op in ex.RELATIONS):
        return joined(left, right, e.span) if e.op == "+" else compared(e.op, left, right, e.span)
    if e.op in ("+", ".+") and shape_of(left) == shape_of(right) != () and are_texts(left) and are_texts(right):
        return joined_arrays(left, right, e.span)
    if e.op in ex.RELATIONS:
        return _relation(e, left, right, scope)
    for value in (left, right):
        need_numbers(value, e.span, e.op, scope.context)
    return ARITHMETIC[e.op](left, right, e.span)


def _relation(e: ast.Binary, left: Value, right: Value, scope: Scope) -> Expr:
    for value in (left, right):
        if isinstance(value, str | ChosenText):
            raise Diagnostic("R021", f"{e.op} between a String and what is none", e.span, "compare like with like")
        if not isinstance(value, Expr):
            raise Diagnostic("R021", f"{e.op} compares scalars", e.span, "compare element by element")
    if (left.type == BOOLEAN) != (right.type == BOOLEAN):
        raise Diagnostic("R021", f"{e.op} between {left.type} and {right.type}", e.span, "compare like with like")
    if left.type == BOOLEAN and e.op not in ("==", "<>"):  # false < true (3.5)
        left, right = (ex.if_else(b, ex.const(1), ex.const(0)) for b in (left, right))
    require_same(left, right, scope.context, e.span)
    exact = e.op in ("==", "<>") and REAL in (left.type, right.type) and not scope.in_function
    if exact and not (is_known(left, scope.context) and is_known(right, scope.context)):
        hint = "compare with a tolerance, abs(a - b) < eps, or use Integers"
        raise Diagnostic("R022", f"Reals that vary cannot be compared with {e.op}", e.span, hint)
    return ex.relation(e.op, left, right)


def _if(e: ast.IfExpression, scope: Scope) -> Value:
    chosen: list[tuple[Expr, ast.Expression]] = []
    last = e.otherwise
    for written, value in e.branches:
        condition = lower_scalar(written, scope, BOOLEAN)
        if condition.op == "const" and condition.value:
            last = value
            break
        if condition.op != "const":
            chosen.append((condition, value))
            scope = replace(scope, conditional=True)
    result = _alternative(last, scope, bool(chosen))
    for condition, written in reversed(chosen):
        then = _alternative(written, scope, True)
        if isinstance(then, Diagnostic) or isinstance(result, Diagnostic):
            if is_known(condition, scope.context):
                result = then if known(condition, scope, e.span, "the condition").value else result
            else:
                result = chosen_value(condition, *_or_nothing(then, result, e, scope), written.span, scope)
        else:
            result = chosen_value(condition, then, result, written.span, scope)
    if isinstance(result, Diagnostic):
        raise result
    taken = [last, *(written for _, written in chosen)]
    for other in (*(value for _, value in e.branches), e.otherwise):
        if not any(other is one for one in taken) and calls_nothing(other):
            result = _beside(result, other, scope)
    return result


def _beside(result: Value, other: ast.Expression, scope: Scope) -> Value:
    """The result of a choice beside an alternative that is not chosen, which may have no value."""
    try:
        value = lower(other, scope)
    except Diagnostic as error:
        if error.code == "R002":
            raise
        return result
    return beside_unchosen(result, value, other.span, scope)


def _or_nothing(
    then: Value | Diagnostic, otherwise: Value | Diagnostic, e: ast.IfExpression, scope: Scope
) -> tuple[Value, Value]:
    """Both alternatives where one does not exist: in a pass of a loop, or in a function, the run may never choose it
    (`if i < n then x[i + 1] else 0`), and ends where it does. Raises the reason elsewhere."""
    other, reason = (otherwise, then) if isinstance(then, Diagnostic) else (then, otherwise)
    follows = scope.in_function or any(r.names[0] in scope.locals for r in references(e))
    if isinstance(other, Diagnostic) or not follows or not all(isinstance(s, Expr) for s in scalars(other)):
        raise reason
    nothing = with_scalars(other, (ex.nothing(s.type) for s in scalars(other)))
    return (nothing, other) if reason is then else (other, nothing)


NOT_THERE = ("R045", "R046")  # an element outside its array, a division by zero


def _alternative(written: ast.Expression, scope: Scope, chosen: bool) -> Value | Diagnostic:
    """The value of one alternative, where there is a choice the reason why it has none: it may not be the one."""
    try:
        return lower(written, scope)
    except Diagnostic as error:
        if not chosen or error.code not in NOT_THERE:
            raise
        return error


def _array(e: ast.ArrayLiteral, scope: Scope) -> Value:
    return stack([lower(x, scope) for x in e.elements], e.span)


def _matrix(e: ast.MatrixLiteral, scope: Scope) -> Value:
    """[A, B; C, D]: each with as many dimensions as the one that has most, two at least (10.4.2.1)."""
    values = [[lower(x, scope) for x in row] for row in e.rows]
    dimensions = max(2, *(len(shape_of(v)) for row in values for v in row))
    rows = [concatenate(2, [promote(v, dimensions) for v in row], e.span) for row in values]
    return concatenate(1, rows, e.span)


def _end(e: ast.End, scope: Scope) -> Value:
    if scope.end is None:
        raise Diagnostic("R048", "'end' as a value", e.span, "it stands for the last index, inside subscripts only")
    return scope.end


def _tuple(e: ast.Tuple, scope: Scope) -> Value:
    raise Diagnostic("R023", "a list in parentheses is no value", e.span, "an array is written {a, b}")


def _colon(e: ast.Colon, scope: Scope) -> Value:
    raise Diagnostic("R048", "':' as a value", e.span, "it stands for all elements, inside subscripts only")


def _partial_function(e: ast.PartialFunction, scope: Scope) -> Value:
    raise Diagnostic("R090", f"the function {e.function} where a value is needed", e.span,
                     "hand it to an input that is a function, or call it")  # fmt: skip


OPERATORS: dict[type, Handler] = {  # names and calls have files of their own
    ast.PartialFunction: _partial_function,
    ast.Literal: _literal, ast.Unary: _unary, ast.Binary: _binary, ast.IfExpression: _if, ast.ArrayLiteral: _array,
    ast.MatrixLiteral: _matrix, ast.Colon: _colon,
    ast.End: _end, ast.Tuple: _tuple,
}  # fmt: skip
