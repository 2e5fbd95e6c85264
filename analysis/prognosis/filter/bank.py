"""The bank of hypotheses: every law with every shape, level of noise, common error and starting rate, in plain arrays.

A hypothesis is a Gaussian over (x, l): x the severity as a share of the limit, l = ln r the logarithm of the law's
rate. Arrays are [S, B, K]: S laws with their shapes, B histories, K = rates x noises x common errors.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lacuna.analysis.prognosis.filter.law import Law, prior, tables
from lacuna.analysis.prognosis.filter.scatter import Scatter
from lacuna.analysis.prognosis.filter.settings import DEFAULT, FilterSettings

LOST = 1e-3  # of the greatest weight
EM_STEPS = 20  # after which a fleet's shares have settled to a few per cent of themselves
GONE = 1e-8  # weight below which a hypothesis can be left out for good


class Bank:
    """Laws and settings, with what follows from them; the same for all histories. `scatter`: of tests of each fault,
    where a fleet has told it."""

    def __init__(self, laws: Sequence[Law], settings: FilterSettings = DEFAULT):
        self.laws, self.settings = list(laws), settings
        self.scatter: dict[str, Scatter] = {}
        self.tables = tables(self.laws)
        shortest, longest = np.log(settings.lives)
        count = max(1, round((longest - shortest) / settings.tile))
        self.log_lives = shortest + (longest - shortest) * (np.arange(count) + 0.5) / count
        self.spread = settings.tile / 2
        noises, commons = np.array(settings.noises), np.array(settings.commons)
        self.shape = (count, len(noises), len(commons))  # K unfolded
        law_noise = np.array([[law.wander, law.diffusion] for law in self.laws])
        wander, diffusion = (law_noise[:, :, None] * noises[:, 1:3].T).transpose(1, 0, 2)  # [S, noises]
        self.wander2 = self._unfold(wander[:, None, :, None] ** 2)
        self.diffusion2 = self._unfold(diffusion[:, None, :, None] ** 2)
        self.change = self._unfold(settings.change * noises[None, None, :, None, 3])
        self.common = self._unfold(commons[None, None, None, :])
        self.life = np.array([table.life for table in self.tables])[:, None, None]
        of_life = np.exp(-0.5 * ((self.log_lives - np.log(settings.life)) / settings.life_spread) ** 2)
        within = np.multiply.outer(of_life / of_life.sum(), noises[:, 0] / noises[:, 0].sum())
        self.prior = self._unfold(prior(self.laws)[:, None, None, None] * within[None, :, :, None] / len(commons))

    def learn(self, weights: np.ndarray) -> None:
        """Take laws, lives and noises of a fleet into the prior: weights [S, B, K] of its hypotheses, each after its
        whole history.

        The EM algorithm for a mixture's shares under a Dirichlet prior (empirical Bayes: Robbins 1956; Dempster, Laird,
        Rubin 1977) worth `settings.actuators`. No test is read again: a weight is prior times likelihood, so that
        a new prior only weighs it anew. Common errors keep their prior: they belong to the assessments, and one part
        says little of its own.
        """
        own, first = self.settings.actuators, self.prior
        likelihood = weights / np.maximum(first, 1e-300)
        for _ in range(EM_STEPS):
            posterior = likelihood * self.prior
            posterior /= posterior.sum(axis=(0, 2), keepdims=True)
            mean = (own * first + posterior.sum(axis=1, keepdims=True)) / (own + weights.shape[1])
            of_part = mean.reshape(-1, self.shape[-1]).sum(axis=1)
            of_common = first.reshape(-1, self.shape[-1]).sum(axis=0)
            self.prior = np.multiply.outer(of_part, of_common).reshape(first.shape)

    def _unfold(self, values: np.ndarray) -> np.ndarray:
        """[S|1, rates|1, noises|1, commons|1] -> [S, 1, K]."""
        return np.broadcast_to(values, (len(self.laws), *self.shape)).reshape(len(self.laws), 1, -1).copy()

    def start(self, interval: np.ndarray) -> Beliefs:
        """Before the first test; `interval` [B] between tests, in use."""
        settings, size = self.settings, (len(self.laws), len(interval), self.prior.shape[2])
        rate = np.log(self.life) - np.repeat(self.log_lives, self.shape[1] * self.shape[2])  # [S, 1, K]
        mean, deviation = settings.first
        return Beliefs(
            x=np.full(size, mean),
            l=rate - np.log(interval)[None, :, None],
            xx=np.full(size, deviation**2),
            xl=np.zeros(size),
            ll=np.full(size, self.spread**2),
            w=np.broadcast_to(self.prior, size).copy(),
        )


@dataclass(frozen=True)
class Beliefs:
    """Gaussian of every hypothesis, and its weight (which sums to 1 over S and K for each history)."""

    x: np.ndarray
    l: np.ndarray  # noqa: E741 - the logarithm of the rate
    xx: np.ndarray
    xl: np.ndarray
    ll: np.ndarray
    w: np.ndarray

    def rows(self, select: np.ndarray) -> Beliefs:
        """Of some histories only."""
        return replace(self, **{name: value[:, select] for name, value in vars(self).items()})


def in_use(w: np.ndarray) -> np.ndarray:
    """Weights [S, B, K] without hypotheses that lost the part and live by the share that returns to the prior alone."""
    kept = np.where(w >= LOST * w.max(axis=(0, 2), keepdims=True), w, 0)
    return kept / kept.sum(axis=(0, 2), keepdims=True)
