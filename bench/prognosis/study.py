"""The runs of the study: forecasts at every tenth of life, removals test by test, rivals, two faults."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from multiprocessing import get_context

import numpy as np

from bench.prognosis.fleet import LIMIT, Part
from bench.prognosis.rivals import NEVER, Tests, kalman_check, progpy_remaining, progpy_version, straight_line
from bench.prognosis.scores import CHECKPOINTS, HORIZON, LEVELS, Scores, crps_of_samples
from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.filter.crossing import Remaining, remaining
from lacuna.analysis.prognosis.filter.filter import run
from lacuna.analysis.prognosis.forecast import LONG, Limits, forecasts
from lacuna.analysis.prognosis.history import TWO_SIDED_95, History
from lacuna.analysis.prognosis.series import last_error, series_of
from lacuna.analysis.prognosis.verdict import FORECAST, verdict_on

LIMITS = Limits(("orange", "red", "violet"), (0.11, 0.27, LIMIT), 0.0, 0.5)
SAMPLES = (np.arange(200) + 0.5) / 200
RED = 0.27
BATCH = 50
Tell = Callable[[str, float], None]


def truncated(h: History, rows: int) -> History:
    return replace(h, **{name: getattr(h, name)[:rows] for name in ("use", "severity", "low", "high", "replaced")})


def last_test(part: Part, share: float) -> int:
    """Rows of the history up to this share of the life."""
    return int(np.searchsorted(part.history.use, part.born + share * part.life, side="right"))


@dataclass(frozen=True)
class Removals:
    """Of each part: share of its life at its removal (NaN: never removed), and whether the limit came first."""

    at: np.ndarray
    missed: np.ndarray


@dataclass(frozen=True)
class Arm:
    """What the forecasts of one prior gave: scores, [parts, checkpoints] verdicts, and removals by the advised last
    test."""

    scores: Scores
    verdicts: np.ndarray
    removals: Removals


def walked(parts: Sequence[Part], bank: Bank, risk: float | None) -> Arm:
    """All tests of the parts in turn: a forecast at every checkpoint, as `lacuna forecast` makes it of the tests so
    far, and a removal at the first test after which the risk of violet by the next one exceeds `risk` (None: never)."""
    scores, verdicts = Scores.empty(len(parts)), np.full((len(parts), len(CHECKPOINTS)), "", dtype=object)
    series = series_of([p.history for p in parts], LIMIT, bank)
    first = np.array([p.history.lives[-1].start for p in parts])
    rows = np.array([[last_test(p, share) for share in CHECKPOINTS] for p in parts])
    removed, outliers = np.full(len(parts), np.nan), np.zeros(series.use.shape)
    for k, step in enumerate(run(bank, series)):
        outliers[:, k] = step.outlier
        due = (rows == (first + k + 1)[:, None]).any(axis=1)
        there = first + k < [len(p.history.use) for p in parts]
        now = np.flatnonzero(there & (due | (np.isnan(removed) & (k >= 2 and risk is not None))))
        if not len(now):
            continue
        error = np.array([_error_until(series, b, k) for b in now])
        reach = remaining(bank, step.filtered.rows(now), 1.0, error, series.interval[now])
        over = reach.reached(series.interval[now][:, None])[:, 0] > (np.inf if risk is None else risk)
        for place, b in enumerate(now):
            p = parts[b]
            if over[place] and np.isnan(removed[b]) and k >= 2:
                removed[b] = (p.history.use[first[b] + k] - p.born) / p.life
            if due[b]:
                own = Remaining(*(a[place : place + 1] for a in (reach.mean, reach.sd, reach.weight)))
                _score(scores, verdicts, parts, b, rows[b] == first[b] + k + 1, own, outliers[b])
    return Arm(scores, verdicts, Removals(removed, ~(removed <= 1.0)))


def _score(scores: Scores, verdicts, parts, b: int, columns, own: Remaining, outlier: np.ndarray) -> None:
    """Enter what is said of part `b` at the checkpoints `columns`."""
    p = parts[b]
    h = truncated(p.history, last_test(p, CHECKPOINTS[int(np.flatnonzero(columns)[0])]))
    watched = h.use[-1] - h.use[h.lives[-1].start]
    horizon = LONG * watched
    quantiles = own.quantiles(LEVELS, np.array([10 * horizon]))[0]
    again = float(own.reached(np.array([[watched]]))[0, 0])
    verdict = verdict_on(h, outlier, quantiles, again, horizon)[0]
    truth = (p.born + p.life - h.use[-1]) / p.life
    samples = own.quantiles(SAMPLES, np.array([NEVER * p.life]))[0] / p.life
    for j in np.flatnonzero(columns):
        scores.truth[b, j], scores.crps[b, j], verdicts[b, j] = truth, crps_of_samples(samples, truth), verdict
        if verdict == FORECAST:
            scores.said[b, j] = True
            scores.quantiles[b, j] = np.where(quantiles > horizon, np.inf, quantiles) / p.life


def arm(parts: Sequence[Part], bank: Bank, risk: float, tell: Tell) -> Arm:
    """`walked` over all parts, on all cores."""
    pieces = [parts[k : k + BATCH] for k in range(0, len(parts), BATCH)]
    done = []
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        for one in pool.map(walked, pieces, [bank] * len(pieces), [risk] * len(pieces)):
            done.append(one)
            tell("forecasts", len(done) / len(pieces))
    scores = Scores.joined([a.scores for a in done])
    removals = Removals(*(np.concatenate([getattr(a.removals, name) for a in done]) for name in ("at", "missed")))
    return Arm(scores, np.concatenate([a.verdicts for a in done]), removals)


Samples = Callable[[Part], dict[int, np.ndarray]]  # {rows of history: samples of the remaining use}


def sample_scores(parts: Sequence[Part], samples: Samples) -> Scores:
    """Of a method that gives samples, on all cores."""
    pieces = [parts[k : k + BATCH // 5] for k in range(0, len(parts), BATCH // 5)]
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        return Scores.joined(list(pool.map(_sampled, pieces, [samples] * len(pieces))))


def _sampled(parts: Sequence[Part], samples: Samples) -> Scores:
    scores = Scores.empty(len(parts))
    for b, p in enumerate(parts):
        found = samples(p)
        for j, share in enumerate(CHECKPOINTS):
            rows = last_test(p, share)
            scores.truth[b, j] = (p.born + p.life - p.history.use[rows - 1]) / p.life
            own = found.get(rows, np.full(2, NEVER)) / p.life
            scores.crps[b, j] = crps_of_samples(own, scores.truth[b, j])
            scores.quantiles[b, j] = np.quantile(own, LEVELS)
            scores.said[b, j] = scores.quantiles[b, j, 2] < HORIZON
    return scores


def _known(p: Part, rows: int) -> np.ndarray:
    """Rows of the part in service that have a severity, among the first `rows`."""
    start = p.history.lives[-1].start
    return np.arange(start, rows)[np.isfinite(p.history.severity[start:rows])] if rows > start else np.empty(0, int)


def line_samples(seed: int, p: Part) -> dict[int, np.ndarray]:
    result = {}
    for share in CHECKPOINTS:
        rows = last_test(p, share)
        known = _known(p, rows)
        if len(known) >= 3:
            own = straight_line(p.history.use[known], p.history.severity[known], LIMIT, seed + p.number)
            result[rows] = np.maximum(own - (p.history.use[rows - 1] - p.history.use[known[-1]]), 0)
    return result


def progpy_samples(seed: int, shape: bool, p: Part) -> dict[int, np.ndarray]:
    """Told the law; with `shape` its shape too."""
    known = _known(p, len(p.history.use))
    h = p.history
    wanted = {last_test(p, share): len(_known(p, last_test(p, share))) - 1 for share in CHECKPOINTS}
    sd = np.maximum((h.high - h.low)[known] / 2 / TWO_SIDED_95 / LIMIT, 1e-3)
    tests = Tests(h.use[known], h.severity[known] / LIMIT, sd, float(np.median(np.diff(h.use))))
    told = p.truth.shape if shape else None
    found = progpy_remaining(p.law, told, tests, list(wanted.values()), seed + p.number)
    late = {rows: h.use[rows - 1] - h.use[known[k]] if k >= 0 else 0.0 for rows, k in wanted.items()}
    return {rows: np.maximum(found[k] - late[rows], 0) for rows, k in wanted.items() if k in found}


def progpy_verdict() -> str:
    """Why progpy is not compared, or nothing. First its filter has to pass our own Kalman test."""
    if not progpy_version():
        return "progpy 1.9 or later is not installed here: pip install 'progpy>=1.9'"
    mean, deviation = kalman_check()
    if mean > 0.3 or deviation > 0.3:
        return f"progpy {progpy_version()} fails the Kalman test: {mean:.2f} and {deviation:.2f}"
    return ""


def _error_until(series, b: int, k: int) -> float:
    cut = replace(series, valid=np.where(np.arange(series.valid.shape[1]) <= k, series.valid, False))
    return last_error(cut, b)


def threshold_removals(parts: Sequence[Part], readings: Callable[[Part], np.ndarray], threshold: float) -> Removals:
    """Removed at the first test that reads the threshold or more."""
    at = []
    for p in parts:
        own = np.arange(p.history.lives[-1].start, len(p.history.use))
        with np.errstate(invalid="ignore"):
            over = own[readings(p)[own] >= threshold]
        at.append((p.history.use[over[0]] - p.born) / p.life if len(over) else np.nan)
    at = np.array(at)
    return Removals(at, ~(at <= 1.0))


def two_faults(parts: Sequence[Part], bank: Callable[[], Bank], seed: int) -> dict[float, tuple[float, float, int]]:
    """{share of the shorter life: coverage of the 95 % interval of each fault's life, forecasts} of pairs of parts.

    The two faults of an actuator are read with the errors of docs/combined.md: 0.79 points, and 0.049 times nominal.
    """
    from lacuna.analysis.prognosis.forecast import Limits as Bounds

    friction = Bounds(LIMITS.names, (0.14036, 0.18714, 0.23393), 0.046785, 0.28071, 0.0936)
    random = np.random.default_rng(seed)
    pairs = [(a, b) for a, b in zip(parts[::2], parts[1::2], strict=False)]
    result = {}
    for share in (0.5, 0.7, 0.9):
        inside, count = [0, 0], [0, 0]
        for one, other in pairs:
            gap, end = min(one.life, other.life) / 40, share * min(one.life, other.life)
            use = np.cumsum(gap * random.lognormal(0, 0.3, 100))
            use = use[use < end]
            first = _read(one, use, lambda x: LIMIT * x, 0.0079, (0.0, 0.5), "", random)
            second = _read(
                other, use, lambda x: 0.0936 + (0.23393 - 0.0936) * x, 0.0046, (0.046785, 0.28071), "friction", random
            )
            said = forecasts([first, second], bank(), lambda h: friction if h.fault else LIMITS, learn=False)
            for k, (f, p) in enumerate(zip(said, (one, other), strict=True)):
                if f.verdict == FORECAST:
                    count[k] += 1
                    inside[k] += bool(f.quantiles[-1, 0] <= p.life - use[-1] <= f.quantiles[-1, -1])
        result[share] = (inside[0] / max(count[0], 1), inside[1] / max(count[1], 1), sum(count))
    return result


def _read(p: Part, use, scale, sd: float, bounds: tuple[float, float], fault: str, random) -> History:
    value = scale(np.interp(use / p.life, p.truth.time, p.truth.severity)) + sd * random.standard_normal(len(use))
    value = np.clip(value, *bounds)
    low, high = (np.clip(value + side * TWO_SIDED_95 * sd, *bounds) for side in (-1, 1))
    return History(p.name, "cycles", use, value, low, high, np.zeros(len(use), bool), fault)
