"""From histories to the arrays that the filter takes: the parts in service, as shares of their limit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lacuna.analysis.prognosis.filter.filter import Series
from lacuna.analysis.prognosis.history import TWO_SIDED_95, History


def series_of(histories: Sequence[History], limit: float, floor: float, healthy: float = 0.0) -> Series:
    """The parts in service, padded, as shares of `limit`. A side of an interval that the map's edge cuts takes the
    other's width."""
    parts = [(h, h.lives[-1]) for h in histories]
    n = max(1, *(part.stop - part.start for _, part in parts))
    shape = (len(parts), n)
    use, value, below, above = (np.zeros(shape) for _ in range(4))
    valid, interval = np.zeros(shape, bool), np.ones(len(parts))
    for b, (h, part) in enumerate(parts):
        m = part.stop - part.start
        own = h.use[part] - h.use[part.start]
        use[b, :m], use[b, m:] = own, own[-1]
        known = np.isfinite(h.severity[part])
        valid[b, :m] = known
        value[b, :m] = np.where(known, h.severity[part] - healthy, 0) / limit
        lower = np.where(known, h.severity[part] - h.low[part], 1) / limit / TWO_SIDED_95
        upper = np.where(known, h.high[part] - h.severity[part], 1) / limit / TWO_SIDED_95
        below[b, :m] = np.maximum(np.where(lower > 0, lower, upper), floor)
        above[b, :m] = np.maximum(np.where(upper > 0, upper, lower), floor)
        interval[b] = usual_interval(h)
    below[:, :] = np.where(below > 0, below, 1)
    above[:, :] = np.where(above > 0, above, 1)
    return Series(use, value, below, above, valid, interval)


def usual_interval(history: History) -> float:
    """The median use between tests; that up to the only test, where there is one."""
    steps = np.diff(history.use)
    return float(np.median(steps)) if len(steps) else float(history.use[-1] or 1.0)


def joined(parts: Sequence[Series]) -> Series:
    """Series of several histories as one, padded to the longest."""
    n = max(p.use.shape[1] for p in parts)

    def padded(values: np.ndarray, mode: str) -> np.ndarray:
        return np.pad(values, ((0, 0), (0, n - values.shape[1])), mode=mode)

    return Series(
        *(
            np.concatenate([padded(getattr(p, name), "edge") for p in parts])
            for name in ("use", "value", "below", "above")
        ),
        np.concatenate([padded(p.valid, "constant") for p in parts]),
        np.concatenate([p.interval for p in parts]),
    )


def last_error(series: Series, b: int) -> float:
    """Standard deviation of the assessments now: the median of the last five."""
    known = np.flatnonzero(series.valid[b])[-5:]
    return float(np.median((series.below[b, known] + series.above[b, known]) / 2)) if len(known) else 0.0
