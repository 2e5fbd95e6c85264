"""e = a v + b with a and b free of v: extraction of linear coefficients, and when `a` is safely not zero."""

from __future__ import annotations

from collections.abc import Callable

from lacuna.codegen.symbolic.expr import ONE, ZERO, Expr, add, div, if_else, is_const, mul, neg, sub, table
from lacuna.codegen.symbolic.leaves import LEAF_OPS, depends, leaves

Coefficients = tuple[Expr, Expr]


def affine(e: Expr, v: Expr, memo: dict[Expr, Coefficients | None] | None = None) -> Coefficients | None:
    """(a, b) with e = a v + b, or None where `e` is not affine in the leaf `v`."""
    if not depends(e, v):
        return ZERO, e
    if e is v:
        return ONE, ZERO
    memo = {} if memo is None else memo
    if e not in memo:
        memo[e] = _affine(e, v, memo)
    return memo[e]


def _affine(e: Expr, v: Expr, memo: dict[Expr, Coefficients | None]) -> Coefficients | None:
    if e.op == "if":
        if depends(e.args[0], v):
            return None
        parts = [affine(a, v, memo) for a in e.args[1:]]
        if None in parts:
            return None
        (a1, b1), (a2, b2) = parts
        return if_else(e.args[0], a1, a2), if_else(e.args[0], b1, b2)
    if e.op not in ("+", "-", "neg", "*", "/"):
        return None
    parts = [affine(a, v, memo) for a in e.args]
    if None in parts:
        return None
    if e.op == "neg":
        return neg(parts[0][0]), neg(parts[0][1])
    (a1, b1), (a2, b2) = parts
    if e.op == "+":
        return add(a1, a2), add(b1, b2)
    if e.op == "-":
        return sub(a1, a2), sub(b1, b2)
    if e.op == "*":
        if is_const(a1, 0):
            return mul(b1, a2), mul(b1, b2)
        return (mul(a1, b2), mul(b1, b2)) if is_const(a2, 0) else None
    return (div(a1, b2), div(b1, b2)) if is_const(a2, 0) else None


def offset(a: Expr, b: Expr) -> float | None:
    """a - b where that is a number whatever varies in both: of `i + 1` and `i - 1`. None otherwise."""
    terms = _terms(sub(a, b), {})
    number = terms.pop(ONE, 0)
    return None if any(terms.values()) else number


def _terms(e: Expr, memo: dict[Expr, dict[Expr, float]]) -> dict[Expr, float]:
    """What `e` is the sum of, with numbers as factors; ONE stands for the number beside."""
    if e in memo:
        return memo[e]
    found: dict[Expr, float] = {}
    factors = _factors(e)
    if e.op == "const":
        found[ONE] = e.value
    elif factors:
        for part, factor in factors:
            for term, times in _terms(part, memo).items():
                found[term] = found.get(term, 0) + factor * times
    else:
        found[e] = 1
    memo[e] = found
    return found


def _factors(e: Expr) -> list[tuple[Expr, float]]:
    """The parts that `e` is a sum of, and their factors."""
    if e.op in ("+", "-", "neg"):
        return list(zip(e.args, {"+": (1, 1), "-": (1, -1), "neg": (-1,)}[e.op], strict=True))
    if e.op == "*":
        return [(x, y.value) for x, y in (e.args, e.args[::-1]) if y.op == "const"][:1]
    return []


def nonlinear(e: Expr) -> frozenset[Expr]:
    """The leaves in which `e` is not affine; memoised on the hash-consed nodes."""
    memo = table().nonlinear
    found = memo.get(e)
    if found is None:
        found = memo[e] = _leaves_of_nonlinear(e)
    return found


def _leaves_of_nonlinear(e: Expr) -> frozenset[Expr]:
    if e.op in LEAF_OPS or e.op == "const":
        return frozenset()
    if e.op not in ("+", "-", "neg", "*", "/", "if"):
        return leaves(e)
    inside = frozenset().union(*map(nonlinear, e.args))
    if e.op == "*":
        return inside | (leaves(e.args[0]) & leaves(e.args[1]))
    if e.op == "/":
        return inside | leaves(e.args[1])
    return inside | leaves(e.args[0]) if e.op == "if" else inside


def isolate(lhs: Expr, rhs: Expr, v: Expr) -> tuple[Expr, Expr] | None:
    """(numerator, denominator) with v = numerator / denominator equivalent to lhs = rhs; None where not affine."""
    left, right = affine(lhs, v), affine(rhs, v)
    if left is None or right is None:
        return None
    (a1, b1), (a2, b2) = left, right
    if is_const(a1, 0):
        return sub(b1, b2), a2
    return sub(b2, b1), sub(a1, a2)


UNSAFE = 9
NEGLIGIBLE = 1e-6  # a branch this much smaller than another is there to regularise; dividing by it loses the digits


def _branches(a: Expr) -> list[Expr]:
    return _branches(a.args[1]) + _branches(a.args[2]) if a.op == "if" else [a]


def division_rank(a: Expr, parameter_value: Callable[[Expr], float | None]) -> int:
    """How safe it is to divide by `a`: 0 a constant, 1 an expression in parameters that is not zero at their
    declared values, UNSAFE otherwise. `parameter_value(e)` evaluates an expression in parameters, None if it is not."""
    if a.op == "const":
        return 0 if a.value else UNSAFE
    if a.op == "if":
        sizes = [abs(size) for branch in _branches(a) if (size := parameter_value(branch)) is not None]
        if sizes and min(sizes) < NEGLIGIBLE * max(sizes):
            return UNSAFE
        return max(division_rank(branch, parameter_value) for branch in _branches(a))
    if a.op == "neg":
        return division_rank(a.args[0], parameter_value)
    if a.op == "*":
        return max(division_rank(x, parameter_value) for x in a.args)
    if a.op == "/":
        return max(1, division_rank(a.args[0], parameter_value))
    if not leaves(a):
        return UNSAFE
    value = parameter_value(a)
    return 1 if value else UNSAFE
