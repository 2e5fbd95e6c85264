"""What no forecast can pass: the posterior of the fleet's own generator, by particles (Gordon, Salmond, Smith 1993).

A particle is a part as `truth.py` draws one: law, shape, severity when new, life, wandering rate, and the friction and
inertia that its tests are read with. It is told everything but the part: the laws and how often each is drawn, the
ranges of shapes and lives, the process noise, how tests are read at each severity, friction and inertia, and how often
one is an outlier. `told` of "law" is told the part's law besides, "shape" its shape too. There is no Gaussian and no
linearisation. What remains is simulated to the limit.

Under a posterior a figure c is within alpha of the remaining use T with the chance P(c/(1+alpha) <= T <= c/(1-alpha)).
Its greatest value over c, averaged over parts, is the expected score of the best figure there is; a method that knows
less cannot expect more. That the posterior is right is seen by its own intervals' coverage.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, fields
from multiprocessing import get_context

import numpy as np

from bench.prognosis.fleet import FRICTION, INERTIA, LIMIT, OUTLIERS, OUTSIDE, Part, tests_a_life
from bench.prognosis.rivals import NEVER
from bench.prognosis.scores import ALPHA, CHECKPOINTS, LEVELS, Scores, crps_of_samples
from bench.prognosis.study import last_test
from bench.prognosis.truth import KNOWN, NEW, SCATTER, SHAPES, SWING, SWINGS, UNKNOWN, USUAL, WANDER, growth
from lacuna.analysis.severity.robustness import Results

PARTICLES = 30_000
AHEAD = 4000  # particles that are simulated to the limit
STEPS = 3  # of growth between two tests
TO_LIMIT = 80  # steps of what remains, evenly in the logarithm of the severity
SMALL, LARGE = 1e-3, 3.0  # shares of the limit between which a particle lives
WIDE, WIDE_SCALE = 0.04, 3.0  # of the readings' residuals: their tails
BINS = np.linspace(0, 0.5, 11)  # severities, in which the residuals' spread is told


class ReadingErrors:
    """How tests are read, from the simulated ones: a polynomial of severity, friction and inertia, and residuals."""

    def __init__(self, tests: Results):
        ok = tests.covered & np.isfinite(tests.estimate)
        severity, error = tests.severity[ok], (tests.estimate - tests.severity)[ok]
        terms = _terms(severity, tests.z[ok, FRICTION], tests.z[ok, INERTIA])
        bins = np.clip(np.digitize(severity, BINS) - 1, 0, len(BINS) - 2)
        weight = np.ones(len(error))
        for _ in range(10):  # Huber's weights, residuals in units of their bin's median deviation
            self._bias = np.linalg.lstsq(terms * weight[:, None], error * weight, rcond=None)[0]
            residual = abs(error - terms @ self._bias)
            self._spread = np.array([1.4826 * np.median(residual[bins == k]) for k in range(len(BINS) - 1)])
            weight = np.sqrt(1 / np.maximum(1, residual / (2.5 * self._spread[bins]))) / self._spread[bins]

    def log_likelihood(self, read: float, severity: np.ndarray, friction: np.ndarray, inertia: np.ndarray):
        mean = np.clip(severity + _terms(severity, friction, inertia) @ self._bias, BINS[0], BINS[-1])
        sharp = 1 / np.interp(severity, (BINS[1:] + BINS[:-1]) / 2, self._spread)
        square = ((read - mean) * sharp) ** 2
        plain = (1 - WIDE - OUTLIERS) * np.exp(-0.5 * square)
        wide = WIDE / WIDE_SCALE * np.exp(-0.5 * square / WIDE_SCALE**2)
        return np.log(sharp * (plain + wide) / np.sqrt(2 * np.pi) + OUTLIERS / (BINS[-1] - BINS[0]))


def _terms(severity, friction, inertia) -> np.ndarray:
    x = severity / LIMIT
    one = np.ones_like(x)
    columns = [one, x, x**2, friction, inertia, x * friction, x * inertia, x**2 * friction, x**2 * inertia]
    return np.stack([*columns, friction * inertia, friction**2, inertia**2], axis=-1)


@dataclass
class Cloud:
    """Particles of one law, [n] each; `shape` [shapes, n]; uses in cycles, `w` logarithms of weights."""

    law: str
    x: np.ndarray
    rate: np.ndarray  # its logarithm
    life: np.ndarray
    shape: np.ndarray
    swing: np.ndarray
    phase: np.ndarray
    friction: np.ndarray
    inertia: np.ndarray
    w: np.ndarray

    def take(self, rows: np.ndarray) -> Cloud:
        return Cloud(self.law, *(getattr(self, f.name)[..., rows] for f in fields(self)[1:]))

    @property
    def scatter(self) -> float:
        return 0.0 if self.law == "seasons" else SCATTER.get(self.law, USUAL)

    def log_rate(self, use: np.ndarray | float) -> np.ndarray:
        return self.rate + self.swing * np.sin(2 * np.pi * (SWINGS * use / self.life + self.phase))

    def wander(self, use, random: np.random.Generator) -> None:
        if self.law != "seasons":
            share = np.minimum(use / self.life, 1)
            self.rate = self.rate + WANDER * np.sqrt(share) * random.standard_normal(len(self.x))


def drawn(law: str, n: int, gap: float, shape: Sequence[float] | None, random: np.random.Generator) -> Cloud:
    """`n` particles before the first test; `gap` is the use between tests, `shape` the part's own where it is told."""
    x, life = random.uniform(*NEW, n), gap * tests_a_life(random, n)
    bounds = SHAPES.get(law, ())
    own = np.array([random.uniform(*b, n) if shape is None else np.full(n, shape[k]) for k, b in enumerate(bounds)])
    own = own.reshape(len(bounds), n)
    grid = x[:, None] ** np.linspace(1, 0, TO_LIMIT)
    middle = (grid[:, 1:] + grid[:, :-1]) / 2
    age = (np.diff(grid, axis=1) / growth(law, middle, *own[:, :, None])).sum(axis=1)
    swing = random.uniform(*SWING, n) if law == "seasons" else np.zeros(n)
    friction, inertia = np.sqrt(3) * random.uniform(-1, 1, (2, n))
    return Cloud(law, x, np.log(age / life), life, own, swing, random.random(n), friction, inertia, np.zeros(n))


def advance(c: Cloud, since: float, use: float, random: np.random.Generator) -> None:
    """Growth over `use`, from the use `since` on; the middle's growth, and the law's own noise."""
    step = use / STEPS
    for k in range(STEPS):
        moved = np.exp(c.log_rate(since + (k + 0.5) * step)) * step
        half = c.x + moved / 2 * growth(c.law, np.maximum(c.x, SMALL), *c.shape)
        dx = np.maximum(moved * growth(c.law, np.clip(half, SMALL, LARGE), *c.shape), 0)
        c.x = np.clip(c.x + dx + c.scatter * np.sqrt(dx) * random.standard_normal(len(dx)), 0, LARGE)
        c.wander(step, random)


def to_limit(c: Cloud, since: float, random: np.random.Generator) -> np.ndarray:
    """[n] use that remains: every particle simulated to the limit as `truth.draw` does it."""
    left = np.zeros(len(c.x))
    log_x = np.log(np.clip(c.x, SMALL, 1))
    for k in range(TO_LIMIT):
        low, high = (np.exp(log_x * (1 - share)) for share in (k / TO_LIMIT, (k + 1) / TO_LIMIT))
        dx = np.maximum(high - low, 1e-9)
        dt = dx / growth(c.law, (low + high) / 2, *c.shape) / np.exp(c.log_rate(since + left))
        if c.scatter:
            dt *= random.gamma(dx / c.scatter**2) * c.scatter**2 / dx
        c.wander(dt, random)
        left += dt
    return np.where(c.x < 1, left, 0.0)


def posterior(p: Part, readings: ReadingErrors, told: str, seed: int) -> dict[int, np.ndarray]:
    """{rows of the history: [AHEAD] use that remains}, after the last test before each checkpoint."""
    random, h = np.random.default_rng([seed, p.number]), p.history
    start, gap = h.lives[-1].start, float(np.median(np.diff(h.use)))
    mix = {law: (1 - OUTSIDE) / len(KNOWN) for law in KNOWN} | {law: OUTSIDE / len(UNKNOWN) for law in UNKNOWN}
    mix = mix if told == "population" else {p.law: 1.0}
    shape = p.truth.shape if told == "shape" else None
    clouds = [drawn(law, round(PARTICLES * share), gap, shape, random) for law, share in mix.items()]
    wanted, found, before = {last_test(p, share) for share in CHECKPOINTS} - {start}, {}, 0.0
    for row in range(start, max(wanted, default=start)):
        use = h.use[row] - p.born
        for c in clouds:
            advance(c, before, use - before, random)
        before = use
        if np.isfinite(h.severity[row]):
            for c in clouds:
                c.w = c.w + readings.log_likelihood(h.severity[row], LIMIT * c.x, c.friction, c.inertia)
            clouds = resampled(clouds, PARTICLES, random, least=0.5)
        if row + 1 in wanted:
            found[row + 1] = np.concatenate([to_limit(c, use, random) for c in resampled(clouds, AHEAD, random)])
    return found


def resampled(clouds: Sequence[Cloud], count: int, random: np.random.Generator, least: float = np.inf) -> list[Cloud]:
    """`count` particles alike in weight, where fewer than the share `least` of them count now; systematically."""
    w = np.concatenate([c.w for c in clouds])
    w = np.exp(w - w.max())
    if w.sum() ** 2 / (w**2).sum() >= least * len(w):
        return list(clouds)
    rows = np.searchsorted(np.cumsum(w / w.sum()), (np.arange(count) + random.random()) / count)
    rows, first, result = np.minimum(rows, len(w) - 1), 0, []
    for c in clouds:
        mine = c.take(rows[(rows >= first) & (rows < first + len(c.x))] - first)
        first += len(c.x)
        mine.w = np.zeros(len(mine.x))
        if len(mine.x):
            result.append(mine)
    return result


def best_figure(remaining: np.ndarray) -> float:
    """Greatest chance that one figure is within ALPHA of the use that remains."""
    x = np.sort(remaining)
    figure = np.geomspace(max(x[-1] * 1e-3, 1e-9), max(x[-1], 1e-9), 500)
    inside = np.searchsorted(x, figure / (1 - ALPHA)) - np.searchsorted(x, figure / (1 + ALPHA))
    return float(inside.max() / len(x))


@dataclass(frozen=True)
class Oracle:
    """Scores of the posterior, and [parts, checkpoints] `best_figure`, 0 before the first test."""

    scores: Scores
    best: np.ndarray


def scored(parts: Sequence[Part], tests: Results, told: str, seed: int) -> Oracle:
    readings, scores, best = ReadingErrors(tests), Scores.empty(len(parts)), np.zeros((len(parts), len(CHECKPOINTS)))
    for b, p in enumerate(parts):
        found = posterior(p, readings, told, seed)
        for j, share in enumerate(CHECKPOINTS):
            rows = last_test(p, share)
            scores.truth[b, j] = (p.born + p.life - p.history.use[rows - 1]) / p.life
            own = found.get(rows, np.full(2, NEVER * p.life)) / p.life
            scores.crps[b, j] = crps_of_samples(own, scores.truth[b, j])
            if rows in found:
                scores.said[b, j], scores.quantiles[b, j] = True, np.quantile(own, LEVELS)
                best[b, j] = best_figure(own)
    return Oracle(scores, best)


def oracle(parts: Sequence[Part], tests: Results, told: str, seed: int) -> Oracle:
    """`scored`, on all cores."""
    pieces = [parts[k : k + 10] for k in range(0, len(parts), 10)]
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        n = len(pieces)
        done = list(pool.map(scored, pieces, [tests] * n, [told] * n, range(seed, seed + n)))
    return Oracle(Scores.joined([o.scores for o in done]), np.concatenate([o.best for o in done]))
