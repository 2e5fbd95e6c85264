"""Divisions whose divisor changes with time: each may pass through zero between two steps, where nobody looks.

A division in a branch of an if-expression counts only while the branch holds: with its condition it is replaced by NaN.
Left out: divisors of parameters and discrete variables only (they change at events, where their zeros are seen), and
those that are positive by their form.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
import math

from lacuna.codegen import flat
from lacuna.codegen.structure.causal import Assignment, Division, LinearBlock, NonlinearBlock, Step
from lacuna.codegen.symbolic.expr import (
    ONE,
    RELATIONS,
    TRUE,
    Expr,
    const,
    if_else,
    is_const,
    logical_and,
    logical_not,
    node,
    walk,
)
from lacuna.codegen.symbolic.leaves import LEAF_OPS, leaves

NAN = const(math.nan)


@dataclass(frozen=True)
class Quotient:
    """numerator / divisor, each NaN where the division is not computed."""

    numerator: Expr
    divisor: Expr
    source: flat.Equation


def divisions(steps: Iterable[Step], model: flat.FlatModel) -> list[Quotient]:
    """Of the explicit form, each once."""
    found: dict[tuple[Expr, Expr], Quotient] = {}
    for expression, source in _expressions(steps):
        for numerator, divisor, condition in _quotients(expression, TRUE, set()):
            if changes(divisor, model) and not _is_positive(divisor):
                parts = (if_else(condition, numerator, NAN), if_else(condition, divisor, NAN))
                found.setdefault(parts, Quotient(*parts, source))
    return list(found.values())


def _expressions(steps: Iterable[Step]) -> Iterator[tuple[Expr, flat.Equation]]:
    for step in steps:
        match step:
            case Assignment():
                yield step.value, step.row.source
            case Division():
                yield node("/", (step.numerator, step.denominator)), step.row.source
            case LinearBlock() | NonlinearBlock():
                for a in step.assignments:
                    yield a.value, a.row.source
                for row in step.residuals:
                    yield row.lhs, row.source
                    yield row.rhs, row.source


def _quotients(e: Expr, condition: Expr, seen: set[tuple[Expr, Expr]]) -> Iterator[tuple[Expr, Expr, Expr]]:
    """(numerator, divisor, condition under which it is computed) of every division in `e`. Branches without events
    are left out: the zero of `noEvent(if abs(i) > eps then a/i else a/eps)` lies in the other branch. What makes events
    has a frozen relation in place of the comparison by now."""
    if e.op in LEAF_OPS or not e.args or (e, condition) in seen:
        return
    seen.add((e, condition))
    if e.op == "if":
        test, then, otherwise = e.args
        yield from _quotients(test, condition, seen)
        if any(n.op in RELATIONS for n in walk(test)):
            return
        yield from _quotients(then, logical_and(condition, test), seen)
        yield from _quotients(otherwise, logical_and(condition, logical_not(test)), seen)
        return
    if e.op == "/":
        yield e.args[0], e.args[1], condition
    elif e.op == "^" and is_const(e.args[1]) and e.args[1].value < 0:
        yield ONE, e.args[0], condition
    for a in e.args:
        yield from _quotients(a, condition, seen)


def changes(e: Expr, model: flat.FlatModel) -> bool:
    """Whether `e` changes between events."""
    for n in leaves(e):
        if n.op in ("der", "time"):
            return True
        if n.op == "var":
            v = model.variables[str(n.value)]
            if v.causality == "input" or (v.variability == flat.CONTINUOUS and v.type == "Real"):
                return True
    return False


def _is_positive(e: Expr, strictly: bool = True) -> bool:
    """Whether `e` is positive, or at least not negative, whatever its variables are."""
    match e.op:
        case "const":
            return e.value > 0 or (not strictly and e.value == 0)
        case "+":
            a, b = e.args
            return (_is_positive(a, strictly) and _is_positive(b, False)) or (
                _is_positive(b, strictly) and _is_positive(a, False)
            )
        case "*" if e.args[0] is e.args[1]:
            return not strictly
        case "*" | "/":
            return all(_is_positive(a, strictly) for a in e.args)
        case "^":
            return not strictly and is_const(e.args[1]) and e.args[1].value in (2, 4, 6)
        case "call" if e.value == "exp":
            return True
        case "call" if e.value in ("abs", "sqrt"):
            return not strictly or (e.value == "sqrt" and _is_positive(e.args[0]))
        case "max":
            return any(_is_positive(a, strictly) for a in e.args)
        case "if":
            return all(_is_positive(a, strictly) for a in e.args[1:])
        case "noEvent" | "smooth":
            return _is_positive(e.args[-1], strictly)
    return False
