"""The size of a quantity as an expression in the parameters, and what products, quotients and powers make of sizes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
import math

from lacuna.codegen.symbolic.expr import ZERO, Expr, const, div, if_else, is_const, mul, power, relation


@dataclass(frozen=True)
class Size:
    """The size of a quantity: as an expression in parameters, with the declared values, and by which rule."""

    expression: Expr
    value: float
    reason: str = ""
    terms: int = 1  # that the expression is made of
    at_least: bool = False  # from a number that it is compared or added with: it may well be larger

    def smaller(self, other: Size) -> bool:
        """Whether it is the smaller estimate, or as large and simpler."""
        if math.isclose(self.value, other.value, rel_tol=1e-9):
            return self.terms < other.terms
        return self.value < other.value


def told(size: Size) -> Expr:
    """For the parameters of a run; a parameter that is set to zero says nothing, and then the declared ones count."""
    if is_const(size.expression):
        return size.expression
    return if_else(relation(">", size.expression, ZERO), size.expression, const(size.value))


def sized(expression: Expr, value: float, reason: str = "", terms: int = 1) -> Size | None:
    return Size(expression, value, reason, terms) if 0 < value < math.inf else None


def named(size: Size | None, reason: str) -> Size | None:
    return replace(size, reason=reason) if size else None


def largest(sizes: Sequence[Size]) -> Size | None:
    return max(sizes, key=lambda s: (s.value, -s.terms)) if sizes else None


def raised(size: Size | None, exponent: Expr) -> Size | None:
    if size is None:
        return None
    try:
        return sized(power(size.expression, exponent), size.value ** float(exponent.value))
    except (OverflowError, ZeroDivisionError):
        return None


def combined(op: str, a: Size | None, b: Size | None) -> Size | None:
    if a is None or b is None:
        return None
    value = a.value * b.value if op == "*" else a.value / b.value
    return sized((mul if op == "*" else div)(a.expression, b.expression), value, "", a.terms + b.terms)
