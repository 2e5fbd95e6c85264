"""Forecasts: from histories to what remains, and how sure that is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
import math

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.filter.bank import Bank, Beliefs, in_use
from lacuna.analysis.prognosis.filter.crossing import Remaining, remaining
from lacuna.analysis.prognosis.filter.filter import Series, Step, run
from lacuna.analysis.prognosis.filter.scatter import Life, Scatter, scatter_of
from lacuna.analysis.prognosis.history import History
from lacuna.analysis.prognosis.series import last_error, series_of
from lacuna.analysis.prognosis.verdict import FEWEST, FORECAST, tells, verdict_on

LEVELS = (0.025, 0.1, 0.5, 0.9, 0.975)
BATCH = 64  # histories a call of the filter: its arrays then stay in the cache
LONG = 10.0  # the horizon, in the use that was watched: a forecast further ahead than ten times the past is a guess
LISTED = 200  # future tests that are listed
FLEET = 20  # ended lives from which on a fleet has a prior of its own


@dataclass(frozen=True)
class Limits:
    """Severities at which bands begin, rising; the last one is where a part is removed.

    `first`, `last`: ends of the map. `healthy`: severity of a new part, from which the laws count. People read a
    severity times `scale` in `unit`.
    """

    names: tuple[str, ...]
    values: tuple[float, ...]
    first: float
    last: float
    healthy: float = 0.0
    unit: str = ""
    scale: float = 1.0

    def __post_init__(self):
        if not all(a < b for a, b in zip((self.first, *self.values), (*self.values, np.inf), strict=True)):
            raise AnalysisError(f"limits must rise from above {self.first:g}: {self.values}")

    @property
    def removal(self) -> float:
        return self.values[-1]

    def text(self, severity: float) -> str:
        return f"{self.scale * severity:.3g} {self.unit}".rstrip()

    def only_last(self) -> Limits:
        """The removal alone, which is all that a fleet is sorted by."""
        return replace(self, names=self.names[-1:], values=self.values[-1:])

    @property
    def span(self) -> float:
        """From a new part to its removal."""
        return self.removal - self.healthy


@dataclass(frozen=True)
class Forecast:
    """What is said of one actuator (and fault) after its last test. Uses are in the history's unit.

    `quantiles` [limits, LEVELS] of the remaining use, inf beyond `horizon`. `ahead`: uses of future tests, counted like
    the history's; `risk` [limits, ahead] of having reached each limit by then. `advised` is None where the risk
    stays below the chosen figure as far as is listed.
    """

    history: History
    verdict: str
    reason: str
    quantiles: np.ndarray
    horizon: float
    ahead: np.ndarray
    risk: np.ndarray
    advised: float | None
    weights: dict[str, float]
    limits: Limits
    at: float  # use at the last row
    severity: tuple[float, float]  # tracked: mean and standard deviation
    outliers: np.ndarray  # [rows] probability that the test says nothing
    warnings: tuple[str, ...] = ()
    remaining: tuple[Remaining, ...] = field(default=(), repr=False)

    @property
    def tells(self) -> bool:
        """Whether quantiles and risk may be told."""
        return tells(self.verdict, self.reason)


@dataclass(frozen=True)
class Options:
    """`risk` of the last limit at an advised test; `horizon` of use ahead (default LONG times what was watched)."""

    risk: float = 0.001
    horizon: float | None = None
    listed: int = LISTED  # future tests whose risk is told, at most

    def __post_init__(self):
        if not 0 < self.risk < 1:
            raise AnalysisError(f"the risk is a probability between 0 and 1, not {self.risk:g}")
        if self.horizon is not None and not 0 < self.horizon < math.inf:
            raise AnalysisError(f"the horizon is some use ahead, above zero, not {self.horizon:g}")


def forecasts(
    histories: Sequence[History],
    bank: Bank,
    limits: Limits | Callable[[History], Limits],
    options: Options = Options(),
    *,
    learn: bool = True,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> list[Forecast]:
    """One for each history, in their order; with `learn`, FLEET or more of them tell the prior first
    (`fleet_prior`)."""
    of = limits if callable(limits) else lambda _: limits
    for history in histories:
        check_range(history, of(history))
    if learn:
        fleet_prior(histories, bank, of)
    result: dict[int, Forecast] = {}
    for rows in _batches(histories):
        batch = [histories[k] for k in rows]
        scale = [of(h) for h in batch]
        series = _series(batch, scale, bank)
        outliers = []
        for step in run(bank, series):
            outliers.append(step.outlier)
            last = step
        said = _forecasts(batch, bank, scale, options, last, series, np.array(outliers).T)
        result |= dict(zip(rows, said, strict=True))
        progress(len(result), len(histories))
    return [result[k] for k in range(len(histories))]


def fleet_prior(histories: Sequence[History], bank: Bank, of: Callable[[History], Limits], most: int = 400) -> None:
    """Replace the bank's prior by that of the lives that have ended, where there are FLEET of them or more, and what
    the tests' intervals say of their scatter by how tests of these lives scatter.

    A life has ended where its part was replaced beyond half of the limit, or has reached it. Lives that go on are
    left out:
    of how long they will be they know little but the prior. Of more than `most`, that many are taken, evenly.
    """
    ended = [life for h in histories for life in _ended(h, of(h))]
    if len(ended) < FLEET:
        return
    chosen = [ended[k] for k in np.unique(np.linspace(0, len(ended) - 1, most).round().astype(int))]
    weights = []
    bank.scatter = {}
    bank.scatter = _scatter(chosen, bank, of)
    for rows in _batches(chosen):
        batch = [chosen[k] for k in rows]
        *_, last = run(bank, _series(batch, [of(h) for h in batch], bank))
        weights.append(last.filtered.w)
    bank.learn(np.concatenate(weights, axis=1))


def _series(batch: Sequence[History], scale: Sequence[Limits], bank: Bank) -> Series:
    return series_of(batch, [one.span for one in scale], bank, [one.healthy for one in scale])


def _scatter(lives: Sequence[History], bank: Bank, of: Callable[[History], Limits]) -> dict[str, Scatter]:
    """Of tests of each fault, where there are enough."""
    by_fault: dict[str, list[Life]] = {}
    for h in lives:
        series = _series([h], [of(h)], bank)
        known = series.valid[0]
        own = by_fault.setdefault(h.fault, [])
        own.append((series.use[0, known], series.value[0, known], series.stated[0, known]))
    found = {fault: scatter_of(several, bank.settings.floor) for fault, several in by_fault.items()}
    return {fault: one for fault, one in found.items() if one}


def _ended(h: History, limits: Limits) -> list[History]:
    """The ended lives of a history, each as one of its own, up to the first test beyond the limit: what a part does
    that should have been removed tells no life, and towards the end of the map its severity is cut."""
    result = []
    for k, life in enumerate(h.lives):
        rows = np.arange(life.start, life.stop)
        known = rows[np.isfinite(h.severity[rows])]
        if len(known) < FEWEST:
            continue
        middle = np.median(sliding_window_view(h.severity[known], FEWEST), axis=1)
        share = 1.0 if k == len(h.lives) - 1 else 0.5
        if middle[-1] < limits.healthy + share * limits.span:
            continue
        beyond = np.flatnonzero((middle >= limits.removal) & (h.severity[known[: len(middle)]] >= limits.removal))
        own = slice(life.start, known[beyond[0]] + 1 if len(beyond) else life.stop)
        columns = {name: getattr(h, name)[own] for name in ("use", "severity", "low", "high")}
        result.append(replace(h, **columns, replaced=np.zeros(own.stop - own.start, bool)))
    return result


def check_range(history: History, limits: Limits) -> None:
    """Raises AnalysisError where a severity lies outside the map."""
    known = np.isfinite(history.severity)
    outside = known & ((history.severity < limits.first) | (history.severity > limits.last))
    if outside.any():
        k = int(np.flatnonzero(outside)[0])
        percent = "; severities are fractions, not percent" if history.severity[k] > 1 >= limits.last else ""
        raise AnalysisError(
            f"actuator {history.actuator}, {history.unit} {history.use[k]:g}: severity {history.severity[k]:g} is "
            f"outside the map, {limits.first:g} to {limits.last:g}{percent}"
        )


def _batches(histories: Sequence[History]) -> list[list[int]]:
    """Rows of about equal length and pace together, so that little is padded and many hypotheses go for all of them."""
    order = sorted(range(len(histories)), key=lambda k: _likeness(histories[k]))
    return [order[k : k + BATCH] for k in range(0, len(order), BATCH)]


def _likeness(h: History) -> tuple[int, float]:
    part = h.lives[-1]
    known = h.severity[part][np.isfinite(h.severity[part])]
    return (part.stop - part.start) // 8, float(known[-1]) if len(known) else 0.0


def _forecasts(batch, bank: Bank, scale: list[Limits], options, step: Step, series: Series, outliers) -> list[Forecast]:
    error = np.array([last_error(series, b) for b in range(len(batch))])
    reaching = [_reaching(bank, step.filtered, scale, j, error, series.interval) for j in range(len(scale[0].names))]
    watched = np.array([h.use[h.lives[-1]][-1] - h.use[h.lives[-1]][0] for h in batch])
    watched = np.where(watched > 0, watched, series.interval)
    horizon = np.full(len(batch), options.horizon) if options.horizon else LONG * watched
    quantiles = np.maximum.accumulate(np.stack([r.quantiles(LEVELS, 10 * horizon) for r in reaching], axis=1), axis=1)
    again = reaching[-1].reached(watched[:, None])[:, 0]
    count = np.clip(horizon / series.interval, 1, options.listed).astype(int)
    steps = series.interval[:, None] * np.arange(count.max() + 1)
    # [B, limits, 1 + tests]; a limit is not reached before the one below it, which sums of lognormals do not know
    risk = np.minimum.accumulate(np.stack([r.reached(steps) for r in reaching], axis=1), axis=1)
    law = _law_weights(bank, step.filtered)
    mean, deviation = _tracked(step.filtered)
    result = []
    for b, h in enumerate(batch):
        own = slice(0, count[b] + 1)
        verdict, reason, warnings = verdict_on(
            h, outliers[b], quantiles[b, -1], again[b], horizon[b], scale[b].removal
        )  # fmt: skip
        at = float(h.use[-1])
        below = np.flatnonzero(np.maximum.accumulate(risk[b, -1, own]) > options.risk)
        advised = None if not len(below) or verdict != FORECAST else at + float(steps[b, max(below[0] - 1, 0)])
        limit = scale[b].span
        result.append(
            Forecast(
                h, verdict, reason, np.where(quantiles[b] > horizon[b], np.inf, quantiles[b]), float(horizon[b]),
                at + steps[b, own][1:], risk[b, :, own][:, 1:], advised, law[b], scale[b], at,
                (scale[b].healthy + mean[b] * limit, deviation[b] * limit), outliers[b, : len(h.use[h.lives[-1]])],
                (*h.warnings, *h.doubts, *warnings), tuple(_row(r, b) for r in reaching),
            )
        )  # fmt: skip
    return result


def _row(r: Remaining, b: int) -> Remaining:
    return Remaining(r.mean[b : b + 1], r.sd[b : b + 1], r.weight[b : b + 1])


def _reaching(bank, beliefs, scale: list[Limits], j: int, error, interval) -> Remaining:
    """Up to limit j of each history's own limits."""
    shares = np.array([(one.values[j] - one.healthy) / one.span for one in scale])
    if np.ptp(shares) == 0:
        return remaining(bank, beliefs, float(shares[0]), error, interval)
    parts = []
    for b, share in enumerate(shares):
        row = slice(b, b + 1)
        parts.append(remaining(bank, beliefs.rows(row), float(share), error[row], interval[row]))
    return Remaining(*(np.concatenate([getattr(p, name) for p in parts]) for name in ("mean", "sd", "weight")))


def _law_weights(bank: Bank, beliefs: Beliefs) -> list[dict[str, float]]:
    """Weight of each named law, shapes and noises summed."""
    by_shape = beliefs.w.sum(axis=2)
    result = []
    for b in range(by_shape.shape[1]):
        weights: dict[str, float] = {}
        for law, weight in zip(bank.laws, by_shape[:, b], strict=True):
            weights[law.name] = weights.get(law.name, 0.0) + float(weight)
        result.append(dict(sorted(weights.items(), key=lambda item: -item[1])))
    return result


def _tracked(b: Beliefs) -> tuple[np.ndarray, np.ndarray]:
    """Mean and standard deviation of the severity over the hypotheses in use, [B] shares of the limit."""
    w = in_use(b.w)
    mean = (w * b.x).sum(axis=(0, 2))
    variance = (w * (b.xx + (b.x - mean[None, :, None]) ** 2)).sum(axis=(0, 2))
    return mean, np.sqrt(variance)
