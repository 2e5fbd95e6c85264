"""Values of if-expressions: scalars, arrays, records and Strings chosen by a condition (Modelica 3.6, 3.6.5)."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.chosen_texts import are_texts, choose
from lacuna.codegen.flatten.expressions.constants import is_known, known
from lacuna.codegen.flatten.expressions.enumerations import require_same
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import (
    Array,
    ChosenText,
    Record,
    Value,
    elementwise,
    holds_records,
    shape_of,
)
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, Expr


def chosen_value(condition: Expr, then: Value, otherwise: Value, span: Span, scope: Scope) -> Value:
    """`then` or `otherwise` by a condition that may vary in the run; by one that is known where they are not alike."""
    texts = isinstance(then, str | ChosenText)
    if texts != isinstance(otherwise, str | ChosenText):
        raise Diagnostic("R021", "one alternative only is a String", span, "make them alike")
    if texts and not is_known(condition, scope.context):
        return choose(condition, then, otherwise)
    if texts or shape_of(then) != shape_of(otherwise):
        decided = known(condition, scope, span, "the condition of alternatives of different size")
        return then if decided.value else otherwise
    if isinstance(then, Record) and isinstance(otherwise, Record) and then.fields.keys() == otherwise.fields.keys():
        fields = {n: chosen_value(condition, v, otherwise.fields[n], span, scope) for n, v in then.fields.items()}
        return Record(then.name, fields, then.cls)
    if isinstance(then, Array) and _go_by_items(then, otherwise):
        pairs = zip(then.items, otherwise.items, strict=True)
        return Array(then.shape, tuple(chosen_value(condition, a, b, span, scope) for a, b in pairs))
    if holds_records(then) or holds_records(otherwise):
        if not is_known(condition, scope.context):
            raise Diagnostic("R041", "an if-expression of different records", span, "choose between their fields")
        return then if known(condition, scope, span, "the choice of a record").value else otherwise

    def pick(a: Expr, b: Expr) -> Expr:
        if (a.type == BOOLEAN) != (b.type == BOOLEAN):
            raise Diagnostic("R021", f"one alternative is {a.type}, the other {b.type}", span, "make them alike")
        require_same(a, b, scope.context, span)
        return ex.if_else(condition, a, b)

    return elementwise(pick, [then, otherwise], span, "alternatives")


def beside_unchosen(result: Value, other: Value, span: Span, scope: Scope) -> Value:
    """`result`, of a type that goes with an alternative that a known condition leaves out (3.6.5)."""
    if isinstance(result, str | ChosenText) != isinstance(other, str | ChosenText):
        raise Diagnostic("R021", "one alternative only is a String", span, "make them alike")
    if not (isinstance(result, Expr) and isinstance(other, Expr)):
        return result
    return chosen_value(ex.TRUE, result, other, span, scope)


def _go_by_items(then: Value, otherwise: Value) -> bool:
    """Are they arrays of what is no number: of records, or of Strings?"""
    return (holds_records(then) and holds_records(otherwise)) or (are_texts(then) and are_texts(otherwise))


def merged_value(condition: Expr, then: Value, otherwise: Value, span: Span) -> Value:
    """What a variable of a function holds after an if-statement, by the condition of its branch."""
    if isinstance(then, Record) and isinstance(otherwise, Record):
        fields = {n: merged_value(condition, v, otherwise.fields[n], span) for n, v in then.fields.items()}
        return Record(then.name, fields, then.cls)
    if isinstance(then, Array) and _go_by_items(then, otherwise) and shape_of(then) == shape_of(otherwise):
        pairs = zip(then.items, otherwise.items, strict=True)
        return Array(then.shape, tuple(merged_value(condition, a, b, span) for a, b in pairs))
    if isinstance(then, str | ChosenText) and isinstance(otherwise, str | ChosenText):
        return choose(condition, then, otherwise)
    return elementwise(lambda a, b: ex.if_else(condition, a, b), [then, otherwise], span, "alternatives")
