"""Functions that end: sqrt, log, asin, acos and powers that are no whole number have no value beyond some argument.

Between events a relation keeps its value, so a method looks a little past the end of the branch that holds, to find
where it ends. There sqrt(x) of `if x > 0 then sqrt(x) else -sqrt(-x)` has no value; nor has sqrt(abs(x)), were abs such
a branch. So

* in the branch of a relation what its guard promises is kept inside the function: sqrt(max(x, 0)). A function that
  has no value where the branch does hold keeps none;
* abs, min and max in an argument are taken as they are, without events, and so is sign(x) beside sqrt(abs(x)): the
  flow through an orifice is one law, and where it comes to rest there is no corner to stop at. The same law solved
  for the pressure, q abs(q) = dp, has no corner either: were abs(q) a branch there, it would have no solution beyond.
  It makes no difference whether the argument has a name of its own: b = abs(h); y = b^n.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.symbolic.expr import ZERO, Expr, maximum, minimum, neg, node, rebuild, sub, transform, walk
from lacuna.codegen.symbolic.leaves import leaves, parts

_FUNCTIONS = ("sqrt", "log", "log10", "asin", "acos")
_STRICT = (">", "<", ">=", "<=")


def ends(n: Expr) -> bool:
    """Whether the function `n` has no value beyond some argument."""
    if n.op == "^":
        return not (n.args[1].op == "const" and float(n.args[1].value).is_integer())
    return n.op == "call" and n.value in _FUNCTIONS


def is_call(n: Expr, name: str) -> bool:
    return n.op == "call" and n.value == name


def arguments(equations: list[flat.Equation]) -> set[Expr]:
    """The variables that stand in the arguments of functions that end."""
    found = {n for e in equations for side in (e.lhs, e.rhs) for n in walk(side) if ends(n)}
    return {v for n in found for v in leaves(n.args[0]) if v.op == "var"}


def without_corner(product: Expr, is_algebraic: Callable[[Expr], bool]) -> Expr | None:
    """sign(x) beside a factor such as sqrt(abs(x)), and abs(x) beside an algebraic x, without an event; None where the
    product is no such law."""
    factors = parts(product, ("*", "/", "neg"))
    rooted = {inner.args[0] for f in factors if ends(f) for inner in walk(f.args[0]) if is_call(inner, "abs")}
    signs = {f: node("noEvent", (f,)) for f in factors if is_call(f, "sign") and f.args[0] in rooted}
    if product.op == "*":
        own = {f for f in factors if is_algebraic(f)}
        signs |= {f: node("noEvent", (f,)) for f in factors if is_call(f, "abs") and f.args[0] in own}
    return transform(product, signs.get, {}) if signs else None


def keep_promises(equations: list[flat.Equation]) -> list[flat.Equation]:
    """Each branch with what its relation promises inside the functions that end."""
    memo: dict[Expr, Expr] = {}
    kept = []
    for e in equations:
        lhs, rhs = transform(e.lhs, lambda n: _kept(n, memo), memo), transform(e.rhs, lambda n: _kept(n, memo), memo)
        kept.append(e if lhs is e.lhs and rhs is e.rhs else replace(e, lhs=lhs, rhs=rhs))
    return kept


def _kept(n: Expr, memo: dict[Expr, Expr]) -> Expr | None:
    if n.op != "if" or n.args[0].op not in _STRICT:
        return None
    condition, then, otherwise = n.args
    left, right = condition.args if condition.op in (">", ">=") else reversed(condition.args)
    then, otherwise = (transform(b, lambda k: _kept(k, memo), memo) for b in (then, otherwise))
    return rebuild(n, (condition, _promised(then, left, right), _promised(otherwise, right, left)))


def _promised(branch: Expr, larger: Expr, smaller: Expr) -> Expr:
    """`branch` where larger > smaller: their difference, as it stands in a function that ends, is not negative."""
    up, down = sub(larger, smaller), sub(smaller, larger)
    promise = {up: maximum(up, ZERO), down: minimum(down, ZERO), neg(up): minimum(neg(up), ZERO)}

    def inside(n: Expr) -> Expr | None:
        return promise.get(n)

    def rule(n: Expr) -> Expr | None:
        return rebuild(n, tuple(transform(a, inside, {}) for a in n.args)) if ends(n) else None

    return transform(branch, rule, {})
