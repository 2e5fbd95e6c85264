"""How far tests scatter about their part's trend, learnt from lives of a fleet: by severity, from second differences.

A test lies off the straight line between its neighbours by its own error and theirs, whatever the part's rate and law,
and whatever error all tests of the part have in common:

    d = y1 - (1 - a) y0 - a y2,    variance of d = s1^2 + (1 - a)^2 s0^2 + a^2 s2^2,    a the share of use at y1

The stated intervals bound the errors of any actuator, in any condition, and hold what its tests have in common; how
they scatter may be several times less, differently at each severity. Two models are held against the differences: an
interval tells its own test's scatter up to a factor, or tells nothing of it beyond the severity. That of the greater
likelihood (Cauchy's of that median, which outliers do not carry away) is taken. Growth is curved and noisy as well,
which widens what is found a little.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

NORMAL = 1.4826  # standard deviation of a normal variable over the median of its magnitude
GROUP = 136  # differences that tell a spread to a tenth: 37 % efficient (Rousseeuw, Croux 1993), 1 / (2 0.37 0.1^2)


@dataclass(frozen=True)
class Scatter:
    """`spread` [g] at `severity` [g], a share of the limit: standard deviations, or what a stated one is to be
    multiplied by where the stated ones tell it (`stated`)."""

    severity: np.ndarray
    spread: np.ndarray
    stated: bool

    def deviation(self, severity: np.ndarray, stated: np.ndarray) -> np.ndarray:
        """Standard deviation of tests that read `severity` and state `stated`, of one shape."""
        return np.interp(severity, self.severity, self.spread) * (stated if self.stated else 1.0)


Life = tuple[np.ndarray, np.ndarray, np.ndarray]  # use, severity and stated standard deviation of its tests, [n] each


def scatter_of(lives: Iterable[Life], floor: float) -> Scatter | None:
    """Of the tests of these lives, not below `floor`; None where fewer than GROUP of them have neighbours."""
    parts = [_differences(*life) for life in lives if len(life[0]) >= 3]
    if sum(len(severity) for severity, _, _ in parts) < GROUP:
        return None
    severity, difference, width = (np.concatenate(column) for column in zip(*parts, strict=True))
    models = [_fitted(severity, abs(difference), width[:, k], floor, stated=bool(k)) for k in range(2)]
    return max(models, key=lambda model: model[0])[1]


def _differences(use: np.ndarray, severity: np.ndarray, sd: np.ndarray) -> tuple[np.ndarray, ...]:
    """(severity, difference) [n - 2] of each test and its neighbours, and [n - 2, 2] what the difference's deviation
    is in units of the scatter: where that is the same for the three, and where it is as they state."""
    span = use[2:] - use[:-2]
    a = np.where(span > 0, (use[1:-1] - use[:-2]) / np.where(span > 0, span, 1), 0.5)
    three = np.stack([severity[:-2], severity[1:-1], severity[2:]])
    share = np.stack([1 - a, np.ones_like(a), a])
    difference = three[1] - share[0] * three[0] - share[2] * three[2]
    own = np.stack([sd[:-2], sd[1:-1], sd[2:]])
    widths = [np.sqrt((share**2).sum(axis=0)), np.sqrt((share**2 * own**2).sum(axis=0))]
    return np.median(three, axis=0), difference, np.stack(widths, axis=1)


def _fitted(severity, difference, width, floor: float, *, stated: bool) -> tuple[float, Scatter]:
    """(logarithm of the likelihood, model) by medians of groups alike in severity."""
    order = np.argsort(severity, kind="stable")
    groups = np.array_split(order, len(order) // GROUP)
    middle = np.array([np.median(severity[g]) for g in groups])
    least = floor / NORMAL  # of the magnitude: equal readings leave none
    median = np.array([max(np.median(difference[g] / width[g]), least / np.median(width[g])) for g in groups])
    of_test = width * np.interp(severity, middle, median)
    likelihood = -(np.log(of_test) + np.log1p((difference / of_test) ** 2)).sum()
    return float(likelihood), Scatter(middle, NORMAL * median, stated)
