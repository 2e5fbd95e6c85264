"""Numerical value of a call of a function of the model, by running its statements on numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
import contextlib
import itertools
import math

from lacuna.codegen import flat
from lacuna.codegen.symbolic.evaluate import Value, evaluate
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.symbolic.function_tangent import by_name

STATEMENTS = 10_000  # run for one value, which takes a second: a guess that translation decides by is not worth more
DEPTH = 50  # of calls within calls

Argument = Value | None | list[Value | None]  # a scalar, or an array row by row


class _NoValue(Exception):
    """A statement reads what has no value, fails, or there are too many of them."""


class _Broken(Exception):
    """break."""


class _Returned(Exception):
    """return."""


def call_value(e: Expr, value: Callable[[Expr], Value | None], functions: dict[str, flat.Function]) -> Value | None:
    """The value of the call `e` of a function with one scalar result, `value` giving its arguments; None where it has
    none: an argument has none, an assertion fails, the function is foreign or does not end."""
    try:
        return _call(e, value, functions, itertools.count())[0]
    except (_NoValue, ArithmeticError, ValueError, IndexError):
        return None


def _call(
    e: Expr, value: Callable[[Expr], Value | None], functions: dict[str, flat.Function], clock: itertools.count,
    depth: int = 0,
) -> list[Argument]:  # fmt: skip
    """All results of a call."""
    name = str(e.value)
    if depth > DEPTH or name.split(":")[0] not in functions:
        raise _NoValue
    f = by_name(functions, name)
    arguments = [[value(x) for x in a.args] if a.op == "array" else value(a) for a in e.args]
    if any(v is None for a in arguments for v in (a if isinstance(a, list) else [a])):
        raise _NoValue
    return _Run(f, arguments, functions, clock, depth).results()


class _Run:
    """One run of one function: its variables, arrays row by row."""

    def __init__(
        self, f: flat.Function, arguments: Sequence[Argument], functions: dict[str, flat.Function],
        clock: itertools.count, depth: int,
    ):  # fmt: skip
        self._f, self._functions, self._clock, self._depth = f, functions, clock, depth
        self._variables: dict[str, Argument] = {
            n: [None] * math.prod(shape) if shape else None for n, shape in f.shapes.items()
        }
        self._variables |= dict(zip(f.inputs, arguments, strict=True))

    def results(self) -> list[Argument]:
        for name, default in self._f.defaults.items():
            self._variables[name] = self._value(default)
        with contextlib.suppress(_Returned):
            self._block(self._f.body)
        return [self._variables[n] for n in self._f.outputs]

    # -- statements -------------------------------------------------------------------------------------------

    def _block(self, statements: Sequence[flat.Statement]) -> None:
        for s in statements:
            if next(self._clock) > STATEMENTS:
                raise _NoValue
            self._statement(s)

    def _statement(self, s: flat.Statement) -> None:
        match s:
            case flat.Assign():
                whole = [self._known(x) for x in s.value.args] if s.value.op == "array" else self._known(s.value)
                self._variables[s.target] = whole
            case flat.AssignElement():
                offset = self._offset(s.target, s.indices)
                self._variables[s.target][offset] = self._known(s.value)
            case flat.AssignCall():
                found = _call(s.value, self._value, self._functions, self._clock, self._depth + 1)
                self._variables |= {t: v for t, v in zip(s.targets, found, strict=False) if t is not None}
            case flat.If():
                chosen = next((body for c, body in s.branches if self._known(c)), [])
                self._block(chosen)
            case flat.While():
                self._loop(iter(lambda: bool(self._known(s.condition)), False), None, s.body)
            case flat.For():
                self._for(s)
            case flat.Break():
                raise _Broken
            case flat.Return():
                raise _Returned
            case flat.Assert():
                if not self._known(s.condition):
                    raise _NoValue
            case _:
                raise _NoValue

    def _for(self, s: flat.For) -> None:
        first, step, last = (self._known(e) for e in (s.first, s.step, s.last))
        count = math.floor((last - first) / step) + 1 if step else 0
        self._loop((first + k * step for k in range(count)), s.variable, s.body)

    def _loop(self, rounds: Iterable[Value], variable: str | None, body: Sequence[flat.Statement]) -> None:
        with contextlib.suppress(_Broken):
            for v in rounds:
                if next(self._clock) > STATEMENTS:
                    raise _NoValue
                if variable is not None:
                    self._variables[variable] = v
                self._block(body)

    # -- expressions ------------------------------------------------------------------------------------------

    def _known(self, e: Expr) -> Value:
        found = self._value(e)
        if found is None:
            raise _NoValue
        return found

    def _value(self, e: Expr) -> Value | None:
        return evaluate(e, lambda n: self._variables.get(str(n.value)) if n.op == "var" else None, self._call)

    def _call(self, e: Expr, value: Callable[[Expr], Value | None]) -> Value | None:
        if e.value != "[]":
            return _call(e, value, self._functions, self._clock, self._depth + 1)[0]
        array, *indices = e.args
        if array.op == "array":
            items, shape = [value(x) for x in array.args], (len(array.args),)
            return items[_offset(shape, [value(i) for i in indices])]
        return self._variables[str(array.value)][self._offset(str(array.value), indices)]

    def _offset(self, name: str, indices: Sequence[Expr]) -> int:
        return _offset(self._f.shapes[name], [self._known(i) for i in indices])


def _offset(shape: Sequence[int], indices: Sequence[Value | None]) -> int:
    """Row-major offset of 1-based indices."""
    offset = 0
    for size, index in zip(shape, indices, strict=True):
        if index is None or not 1 <= index <= size:
            raise _NoValue
        offset = offset * size + int(index) - 1
    return offset
