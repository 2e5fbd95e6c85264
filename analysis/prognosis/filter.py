"""The Gaussian-sum filter: all hypotheses of all histories, from test to test, in arrays.

    x' = U^-1(U(x) + r n) + diffusion,   l' = l + wander,   l = ln r        (law.py)
    y  = x' + e,   e ~ (1 - common) sigma^2, with sigma of that side of the interval on which x' lies

An extended Kalman filter a hypothesis (Jazwinski 1970), with the derivatives in closed form. A test is read in four
ways at once:
as it is; with a wide error; as an outlier that says nothing; as the first after an abrupt change of the rate. The four
posteriors are merged by their moments (probabilistic data association: Bar-Shalom, Tse 1975), and their total
likelihood is the hypothesis' evidence, by which the hypotheses are weighed (Gaussian sums: Sorenson,
Alspach 1971).

Where rate and law are known, the filter is the Kalman filter of a Wiener process with drift, exactly.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lacuna.analysis.prognosis.bank import GONE, Bank, Beliefs

ROOT_2PI = np.sqrt(2 * np.pi)
PRUNED_EVERY = 4  # tests
STEEPEST = 50.0  # growth of a deviation between two tests: beyond it a Gaussian means nothing


@dataclass(frozen=True)
class Series:
    """Tests of B histories as shares of the limit, padded to a common length n. The first test is at use 0.

    `use` [B, n] never falls; `valid` [B, n] False where there is no severity (not done, refused, padding). `below` and
    `above` are standard deviations of each side of the interval. `interval` [B] is the usual use between tests.
    """

    use: np.ndarray
    value: np.ndarray
    below: np.ndarray
    above: np.ndarray
    valid: np.ndarray
    interval: np.ndarray


@dataclass(frozen=True)
class Step:
    """What one column of tests did: beliefs before and after, and the way in which each test was read; `bank` has the
    hypotheses that the beliefs are of."""

    bank: Bank
    predicted: Beliefs
    slope: tuple[np.ndarray, np.ndarray]  # dx'/dx, dx'/dl from the test before
    filtered: Beliefs
    outlier: np.ndarray  # [B] probability that the test says nothing
    evidence: np.ndarray  # [B] logarithm of the test's likelihood


def run(bank: Bank, series: Series, *, prune: bool = False) -> Iterator[Step]:
    """One Step for each column of `series`. With `prune`, hypotheses that no history needs any more are left out."""
    beliefs = bank.start(series.interval)
    before = np.zeros(len(series.use))
    for k in range(series.use.shape[1]):
        predicted, slope = predict(bank, beliefs, series.use[:, k] - before)
        beliefs, outlier, evidence = update(bank, predicted, slope[1], series, k)
        before = series.use[:, k]
        yield Step(bank, predicted, slope, beliefs, outlier, evidence)
        if prune and k % PRUNED_EVERY == PRUNED_EVERY - 1:
            kept = np.flatnonzero((beliefs.w > GONE).any(axis=(0, 1)))
            if len(kept) < beliefs.w.shape[2]:
                bank, beliefs = bank.only(kept), beliefs.only(kept)


def predict(bank: Bank, b: Beliefs, use: np.ndarray) -> tuple[Beliefs, tuple[np.ndarray, np.ndarray]]:
    """Beliefs after `use` [B] more, and the slopes of the new severity."""
    moved = np.exp(np.minimum(b.l, 700)) * use[None, :, None]  # by which the age rises
    x = bank.each("severity", bank.each("age", b.x) + moved)
    growth = bank.each("growth", x)
    along = np.minimum(growth / bank.each("growth", b.x), STEEPEST)
    turn = np.minimum(moved * growth, STEEPEST)
    xl = along * b.xl + turn * b.ll
    xx = along * along * b.xx + turn * (along * b.xl + xl) + bank.diffusion2 * np.maximum(x - b.x, 0)
    ll = b.ll + bank.wander2 * np.minimum(moved / bank.life, 1)
    return Beliefs(x, b.l, xx, xl, ll, b.w), (along, turn)


def update(bank: Bank, b: Beliefs, turn: np.ndarray, series: Series, k: int):
    """(beliefs, probability of an outlier [B], log evidence [B]) after the tests of column `k`."""
    settings = bank.settings
    value, below, above = (a[:, k][None, :, None] for a in (series.value, series.below, series.above))
    miss = value - b.x
    variance = (1 - bank.common) * np.where(miss < 0, above, below) ** 2
    jump = settings.change_size**2
    changed = (b.xx + jump * turn * turn, b.xl + jump * turn, b.ll + jump)
    usual = 1 - settings.wide - settings.outlier - bank.change
    ways = [
        (usual, b.xx, b.xl, b.ll, variance),
        (settings.wide, b.xx, b.xl, b.ll, settings.wide_scale**2 * variance),
        (bank.change, *changed, variance),
    ]
    density = np.full(b.x.shape, settings.outlier / settings.outlier_range)
    total, dx, dl = density.copy(), 0.0, 0.0
    xx, xl, ll = density * b.xx, density * b.xl, density * b.ll
    for share, pxx, pxl, pll, r in ways:
        s = pxx + r
        p = (share / ROOT_2PI) * np.exp(-0.5 * miss * miss / s) / np.sqrt(s)
        gain, turned = pxx / s, pxl / s
        ex, el = gain * miss, turned * miss
        total += p
        dx, dl = dx + p * ex, dl + p * el
        xx += p * (pxx - gain * pxx + ex * ex)
        xl += p * (pxl - gain * pxl + ex * el)
        ll += p * (pll - turned * pxl + el * el)
    dx, dl = dx / total, dl / total
    w = b.w * total
    evidence = w.sum(axis=(0, 2))
    outlier = (b.w * density).sum(axis=(0, 2)) / evidence
    w = w / evidence[None, :, None]
    after = Beliefs(
        b.x + dx, b.l + dl, xx / total - dx * dx, xl / total - dx * dl, ll / total - dl * dl, w
    )  # fmt: skip
    valid = series.valid[:, k]
    if valid.all():
        return after, outlier, np.log(evidence)
    after.put(~valid, b.rows(~valid))
    return after, np.where(valid, outlier, 0.0), np.where(valid, np.log(evidence), 0.0)
