"""Terms along a trajectory, evaluated from their own texts; what several of them read is found once.

What is screened is so what will be simulated (`law_terms.py` says what a text may hold; `max`, `min` and `integral` are
in what readers are told). A text is parsed into its operations and never runs as a program.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from functools import lru_cache
import operator
import re

import numpy as np
from scipy.signal import lfilter

Values = np.ndarray | float
Node = tuple  # ("number", x), ("name", n), or an operation and the nodes that it takes

_OPERATIONS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
               ast.Pow: operator.pow}  # fmt: skip
_CHEAP = (operator.add, operator.sub, operator.mul, operator.neg)
_OF_VALUES = {
    "sin": np.sin, "cos": np.cos, "exp": np.exp, "tanh": np.tanh, "abs": np.abs, "sign": np.sign, "sqrt": np.sqrt,
    "max": np.maximum, "min": np.minimum, "dry": np.sign, "bounded": lambda x, q: x - np.clip(x, -q, q),
}  # fmt: skip


class Courses:
    """Terms along one trajectory, whose variables by their local names and `time` are (n,); `sizes` make the variables
    dimensionless. What takes more than a sum or a product is kept for the next term."""

    def __init__(self, trajectory: Mapping[str, np.ndarray], sizes: Mapping[str, float]) -> None:
        self.time = trajectory["time"]
        self._names = {**trajectory, **{f"{n}_ref": size for n, size in sizes.items()}}
        self._found: dict[Node, Values] = {}

    def of(self, text: str, shapes: Mapping[str, float] | None = None) -> np.ndarray:
        """(n,) of a term; `shapes` are the values of what stands in braces."""
        node = _parsed(text)
        return _everywhere(self._value(_filled(node, shapes) if shapes else node), self.time)

    def _value(self, node: Node) -> Values:
        kind = node[0]
        if kind == "number":
            return node[1]
        if kind == "name":
            return self._names[node[1]]
        if kind in _CHEAP:
            return kind(*map(self._value, node[1:]))
        if (found := self._found.get(node)) is None:
            values = map(self._value, node[1:])
            found = kind(*values) if callable(kind) else OF_TIME[kind](self.time, *values)
            self._found[node] = found
        return found


def evaluate(text: str, trajectory: Mapping[str, np.ndarray], sizes: Mapping[str, float]) -> np.ndarray:
    """(n,) of one term's text along a trajectory, as in `Courses`."""
    return Courses(trajectory, sizes).of(text)


@lru_cache(maxsize=1 << 14)  # of some places as rich as they come
def _parsed(text: str) -> Node:
    whole = re.sub(r"\{(\w+)\}", r"__\1", text).replace("^", "**")
    return _node(ast.parse(whole.strip(), mode="eval").body)


def _node(tree: ast.expr) -> Node:
    match tree:
        case ast.Constant(value=number):
            return "number", float(number)
        case ast.Name(id=name):
            return "name", name
        case ast.UnaryOp(op=ast.USub(), operand=value):
            return operator.neg, _node(value)
        case ast.BinOp(left=left, op=op, right=right):
            return _OPERATIONS[type(op)], _node(left), _node(right)
        case ast.Call(func=ast.Name(id=name), args=args):
            return _OF_VALUES.get(name, name), *map(_node, args)
    raise ValueError(f"no term of a law: {ast.unparse(tree)}")


def _filled(node: Node, shapes: Mapping[str, float]) -> Node:
    """A node with the values of shapes in their places."""
    kind = node[0]
    if kind == "name":
        return ("number", shapes[node[1][2:]]) if node[1].startswith("__") else node
    return node if kind == "number" else (kind, *[_filled(part, shapes) for part in node[1:]])


def _everywhere(values: Values, time: np.ndarray) -> np.ndarray:
    found = np.asarray(values, float)
    return found if found.shape == time.shape else np.broadcast_to(found, time.shape)


def lagged(time: np.ndarray, values: np.ndarray, tau: complex) -> np.ndarray:
    """(n,) of values (n,) behind a first-order lag of `tau` seconds, exact for values that are linear in between."""
    steps, state = np.diff(time), values[0].item()
    even = len(steps) > 0 and np.ptp(steps) <= 1e-9 * abs(tau)  # but for the rounding of times
    lasting = (steps[0] if even else steps) / tau
    keeps = np.exp(-lasting)
    mean = (1 - keeps) / lasting  # of what is kept over an interval
    added = (1 - mean) * values[1:] + (mean - keeps) * values[:-1]
    if even:
        behind, _ = lfilter([1.0], [1.0, -keeps], added, zi=[keeps * state])
        return np.concatenate([[state], behind])
    result = [state]
    for keep, more in zip(keeps.tolist(), added.tolist(), strict=True):
        state = keep * state + more
        result.append(state)
    return np.array(result)


def warmed(time: np.ndarray, values: np.ndarray, tau: float) -> np.ndarray:
    """(n,) of values (n,) behind a first-order lag that begins at nothing."""
    return lagged(time, values, tau) - values[0] * np.exp((time[0] - time) / tau)


def total(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """(n,) integral of values (n,) from the start, by trapezoids."""
    return np.concatenate([[0.0], np.cumsum(np.diff(time) * (values[1:] + values[:-1]) / 2)])


def swinging(time: np.ndarray, values: np.ndarray, w: float, z: float) -> np.ndarray:
    """(n,) of what swings behind values (n,): -(w p + 2 z p^2)/(p^2 + 2 z w p + w^2) of them, by partial fractions."""
    pole = w * complex(-z, np.sqrt(1 - z**2))
    residue = (2 * z * w**2 - w * (1 - 4 * z**2) * pole) / (2 * (pole + z * w))
    return -2 * z * values - 2 * np.real(residue / pole * lagged(time, values, -1 / pole))


def bent(time: np.ndarray, values: np.ndarray, t: float) -> np.ndarray:
    """(n,) of bristles that move with values (n,) and are straight at first: z' = (y - |y| z)/t (P. R. Dahl, AIAA
    Journal 14, 1976, with exponent one), exact along a way that is straight in between."""
    way = np.diff(time) * (values[1:] + values[:-1]) / 2 / t
    state, result = 0.0, [0.0]
    for keep, towards in zip(np.exp(-np.abs(way)).tolist(), np.sign(way).tolist(), strict=True):
        state = towards + (state - towards) * keep
        result.append(state)
    return np.array(result)


OF_TIME: dict[str, Callable[..., np.ndarray]] = {
    "lag": lagged,
    "warmth": lambda time, values, tau: warmed(time, _everywhere(values, time), tau),
    "integral": total,
    "total": lambda time, values, tau: total(time, _everywhere(values, time)) / tau,
    "spent": lambda time, values, tau: -np.expm1(-total(time, _everywhere(values, time)) / tau),
    "swing": swinging,
    "hysteresis": bent,
    "delay": lambda time, values, late, apart: np.interp(time - late, time, values),
    "onset": lambda time, values, late, apart: (
        np.interp(time - late, time, values) * np.clip((time - time[0] - late) / apart + 0.5, 0, 1)
    ),
}
