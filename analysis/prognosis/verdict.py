"""Whether there is anything to forecast: contradictions in a history, too little of it, and no growth."""

from __future__ import annotations

from dataclasses import dataclass
import math

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from lacuna.analysis.prognosis.filter.settings import DEFAULT
from lacuna.analysis.prognosis.history import TWO_SIDED_95, History

FORECAST, TOO_EARLY, STEADY = "forecast", "too_early", "steady"
BEYOND = "what was read lies beyond the last limit: repeat the test, or remove the part"
WIDE, UNSEEN = "lives that differ tenfold agree with the tests", "no growth can be told yet"
DECADE = 10.0  # between the ends of the 80 % interval: wider, no removal can be planned by it
SETTLED = 0.05  # probability of the limit within as much use again as was watched, below which a part is called steady
MOST = int(DEFAULT.lives[1] / 2)  # tests of a part: lives of which these are the first half are not believed to be
FEWEST = 3  # tests of a part: two give a rate, the third can contradict it
INCOHERENT = 0.25  # share of outliers beyond which the tests are not one part's
SEEN = 2.0  # standard deviations of the trend, below which growth is not told from none
FALL = (
    6.0  # standard deviations by which a part that cannot heal may seem to: a median of three has outliers of its own
)


@dataclass(frozen=True)
class _Part:
    """Tests of the part in service that have a severity."""

    use: np.ndarray
    severity: np.ndarray
    sd: np.ndarray
    outlier: np.ndarray  # bool


def verdict_on(h: History, outlier: np.ndarray, quantiles: np.ndarray, again: float, horizon: float,
               removal: float = math.inf):  # fmt: skip
    """(verdict, reason, warnings). `quantiles` of the use that remains to the last limit, which is at a severity of
    `removal`; `again` the probability that it is reached within as much use again as was watched. Where nothing is
    forecast though the last test reads beyond the limit, a warning says so."""
    rows = np.arange(h.lives[-1].start, h.lives[-1].stop)
    rows = rows[np.isfinite(h.severity[rows])]
    sd = (h.high - h.low)[rows] / 2 / TWO_SIDED_95
    part = _Part(h.use[rows], h.severity[rows], np.maximum(sd, 1e-9), outlier[rows - h.lives[-1].start] > 0.5)
    beyond = (BEYOND,) if len(rows) and (quantiles[2] == 0 or part.severity[-1] >= removal) else ()
    if h.doubts:
        return TOO_EARLY, "the history contradicts itself", beyond
    if len(rows) < FEWEST:
        tests = f"{len(rows) or 'no'} {'test' if len(rows) == 1 else 'tests'} of this part with a severity"
        return TOO_EARLY, f"{tests}; a trend needs {FEWEST}", beyond
    if len(rows) > MOST:
        every = -(-len(rows) // MOST)
        return TOO_EARLY, f"{len(rows)} tests of one part; at most {MOST} are read: give one of {every}", beyond
    if contradiction := _contradiction(part, h.unit):
        return TOO_EARLY, "the tests contradict each other", (contradiction, *beyond)
    _, low, median, high, _ = quantiles
    if median == 0:
        return FORECAST, "", ()
    kept = ~part.outlier
    grows = trend(part.use[kept], part.severity[kept], part.sd[kept]) > SEEN
    if grows and median <= horizon and high <= DECADE * low:
        return FORECAST, "", ()
    if again < SETTLED:
        return STEADY, "the limit is not reached within as much use again as was watched", beyond
    return TOO_EARLY, WIDE if grows else UNSEEN, beyond


def tells(verdict: str, reason: str) -> bool:
    """Whether the intervals of such a forecast say something: not where the tests contradict each other, or are too
    few to say anything that the prior did not."""
    return verdict != TOO_EARLY or reason in (WIDE, UNSEEN)


def trend(use: np.ndarray, value: np.ndarray, sd: np.ndarray) -> float:
    """The slope of a straight line through the tests, in its standard deviations; 0 where they are too few."""
    if len(use) < FEWEST:
        return 0.0
    w = 1 / sd**2
    u = use - (w * use).sum() / w.sum()
    return float((w * u * value).sum() / np.sqrt((w * u * u).sum()))


def _contradiction(part: _Part, unit: str) -> str:
    """What in the tests cannot be one part's, or nothing."""
    n = len(part.use)
    if n >= 2 * FEWEST and part.outlier.sum() > INCOHERENT * n:
        return f"{part.outlier.sum()} of {n} tests do not fit the others: are some another actuator's?"
    if n >= 2 * FEWEST:
        middle = np.median(sliding_window_view(part.severity, FEWEST), axis=-1)
        error = sliding_window_view(part.sd, FEWEST).mean(axis=-1)
        falls = middle[:-FEWEST] - middle[FEWEST:] > FALL * np.hypot(error[:-FEWEST], error[FEWEST:])
        if falls.any():
            place = f"severity falls at {unit} {part.use[FEWEST + int(np.argmax(falls))]:g}"
            return f"{place}: a replacement that is not recorded, or another actuator's tests?"
    if n >= 2 * FEWEST and part.outlier[-FEWEST:].all():
        return f"the last {FEWEST} tests do not fit those before: another actuator's, or a sudden fault?"
    return ""
