"""Symbolic forward differentiation of expressions, branch by branch.

One function serves partial derivatives (one seed), Jacobian columns (seeds carried through a sequence of
assignments) and time derivatives (index reduction): only the seeds of the leaves differ.
Relations, floor, ceil, integer, div, sign and pre-values are piecewise constant: derivative 0.
What a model annotates a function with is its derivative in time; other ones are those of the function's body.
"""

from __future__ import annotations

from collections.abc import Callable
from collections.abc import Set as AbstractSet

from lacuna.codegen.symbolic.annotated import Rules, by_rule
from lacuna.codegen.symbolic.expr import (  # fmt: skip
    BUILTINS,
    ONE,
    REAL,
    ZERO,
    Expr,
    add,
    array,
    call,
    const,
    div,
    if_else,
    is_const,
    mul,
    neg,
    node,
    power,
    relation,
    special,
    sub,
)
from lacuna.codegen.symbolic.leaves import LEAF_OPS, leaves

TANGENT = ":tangent"  # suffix of the name of a function's directional derivative

_TWO = const(2.0)


def _tangent_tan(a: Expr, e: Expr) -> Expr:
    return add(ONE, mul(e, e))


# d f(a) / da, from the argument and the call itself (shared in the generated code).
_DERIVATIVE: dict[str, Callable[[Expr, Expr], Expr]] = {
    "sqrt": lambda a, e: div(const(0.5), e),
    "sin": lambda a, e: call("cos", a),
    "cos": lambda a, e: neg(call("sin", a)),
    "tan": _tangent_tan,
    "asin": lambda a, e: div(ONE, call("sqrt", sub(ONE, mul(a, a)))),
    "acos": lambda a, e: div(const(-1.0), call("sqrt", sub(ONE, mul(a, a)))),
    "atan": lambda a, e: div(ONE, add(ONE, mul(a, a))),
    "sinh": lambda a, e: call("cosh", a),
    "cosh": lambda a, e: call("sinh", a),
    "tanh": lambda a, e: sub(ONE, mul(e, e)),
    "exp": lambda a, e: e,
    "log": lambda a, e: div(ONE, a),
    "log10": lambda a, e: div(const(0.4342944819032518), a),
    "abs": lambda a, e: if_else(relation(">=", a, ZERO), ONE, const(-1.0)),
}

_STEPWISE = ("sign", "floor", "ceil", "integer", "div")


class Differentiator:
    """Directional derivative for fixed seeds; `seed(leaf)` is the derivative of a leaf. Reuse it: it memoises.

    `active`, where it is known, holds the leaves whose seeds are not zero: what has none of them is not looked into.
    `rules` are those of annotated values, where time is what is differentiated by.
    """

    def __init__(
        self, seed: Callable[[Expr], Expr], active: AbstractSet[Expr] | None = None, rules: Rules | None = None
    ):
        self._seed, self._active, self._rules = seed, active, rules or {}
        self._memo: dict[Expr, Expr] = {}

    def __call__(self, e: Expr) -> Expr:
        found = self._memo.get(e)
        if found is None:
            found = self._memo[e] = self._differentiate(e)
        return found

    def _differentiate(self, e: Expr) -> Expr:
        if e.op == "const" or (e.type != REAL and e.op != "var"):
            return ZERO
        if e.op in LEAF_OPS:
            return self._seed(e) if e.type == REAL else ZERO
        if not e.args:
            return ZERO
        if self._active is not None and e.op != "array" and self._active.isdisjoint(leaves(e)):
            return ZERO  # of an array argument, the derivative has its elements
        return getattr(self, "_" + _RULES[e.op])(e)

    def _sum(self, e: Expr) -> Expr:
        a, b = map(self, e.args)
        return add(a, b) if e.op == "+" else sub(a, b)

    def _negation(self, e: Expr) -> Expr:
        inner = self(e.args[0])
        return ZERO if is_const(inner, 0) else neg(inner)  # never -0.0

    def _product(self, e: Expr) -> Expr:
        a, b = e.args
        return add(mul(self(a), b), mul(a, self(b)))

    def _quotient(self, e: Expr) -> Expr:
        a, b = e.args
        return div(sub(self(a), mul(e, self(b))), b)

    def _power(self, e: Expr) -> Expr:
        a, b = e.args
        da, db = self(a), self(b)
        result = ZERO
        if not is_const(da, 0):
            if is_const(b, 2):
                result = mul(mul(_TWO, a), da)
            else:
                result = mul(mul(b, power(a, sub(b, const(1)) if is_const(b) else sub(b, ONE))), da)
        if not is_const(db, 0):
            result = add(result, mul(mul(e, call("log", a)), db))
        return result

    def _choice(self, e: Expr) -> Expr:
        condition, a, b = e.args
        return if_else(condition, self(a), self(b))

    def _extremum(self, e: Expr) -> Expr:
        a, b = e.args
        return if_else(relation("<=" if e.op == "min" else ">=", a, b), self(a), self(b))

    def _wrapper(self, e: Expr) -> Expr:
        return special("noEvent", self(e.args[-1]), type=REAL)

    def _annotated(self, e: Expr) -> Expr:
        found = by_rule(e, self._rules, self)
        return self(e.args[0]) if found is None else found

    def _carriage(self, e: Expr) -> Expr:
        """What an end of a pipe holds, by the position; its bends are few, and a slope of its slope is not kept."""
        number, end, x, order = e.args
        inner = self(x)
        if is_const(inner, 0) or not is_const(order, 0):
            return ZERO
        return mul(special("carried", number, end, x, ONE, type=REAL), inner)

    def _elements(self, e: Expr) -> Expr:
        return array(*map(self, e.args))

    def _call(self, e: Expr) -> Expr:
        name, args = str(e.value), e.args
        if name in _STEPWISE:
            return ZERO
        if name in _DERIVATIVE:
            inner = self(args[0])
            return ZERO if is_const(inner, 0) else mul(_DERIVATIVE[name](args[0], e), inner)
        if name == "atan2":
            y, x = args
            return div(sub(mul(x, self(y)), mul(y, self(x))), add(mul(x, x), mul(y, y)))
        if name in ("mod", "rem"):
            x, y = args
            turns = call("floor" if name == "mod" else "div", *((div(x, y),) if name == "mod" else (x, y)))
            return sub(self(x), mul(turns, self(y)))
        if name == "[]":
            inner = self(args[0])
            return ZERO if is_const(inner, 0) else call("[]", inner, *args[1:])
        assert name not in BUILTINS, name
        return self._user_call(e)

    def _user_call(self, e: Expr) -> Expr:
        tangents = tuple(map(self, e.args))
        if all(is_const(d, 0) or (d.op == "array" and all(is_const(x, 0) for x in d.args)) for d in tangents):
            return ZERO
        return node("call", e.args + tangents, f"{e.value}{TANGENT}", REAL)


_RULES = {
    "+": "sum", "-": "sum", "neg": "negation", "*": "product", "/": "quotient", "^": "power", "if": "choice",
    "min": "extremum", "max": "extremum", "noEvent": "wrapper", "smooth": "wrapper", "array": "elements",
    "call": "call", "carried": "carriage", "annotated": "annotated",
}  # fmt: skip


def partial(e: Expr, leaf: Expr) -> Expr:
    """d e / d leaf, other leaves held."""
    return Differentiator(lambda n: ONE if n is leaf else ZERO, {leaf})(e)
