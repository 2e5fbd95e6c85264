"""Expressions of a model evaluated along a trajectory: every sample at once."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from lacuna.codegen.symbolic.expr import Expr

Value = np.ndarray | float

_BINARY: dict[str, Callable[[Value, Value], Value]] = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "^": np.power, "min": np.minimum,
    "max": np.maximum, "and": np.logical_and, "or": np.logical_or, "<": np.less, "<=": np.less_equal,
    ">": np.greater, ">=": np.greater_equal, "==": np.equal, "<>": np.not_equal,
}  # fmt: skip
_CALLS: dict[str, Callable[..., Value]] = {
    "abs": np.abs, "sign": np.sign, "sqrt": np.sqrt, "sin": np.sin, "cos": np.cos, "tan": np.tan, "asin": np.arcsin,
    "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2, "sinh": np.sinh, "cosh": np.cosh, "tanh": np.tanh,
    "exp": np.exp, "log": np.log, "log10": np.log10, "floor": np.floor, "ceil": np.ceil, "integer": np.floor,
    "mod": np.mod, "rem": np.fmod, "div": lambda a, b: np.trunc(a / b),
}  # fmt: skip


class NotNumeric(Exception):
    """An expression that cannot be evaluated here: it calls a function of the model, or reads what is not recorded."""


class Evaluator:
    """`leaf(node)` gives the values (n,) or a number of variables, derivatives, relations, ...; nodes are memoised."""

    def __init__(self, leaf: Callable[[Expr], Value]) -> None:
        self._leaf = leaf
        self._memo: dict[Expr, Value] = {}

    def __call__(self, e: Expr) -> Value:
        found = self._memo.get(e)
        if found is None:
            found = self._memo[e] = self._compute(e)
        return found

    def _compute(self, e: Expr) -> Value:
        if e.op == "const":
            return float(e.value)
        if not e.args or e.op in ("der", "pre"):
            return self._leaf(e)
        if e.op in ("noEvent", "smooth"):
            return self(e.args[-1])
        if e.op == "neg":
            return -self(e.args[0])
        if e.op == "not":
            return np.logical_not(self(e.args[0]))
        if e.op == "if":
            return np.where(*map(self, e.args))
        if e.op in _BINARY:
            return _BINARY[e.op](self(e.args[0]), self(e.args[1]))
        if e.op == "call" and e.value in _CALLS:
            return _CALLS[str(e.value)](*map(self, e.args))
        raise NotNumeric(f"{e.value or e.op} cannot be linearised here")


def finite(value: Callable[[Expr], Value], samples: int) -> Callable[[Expr], np.ndarray]:
    """The courses (samples,) of expressions, memoised. A slope that is infinite at single samples (a root where its
    argument is zero) is that of the sample beside it."""

    @cache
    def course(e: Expr) -> np.ndarray:
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            return _finite(np.broadcast_to(value(e), samples))

    return course


def _finite(course: np.ndarray) -> np.ndarray:
    good = np.flatnonzero(np.isfinite(course))
    if len(good) == len(course):
        return course
    if not len(good):
        raise NotNumeric("a derivative is infinite along the whole recording")
    after = np.minimum(np.searchsorted(good, np.arange(len(course))), len(good) - 1)
    return course[good[after]]
