"""Numerical value of an expression, for start values, pivots and tests."""

from __future__ import annotations

from collections.abc import Callable

from lacuna.codegen.symbolic.expr import BUILTINS, Expr, const, rebuild

Value = float | int | bool


Call = Callable[[Expr, Callable[[Expr], "Value | None"]], "Value | None"]


def evaluate(e: Expr, leaf: Callable[[Expr], Value | None], call: Call | None = None) -> Value | None:
    """The value of `e` where `leaf(node)` gives the leaves and `call(node, value)` the calls of functions of the model
    and of elements of arrays; None where a leaf, a function or its domain has none."""
    memo: dict[Expr, Value | None] = {}

    def value(n: Expr) -> Value | None:
        if n not in memo:
            memo[n] = compute(n)
        return memo[n]

    def compute(n: Expr) -> Value | None:
        if n.op == "const":
            return n.value
        if not n.args or n.op in ("der", "pre"):
            return leaf(n)
        if n.op == "call" and call is not None and n.value not in BUILTINS:
            return call(n, value)
        if n.op in ("noEvent", "smooth"):
            return value(n.args[-1])
        if n.op == "annotated":
            return value(n.args[0])
        if n.op == "if":
            condition = value(n.args[0])
            return None if condition is None else value(n.args[1] if condition else n.args[2])
        arguments = [value(a) for a in n.args]
        if None in arguments:
            return None
        try:
            folded = rebuild(n, tuple(map(const, arguments)))
        except (OverflowError, ValueError):
            return None
        return folded.value if folded.op == "const" else None

    return value(e)
