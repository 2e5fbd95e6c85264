"""The Gaussian-sum filter: all hypotheses of all histories, from test to test, in arrays.

    x' = U^-1(U(x) + r n) + diffusion,   l' = l + wander,   l = ln r        (law.py)
    y  = x' + e,   e ~ (1 - common) sigma^2, with sigma of that side of the interval on which x' lies

An extended Kalman filter a hypothesis (Jazwinski 1970), with the derivatives in closed form. A test is read in four
ways at once:
as it is; with a wide error; as an outlier that says nothing; as the first after an abrupt change of the rate. The four
posteriors are merged by their moments (probabilistic data association: Bar-Shalom, Tse 1975), and their total
likelihood is the hypothesis' evidence, by which the hypotheses are weighed (Gaussian sums: Sorenson,
Alspach 1971).

Where rate and law are known, the filter is the Kalman filter of a Wiener process with drift, exactly. The arithmetic is
in C++ (analysis/native/src/hypotheses.cpp).
"""

from __future__ import annotations

from collections.abc import Iterator
import ctypes
from dataclasses import dataclass

import numpy as np

from lacuna.analysis.prognosis.filter.bank import GONE, Bank, Beliefs
from lacuna.analysis.spectra.library import CBeliefs, CHypotheses, CTests, library, pointer


@dataclass(frozen=True)
class Series:
    """Tests of B histories as shares of the limit, padded to a common length n. The first test is at use 0.

    `use` [B, n] never falls; `valid` [B, n] False where there is no severity (not done, refused, padding). `below` and
    `above` are the standard deviations that a test is read with, of each side; `stated` [B, n] is what its assessment
    states. `interval` [B] is the usual use between tests.
    """

    use: np.ndarray
    value: np.ndarray
    below: np.ndarray
    above: np.ndarray
    valid: np.ndarray
    interval: np.ndarray
    stated: np.ndarray


@dataclass(frozen=True)
class Step:
    """One test of all histories. `predicted` is before it, `filtered` after it."""

    filtered: Beliefs
    outlier: np.ndarray  # [B] probability that the test says nothing
    evidence: np.ndarray  # [B] logarithm of the test's likelihood
    predicted: Beliefs | None = None  # where it is kept, as the next
    slope: tuple[np.ndarray, np.ndarray] | None = None  # dx'/dx, dx'/dl from the test before


def run(bank: Bank, series: Series, *, keep: bool = False) -> Iterator[Step]:
    """One Step for each column of `series`. With `keep` all that a smoother needs, of all hypotheses, in arrays of its
    own; else `filtered` lasts until the next one, and what has lost a history (a weight below GONE) is left out of
    it for good, with weight 0."""
    beliefs = bank.start(series.interval)
    hypotheses = _hypotheses(bank, beliefs.x.shape, 0.0 if keep else GONE)
    before = np.zeros(len(series.use))
    for k in range(series.use.shape[1]):
        if keep:
            beliefs = Beliefs(*(value.copy() for value in vars(beliefs).values()))
        yield _step(hypotheses, beliefs, series, k, before, keep)
        before = series.use[:, k]


def _step(hypotheses: CHypotheses, beliefs: Beliefs, series: Series, k: int, before: np.ndarray, keep: bool) -> Step:
    """Takes `beliefs` over the tests of column `k`, in place."""
    use, value, below, above = (
        np.ascontiguousarray(a) for a in (series.use[:, k] - before, series.value[:, k], series.below[:, k],
                                          series.above[:, k])
    )  # fmt: skip
    valid = np.ascontiguousarray(series.valid[:, k], dtype=np.uint8)
    outlier, evidence = np.empty(len(use)), np.empty(len(use))
    size = beliefs.x.shape if keep else (0,)
    predicted = Beliefs(*(np.empty(size) for _ in range(5)), beliefs.w.copy()) if keep else None
    slope = (np.empty(size), np.empty(size)) if keep else None
    tests = CTests(*map(pointer, (use, value, below, above)), valid.ctypes.data)
    library().lacuna_hypotheses_test(
        ctypes.byref(hypotheses), ctypes.byref(tests), ctypes.byref(_pointers(beliefs)),
        ctypes.byref(_pointers(predicted)) if predicted else None, *(map(pointer, slope) if slope else (None, None)),
        pointer(outlier), pointer(evidence),
    )  # fmt: skip
    return Step(beliefs, outlier, np.log(evidence), predicted, slope)


def _hypotheses(bank: Bank, shape: tuple[int, ...], gone: float) -> CHypotheses:
    """What the C++ step must know of the bank; it keeps the arrays alive that it points to."""
    one = bank.tables[0]
    arrays = [
        np.ascontiguousarray(a, dtype=float)
        for a in (one.x, np.array([t.g for t in bank.tables]), np.array([t.u for t in bank.tables]), bank.life,
                  bank.wander2, bank.diffusion2, bank.change, bank.common)
    ]  # fmt: skip
    settings = bank.settings
    laws, histories, columns = shape
    found = CHypotheses(
        laws, histories, columns, len(one.x), *map(pointer, arrays), settings.wide, settings.wide_scale,
        settings.outlier, settings.outlier_range, settings.change_size, gone,
    )  # fmt: skip
    found.arrays = arrays
    return found


def _pointers(beliefs: Beliefs) -> CBeliefs:
    return CBeliefs(*(pointer(value) for value in vars(beliefs).values()))
