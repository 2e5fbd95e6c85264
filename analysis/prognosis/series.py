"""From histories to the arrays that the filter takes: the parts in service, as shares of their limit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.filter.filter import Series
from lacuna.analysis.prognosis.history import TWO_SIDED_95, History


def series_of(histories: Sequence[History], limit, bank: Bank, healthy=0.0) -> Series:
    """The parts in service, padded to the longest, as shares of `limit` above `healthy` (numbers, or one a history). A
    side of an interval that the map's edge cuts takes the other's width. Where a fleet has told the bank how tests
    of this fault scatter, they are read with that error instead: with twice or half of it as well, as the part says
    (`commons`)."""
    parts = [h.lives[-1] for h in histories]
    n = max(1, *(part.stop - part.start for part in parts))
    use, value, lower, upper = (np.full((len(parts), n), np.nan) for _ in range(4))
    interval = np.ones(len(parts))
    for b, (h, part) in enumerate(zip(histories, parts, strict=True)):
        m = part.stop - part.start
        own, severity = h.use[part] - h.use[part.start], h.severity[part]
        use[b, :m], use[b, m:] = own, own[-1]
        value[b, :m], lower[b, :m], upper[b, :m] = severity, severity - h.low[part], h.high[part] - severity
        interval[b] = usual_interval(h)
    limit, healthy = np.reshape(limit, (-1, 1)), np.reshape(healthy, (-1, 1))
    valid = np.isfinite(value)
    value = np.where(valid, (value - healthy) / limit, 0)
    below, above = (np.where(valid, side, 1) / limit / TWO_SIDED_95 for side in (lower, upper))
    floor = bank.settings.floor
    sides = [np.maximum(np.where(a > 0, a, b), floor) for a, b in ((below, above), (above, below))]
    stated = (sides[0] + sides[1]) / 2
    own = np.sqrt(np.mean(1 - np.array(bank.settings.commons)))  # of what is read with, what is a test's own
    for b, h in enumerate(histories):
        if scatter := bank.scatter.get(h.fault):
            for side in sides:
                side[b] = np.maximum(scatter.deviation(value[b], side[b]) / own, floor)
    return Series(use, value, *sides, valid, interval, stated)


def usual_interval(history: History) -> float:
    """The median use between tests; that up to the only test, where there is one."""
    steps = np.diff(history.use)
    return float(np.median(steps)) if len(steps) else float(history.use[-1] or 1.0)


def last_error(series: Series, b: int) -> float:
    """Standard deviation that the assessments state now: the median of the last five."""
    known = np.flatnonzero(series.valid[b])[-5:]
    return float(np.median(series.stated[b, known])) if len(known) else 0.0
