"""Metrics of a forecast, each with its formula and source. Uses are shares of the part's life, so that parts may be
averaged.

- coverage: share of parts whose true remaining use lies in the interval.
- CRPS: integral of (F(n) - 1[n >= truth])^2 dn (Gneiting, Raftery 2007), up to HORIZON lives, for every part and
checkpoint. - alpha-lambda: |median - truth| <= alpha truth at share lambda of the life (Saxena et al. 2010).
- prognostic horizon: the true remaining use at the first checkpoint from which on all medians are within alpha of a
*life*. - relative accuracy: 1 - |median - truth| / truth.
- a forecast that says "too early" or "steady" has no interval and no median: it is counted, and its CRPS is that of
its distribution.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

CHECKPOINTS = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
LEVELS = (0.025, 0.1, 0.5, 0.9, 0.975)
ALPHA = 0.2
HORIZON = 5.0  # lives


@dataclass
class Scores:
    """[parts, checkpoints] arrays; quantiles [..., LEVELS] in lives, NaN where nothing was forecast; `said` bool."""

    truth: np.ndarray
    said: np.ndarray
    quantiles: np.ndarray
    crps: np.ndarray

    @classmethod
    def empty(cls, parts: int) -> Scores:
        shape = (parts, len(CHECKPOINTS))
        return cls(np.full(shape, np.nan), np.zeros(shape, bool), np.full((*shape, len(LEVELS)), np.nan),
                   np.full(shape, np.nan))  # fmt: skip

    @classmethod
    def joined(cls, several: Sequence[Scores]) -> Scores:
        return cls(*(np.concatenate([getattr(s, n) for s in several]) for n in ("truth", "said", "quantiles", "crps")))

    def rows(self, select: np.ndarray) -> Scores:
        return Scores(*(getattr(self, name)[select] for name in ("truth", "said", "quantiles", "crps")))

    def coverage(self, low: int, high: int) -> np.ndarray:
        """[checkpoints] of the forecasts that were made."""
        inside = (self.quantiles[..., low] <= self.truth) & (self.truth <= self.quantiles[..., high])
        return (inside & self.said).sum(axis=0) / np.maximum(self.said.sum(axis=0), 1)

    def alpha_lambda(self) -> np.ndarray:
        """[checkpoints] of all parts: what was not forecast is not within alpha."""
        with np.errstate(invalid="ignore"):
            return (self.said & (abs(self.quantiles[..., 2] - self.truth) <= ALPHA * self.truth)).mean(axis=0)

    def relative_accuracy(self) -> np.ndarray:
        """[checkpoints] median over the forecasts that were made."""
        with np.errstate(invalid="ignore"):
            accuracy = np.where(self.said, 1 - abs(self.quantiles[..., 2] - self.truth) / self.truth, np.nan)
        return np.nanmedian(accuracy, axis=0)

    def horizon(self) -> float:
        """Median over the parts of the prognostic horizon, in lives; a part without one counts as 0."""
        with np.errstate(invalid="ignore"):
            good = self.said & (abs(self.quantiles[..., 2] - self.truth) <= ALPHA)
        from_then_on = np.flip(np.cumprod(np.flip(good, axis=1), axis=1), axis=1).astype(bool)
        return float(np.median(np.where(from_then_on, self.truth, 0).max(axis=1)))


def crps_of_samples(samples: np.ndarray, truth: float) -> float:
    """E|X - y| - E|X - X'|/2 of equally weighted samples, both cut at HORIZON lives."""
    x, y = np.sort(np.minimum(samples, HORIZON)), min(truth, HORIZON)
    n = len(x)
    spread = 2 * ((2 * np.arange(1, n + 1) - n - 1) * x).sum() / n**2
    return float(np.abs(x - y).mean() - spread / 2)
