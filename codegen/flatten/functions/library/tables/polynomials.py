"""One column of a table over its abscissa as a piecewise cubic polynomial, outside of the table included.

A row (x, c0, c1, c2, c3) holds from x up to the next row's x: y = c0 + c1*s + c2*s^2 + c3*s^3, s = u - x; the first
row holds before its x too. Points of one abscissa make a jump: the value at it is that of the last of them.

Slopes at the points of smooth interpolations: Akima, J. ACM 17 (1970) 589-602; Fritsch and Butland, SIAM J. Sci.
Stat. Comput. 5 (1984) 300-304; Steffen, Astron. Astrophys. 239 (1990) 443-450; modified Akima with weights
|d2 - d1| + |d2 + d1|/2.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
import itertools
import math

Row = tuple[float, float, float, float, float]
LINEAR, AKIMA, CONSTANT, FRITSCH_BUTLAND, STEFFEN, MODIFIED_AKIMA = range(1, 7)  # Modelica.Blocks.Types.Smoothness
HOLD, EXTEND, PERIODIC, REFUSE = range(1, 5)  # Modelica.Blocks.Types.Extrapolation


class TableError(ValueError):
    """A table that cannot be interpolated as asked for."""


def piecewise(x: Sequence[float], y: Sequence[float], smoothness: int, extrapolation: int) -> list[Row]:
    """The rows of y over x (ascending). Raises TableError."""
    check_abscissa(x, smoothness)
    if len(x) == 1:
        return [(x[0], y[0], 0.0, 0.0, 0.0)]
    slopes = (
        None
        if smoothness in (LINEAR, CONSTANT) or len(x) == 2
        else _slopes(x, y, smoothness, extrapolation == PERIODIC)
    )
    segments = [_segment(x, y, slopes, i) for i in range(len(x) - 1) if x[i + 1] > x[i]]
    if not segments:
        return [(x[-1], y[-1], 0.0, 0.0, 0.0)]
    first, last = segments[0], segments[-1]
    before = (*first[:3], 0.0, 0.0) if extrapolation == EXTEND else (x[0], y[0], 0.0, 0.0, 0.0)
    width = x[-1] - last[0]
    slope = last[2] + (2 * last[3] + 3 * last[4] * width) * width
    after = (x[-1], y[-1], slope if extrapolation == EXTEND else 0.0, 0.0, 0.0)
    if smoothness == CONSTANT:
        segments = [(a, b, 0.0, 0.0, 0.0) for a, b in zip(x, y, strict=True)][:-1]
    return _without_empty([before, *segments, after])


def check_abscissa(x: Sequence[float], smoothness: int) -> None:
    """Raises TableError where x is empty, not finite, or descends; a smooth curve has no two points at one abscissa."""
    if not x:
        raise TableError("the table is empty")
    if not all(map(math.isfinite, x)):
        raise TableError("the abscissa is not finite")
    for a, b in itertools.pairwise(x):
        if b < a or (b == a and smoothness not in (LINEAR, CONSTANT)):
            raise TableError(f"the abscissa {b:g} does not come after {a:g}")


def _without_empty(rows: list[Row]) -> list[Row]:
    """The first row, and of rows of one abscissa the last."""
    return [r for k, r in enumerate(rows) if k in (0, len(rows) - 1) or rows[k + 1][0] > r[0]]


def _segment(x: Sequence[float], y: Sequence[float], slopes: Sequence[float] | None, i: int) -> Row:
    """Hermite's cubic between points i and i + 1, or the straight line."""
    h = x[i + 1] - x[i]
    d = (y[i + 1] - y[i]) / h
    if slopes is None:
        return x[i], y[i], d, 0.0, 0.0
    a, b = slopes[i], slopes[i + 1]
    return x[i], y[i], a, (3 * d - 2 * a - b) / h, (a + b - 2 * d) / h**2


def _slopes(x: Sequence[float], y: Sequence[float], smoothness: int, periodic: bool) -> list[float]:
    h = [b - a for a, b in itertools.pairwise(x)]
    d = [(b - a) / w for a, b, w in zip(y, y[1:], h, strict=False)]
    if smoothness in (AKIMA, MODIFIED_AKIMA):
        return _akima(d, smoothness == MODIFIED_AKIMA, periodic)
    inner = _fritsch_butland if smoothness == FRITSCH_BUTLAND else _steffen
    if periodic:
        wrapped = inner(h[-1], h[0], d[-1], d[0])
        first = last = wrapped
    else:
        end = _three_points if smoothness == FRITSCH_BUTLAND else _steffen_end
        first, last = end(h[0], h[1], d[0], d[1]), end(h[-1], h[-2], d[-1], d[-2])
    return [first, *(inner(h[i - 1], h[i], d[i - 1], d[i]) for i in range(1, len(d))), last]


def _akima(d: list[float], modified: bool, periodic: bool) -> list[float]:
    if periodic:
        outer = [d[-2], d[-1], *d, d[0], d[1]]
    else:
        left, right = 2 * d[0] - d[1], 2 * d[-1] - d[-2]
        outer = [2 * left - d[0], left, *d, right, 2 * right - d[-1]]
    result = []
    for i in range(len(d) + 1):
        d1, d2, d3, d4 = outer[i : i + 4]
        before, after = abs(d2 - d1), abs(d4 - d3)
        if modified:
            before, after = before + abs(d2 + d1) / 2, after + abs(d4 + d3) / 2
        total = before + after
        if total > 0:
            result.append((after * d2 + before * d3) / total)
        else:
            result.append(0.0 if modified else (d2 + d3) / 2)
    return result


def _fritsch_butland(h1: float, h2: float, d1: float, d2: float) -> float:
    """The weighted harmonic mean; 0 at a turning point."""
    if d1 * d2 <= 0:
        return 0.0
    return 3 * (h1 + h2) / ((2 * h2 + h1) / d1 + (h2 + 2 * h1) / d2)


def _three_points(h1: float, h2: float, d1: float, d2: float) -> float:
    """The slope of the parabola through the three points at an end, limited so that the curve stays monotone."""
    slope = ((2 * h1 + h2) * d1 - h1 * d2) / (h1 + h2)
    if slope * d1 <= 0:
        return 0.0
    return 3 * d1 if d1 * d2 <= 0 and abs(slope) > 3 * abs(d1) else slope


def _steffen(h1: float, h2: float, d1: float, d2: float) -> float:
    parabola = (d1 * h2 + d2 * h1) / (h1 + h2)
    sign = math.copysign(1.0, d1) + math.copysign(1.0, d2)
    return sign * min(abs(d1), abs(d2), abs(parabola) / 2) if d1 * d2 > 0 else 0.0


def _steffen_end(h1: float, h2: float, d1: float, d2: float) -> float:
    slope = d1 * (1 + h1 / (h1 + h2)) - d2 * h1 / (h1 + h2)
    if slope * d1 <= 0:
        return 0.0
    return 2 * d1 if abs(slope) > 2 * abs(d1) else slope


SlopeRule = Callable[[float, float, float, float], float]
