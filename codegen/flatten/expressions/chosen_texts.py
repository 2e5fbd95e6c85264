"""Strings that a condition chooses at run time: joined, compared, chosen between (Modelica 3.6, 3.5, 3.6.5, 3.7.1)."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.names.values import Array, ChosenText, Value, items_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import FALSE, TRUE, Expr

MAX_LETTERS = 1_000_000  # of one String: a thousand pages
MAX_ALTERNATIVES = 1000  # of all pairs where two are joined or compared
Text = str | ChosenText


def alternatives(text: Text) -> tuple[tuple[Expr, str], ...]:
    """(condition, text), the first whose condition holds being the one; the last always holds."""
    return text.alternatives if isinstance(text, ChosenText) else ((TRUE, text),)


def choose(condition: Expr, then: Text, otherwise: Text) -> Text:
    """if condition then ... else ..."""
    if condition.op == "const":
        return then if condition.value else otherwise
    first = tuple((ex.logical_and(condition, c), text) for c, text in alternatives(then))
    return _each_once((*first, *alternatives(otherwise)))


def _each_once(pairs: tuple[tuple[Expr, str], ...]) -> Text:
    """The String of these alternatives, which are no more than there are texts: sorting chooses again and again."""
    found: dict[str, Expr] = {}
    none_before = TRUE
    for condition, text in pairs:
        found[text] = ex.logical_or(found.get(text, FALSE), ex.logical_and(none_before, condition))
        none_before = ex.logical_and(none_before, ex.logical_not(condition))
    if len(found) == len(pairs):
        return ChosenText(pairs)
    *first, last = found
    return ChosenText((*((found[text], text) for text in first), (TRUE, last))) if first else last


def joined(left: Text, right: Text, span: Span) -> Text:
    """left + right."""
    longest = [max(len(text) for _, text in alternatives(one)) for one in (left, right)]
    if sum(longest) > MAX_LETTERS:
        hint = f"Strings have at most {MAX_LETTERS} letters: does a loop double one?"
        raise Diagnostic("F037", f"a String of {sum(longest)} letters", span, hint)
    if isinstance(left, str) and isinstance(right, str):
        return left + right
    pairs = _pairs(left, right, span)
    return ChosenText(tuple((condition, a + b) for condition, a, b in pairs))


def are_texts(value: Value) -> bool:
    return all(isinstance(item, str | ChosenText) for item in items_of(value))


def joined_arrays(left: Array, right: Array, span: Span) -> Array:
    """left + right, element by element."""
    return Array(left.shape, tuple(joined(a, b, span) for a, b in zip(left.items, right.items, strict=True)))


def compared(op: str, left: Text, right: Text, span: Span) -> Expr:
    """As strcmp compares, by the bytes (3.5)."""
    result: Expr = FALSE
    for condition, a, b in reversed(_pairs(left, right, span)):
        order = (a.encode() > b.encode()) - (a.encode() < b.encode())
        result = ex.if_else(condition, ex.relation(op, ex.const(order), ex.const(0)), result)
    return result


def _pairs(left: Text, right: Text, span: Span) -> list[tuple[Expr, str, str]]:
    found = [(ex.logical_and(c, d), a, b) for c, a in alternatives(left) for d, b in alternatives(right)]
    if len(found) > MAX_ALTERNATIVES:
        hint = "compare the enumerations or Booleans that the Strings are of"
        raise Diagnostic("F037", f"a String of {len(found)} alternatives", span, hint)
    return found
