"""What every operator is worth: the specification's words in plain Python and NumPy, none of it Lacuna's.

A value is a float, an int, a bool, or an array of one of them. An enumeration's literal is its number, from 1.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import math

import numpy as np

Value = float | int | bool | np.ndarray
LARGEST = 1e6  # of what an oracle follows: products of a few stay exact in an Integer and far from overflow
NEAR = 1e-6  # relative distance from a switching point within which either side may be right


class Unfit(Exception):
    """The draw has no value here: a domain is left, a number grows, a loop does not end."""


class Watch:
    """Whether a comparison of the last evaluation was close to switching."""

    close = False


@contextmanager
def watched() -> Iterator[type[Watch]]:
    Watch.close = False
    yield Watch


def checked(value: Value) -> Value:
    if isinstance(value, np.ndarray) and value.dtype == bool:
        return value
    if not np.all(np.isfinite(value)) or np.any(np.abs(value) > LARGEST):
        raise Unfit
    return value


def _note(a: Value, b: Value) -> None:
    """Exact Integers never lie near a switching point; a Real that is one by chance is exact, too, where it stays."""
    gap = np.abs(np.asarray(a, float) - np.asarray(b, float))
    if any(_is_real(x) for x in (a, b)) and np.any(gap <= NEAR * (1 + np.abs(np.asarray(a, float)))):
        Watch.close = True


def _is_real(x: Value) -> bool:
    return isinstance(x, float) or (isinstance(x, np.ndarray) and x.dtype == float)


def _round(x: Value) -> Value:
    """Notes how near `x` is to a whole number."""
    if _is_real(x):
        _note(x, np.round(x))
    return x


def relation(compare: Callable) -> Callable:
    def of(a: Value, b: Value) -> bool:
        _note(a, b)
        return bool(compare(a, b))

    return of


def divide(a: Value, b: Value) -> Value:
    if np.any(np.abs(np.asarray(b, float)) < 1e-3):
        raise Unfit
    return np.asarray(a, float) / b if isinstance(a, np.ndarray) or isinstance(b, np.ndarray) else float(a) / b


def power(a: Value, b: Value) -> Value:
    """Of Reals where the base is not negative, or the exponent a whole literal."""
    base = np.asarray(a, float)
    if (np.any(base < 0) and not float(b).is_integer()) or (np.any(np.abs(base) < 1e-3) and float(b) <= 0):
        raise Unfit
    found = base ** float(b)
    return found if isinstance(a, np.ndarray) else float(found)


def of_quotient(rounding: Callable[[float], int], rest: bool) -> Callable:
    """div, mod and rem: of Integers exact, of Reals by rounding the quotient."""

    def of(a: Value, b: Value) -> Value:
        whole = not (_is_real(a) or _is_real(b))
        if abs(b) < 1e-3:
            raise Unfit
        if whole:
            quotient = a // b if rounding is math.floor else abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
        else:
            quotient = rounding(_round(float(a) / float(b)))
        found = a - quotient * b if rest else quotient
        return found if whole else float(found)

    return of


def to_integer(x: Value) -> int:
    return math.floor(_round(x))


def rounded(rounding: Callable[[float], int]) -> Callable:
    return lambda x: float(rounding(_round(float(x)))) if _is_real(x) else int(x)


def sign(x: Value) -> int:
    _note(x, 0)
    return int(x > 0) - int(x < 0)


def real_function(f: Callable[[float], float], low: float = -math.inf, high: float = math.inf) -> Callable:
    """Element by element, where every argument lies between `low` and `high`."""

    def of(x: Value) -> Value:
        if np.any(np.asarray(x) < low) or np.any(np.asarray(x) > high):
            raise Unfit
        return np.vectorize(f, otypes=[float])(x) if isinstance(x, np.ndarray) else f(float(x))

    return of


def as_kind(value: Value, kind: str) -> Value:
    """A number taken for a Real where one is wanted."""
    if kind != "R" or _is_real(value):
        return value
    return value.astype(float) if isinstance(value, np.ndarray) else float(value)
