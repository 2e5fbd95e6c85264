"""When a limit is reached: the distribution of the remaining use, from the beliefs after a test.

Given the severity x and the rate r of a hypothesis, the age has D = U(limit) - U(x) still to rise, and

    ln n = ln D - ln r + noise,   variance  wander^2 tau / 3 + diffusion^2 integral(dx / G^2) / D^2

with tau = D / life: the mean of a wandering logarithm over its own span, and the first passage of a Wiener process
with drift (its
inverse Gaussian has this coefficient of variation, and the mean D/r: Chhikara, Folks 1989), both as a lognormal.
Over x, and over the common error that
shifts the limit as the assessments see it, the distribution is summed at Gauss-Hermite nodes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lacuna.analysis.prognosis.filter.bank import LOST, Bank, Beliefs
from lacuna.analysis.spectra.library import library, pointer

NODES = 5
COMMON_NODES = 3
KEPT = 30  # hypotheses of greatest weight that a forecast sums over
GRID = 100  # points of the distribution
NEVER = 1e6  # intervals between tests: later is never
LARGEST = 1.5  # standard deviation of ln n where the limit is so near that a lognormal has no meaning


@dataclass(frozen=True)
class Remaining:
    """Distribution of the remaining use of B histories up to one limit, as a sum of lognormals.

    `mean`, `sd` of ln(use) and `weight` are [B, P]; a mean of -inf: already reached. Weights sum to 1.
    """

    mean: np.ndarray
    sd: np.ndarray
    weight: np.ndarray

    def reached(self, use: np.ndarray) -> np.ndarray:
        """[B, ...] probability that the limit is reached within `use` [B, ...]."""
        with np.errstate(divide="ignore"):
            ln = np.log(np.asarray(use, dtype=float))
        flat = np.ascontiguousarray(ln.reshape(len(self.mean), -1))
        result = np.empty(flat.shape)
        mean, sd, weight = (np.ascontiguousarray(a) for a in (self.mean, self.sd, self.weight))
        library().lacuna_lognormals_reached(
            *map(pointer, (mean, sd, weight)), *mean.shape, pointer(flat), flat.shape[1], pointer(result)
        )
        return result.reshape(ln.shape)

    def quantiles(self, probabilities, never: np.ndarray) -> np.ndarray:
        """[B, q] remaining use; inf where it is beyond `never` [B]."""
        return self.distribution(never).quantiles(probabilities)

    def distribution(self, never: np.ndarray) -> Distribution:
        """On a grid that fits each history: its own spread, from its first to its last lognormal of weight."""
        live = ~np.isneginf(self.mean) & (self.weight > 1e-6)
        low = np.where(live, self.mean - 4 * self.sd, np.inf).min(axis=1)
        high = np.where(live, self.mean + 4 * self.sd, -np.inf).max(axis=1)
        ln_never = np.log(never)
        low = np.where(np.isfinite(low), np.minimum(low, ln_never - 1), ln_never - 1)
        high = np.clip(high, low + 1e-3, np.maximum(ln_never, low + 1e-3))
        # Half of the points where most of the probability is, half over the whole range.
        centre = np.where(live, self.weight * np.where(live, self.mean, 0), 0).sum(1)
        total = np.where(live, self.weight, 0).sum(1).clip(1e-12)
        centre = centre / total
        square = np.where(live, self.weight * ((np.where(live, self.mean, 0) - centre[:, None]) ** 2 + self.sd**2), 0)
        spread = np.sqrt(square.sum(1) / total)
        share = np.linspace(0, 1, GRID // 2)
        whole = low[:, None] + (high - low)[:, None] * share
        fine = np.clip(centre[:, None] + spread[:, None] * (6 * share - 3), low[:, None], high[:, None])
        ln = np.sort(np.concatenate([whole, fine], axis=1), axis=1)
        return Distribution(np.exp(ln), self.reached(np.exp(ln)))


@dataclass(frozen=True)
class Distribution:
    """`probability` [B, g] that the limit is reached within `use` [B, g]; never, with the rest."""

    use: np.ndarray
    probability: np.ndarray

    def quantiles(self, probabilities) -> np.ndarray:
        """[B, q]; inf where the quantile lies beyond the grid, 0 where it lies before it."""
        result = np.empty((len(self.use), len(probabilities)))
        for b, (use, p) in enumerate(zip(self.use, self.probability, strict=True)):
            rising = np.maximum.accumulate(p)
            result[b] = np.interp(probabilities, rising, use, left=0.0, right=np.inf)
        return result

    def crps(self, truth: np.ndarray) -> np.ndarray:
        """[B] continuous ranked probability score in use: integral of (F - 1[n >= truth])^2 (Gneiting, Raftery 2007).

        The distribution counts up to the end of its grid, and so does the truth.
        """
        scores = np.empty(len(self.use))
        for b, (use, p, n) in enumerate(zip(self.use, self.probability, truth, strict=True)):
            n = min(n, use[-1])
            at = np.unique(np.concatenate([[0.0, n], use]))
            f = np.interp(at, use, p, left=p[0] if use[0] <= 0 else 0.0)
            f = np.where(at < use[0], p[0], f)
            square = (f - (at >= n)) ** 2
            before, width = (f - (at > n)) ** 2, np.diff(at)
            scores[b] = (0.5 * (square[:-1] + before[1:]) * width).sum()
        return scores


def remaining(bank: Bank, beliefs: Beliefs, limit: float, error: np.ndarray, interval: np.ndarray) -> Remaining:
    """Up to severity `limit` (a share of the last limit). `error` [B]: standard deviation of an assessment now,
    `interval` [B]: usual use between tests, in which abrupt changes of the rate are counted."""
    s, b, k = beliefs.x.shape
    weight = beliefs.w.transpose(1, 0, 2).reshape(b, -1)
    count = min(KEPT, s * k)
    kept = np.argpartition(-weight, count - 1, axis=1)[:, :count]
    weight = np.take_along_axis(weight, kept, axis=1)
    weight = np.where(weight >= LOST * weight.max(axis=1, keepdims=True), weight, 0)
    weight /= weight.sum(axis=1, keepdims=True)
    law, place = np.divmod(kept, k)
    row = np.arange(b)[:, None]
    of = {name: getattr(beliefs, name)[law, row, place] for name in ("x", "l", "xx", "xl", "ll")}
    mean, sd, share = _lognormals(bank, of, law, place, limit, error[:, None], interval[:, None])
    weights = weight * share
    return Remaining(*(a.transpose(1, 0, 2).reshape(b, -1) for a in (mean, sd, weights)))


def _nodes(bank: Bank) -> tuple[np.ndarray, ...]:
    """(standard deviations of x, of the common error, whether the rate changes on the way, weight), [N, 1, 1] each."""
    z, w = np.polynomial.hermite_e.hermegauss(NODES)
    common = any(bank.settings.commons)
    zc, wc = np.polynomial.hermite_e.hermegauss(COMMON_NODES) if common else (np.zeros(1), np.ones(1))
    w, wc = w / w.sum(), wc / wc.sum()
    nodes = [(a, c, False, p * q) for a, p in zip(z, w, strict=True) for c, q in zip(zc, wc, strict=True)]
    nodes += [(a, 0.0, True, p) for a, p in zip(z, w, strict=True) if bank.settings.change]
    return tuple(np.array(column)[:, None, None] for column in zip(*nodes, strict=True))


def _lognormals(bank: Bank, of: dict, law, place, limit: float, error, interval):
    """Mean and standard deviation of ln(use), and weight, [N, B, kept], of each kept hypothesis at each node."""
    z, common, changes, share = _nodes(bank)
    deviation = np.sqrt(np.maximum(of["xx"], 1e-16))
    slope = of["xl"] / deviation  # of ln r, for one standard deviation of x
    x = of["x"] + z * deviation
    edge = limit + common * (np.sqrt(bank.common[law, 0, place]) * error)
    distance, scatter = np.empty(x.shape), np.empty(x.shape)
    for s in np.unique(law):
        mine, table = law == s, bank.tables[s]
        distance[:, mine] = table.age(edge[:, mine]) - table.age(x[:, mine])
        scatter[:, mine] = table.scatter(x[:, mine], edge[:, mine])
    ahead = np.maximum(distance, 1e-12)
    tau = ahead / bank.life[law, 0, 0]
    variance = np.maximum(of["ll"] - slope**2, 1e-12) + bank.wander2[law, 0, place] * np.minimum(tau, 1) / 3
    passage = np.minimum(bank.diffusion2[law, 0, place] * scatter / ahead**2, LARGEST**2)
    variance += passage
    # An abrupt change lies at any place on the way: mean square of the share that is left.
    variance += np.where(changes, bank.settings.change_size**2 / 3, 0)
    mean = np.where(distance > 0, np.log(ahead) - of["l"] - z * slope - passage / 2, -np.inf)
    tests = np.exp(np.clip(mean, -700, 700)) / interval
    change = 1 - np.exp(-bank.settings.change * tests)
    return mean, np.sqrt(np.minimum(variance, LARGEST**2)), share * np.where(changes, change, 1 - change)
