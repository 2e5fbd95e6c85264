"""Degradation laws as tables: what the filter needs of a law's equation, whatever the equation is.

A law gives d x / d n = r G(x; shape), x the severity as a share of its limit, n the use (cycles or hours), r the rate.
In the *age* U(x) = integral of 1/G every such law is linear, U(n) = U(0) + r n: use is found by two table look-ups, and

    dx'/dx = G(x') / G(x),        dx'/d(ln r) = r n G(x')

are exact derivatives of the growth from x to x' over n.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from lacuna.analysis.errors import AnalysisError

LOW, HIGH = 1e-3, 2.0  # shares of the limit between which a law is tabulated; constant growth beyond both
YOUNG = 0.05  # share of the limit from which a life is counted: where most maps begin to see a fault
POINTS = 400
SETTLED = 0.05  # of the largest growth: a law that slows down to it before the limit has lived its life there
STILL = 1e-6  # of the largest growth: slower is as good as never, and keeps ages finite


def severities() -> np.ndarray:
    """[POINTS] where a law's growth is wanted, evenly spaced in the logarithm."""
    return np.geomspace(LOW, HIGH, POINTS)


@dataclass(frozen=True)
class Law:
    """One law at one value of its shape parameters. `growth` is G at `severities()`, for a rate of 1.

    `wander`: standard deviation of ln r after one life. `diffusion`: that of x after growth from 0 to 1.
    Raises AnalysisError where the growth is negative, not finite or nowhere above zero.
    """

    name: str  # identifier of the law
    shape: tuple[tuple[str, float], ...]
    growth: np.ndarray
    wander: float
    diffusion: float
    title: str = ""
    reference: str = ""

    def __post_init__(self):
        if not np.all(np.isfinite(self.growth)) or np.any(self.growth < -1e-12) or not np.any(self.growth > 0):
            raise AnalysisError(
                f"law {self.label}: its growth must be finite, not negative and somewhere above zero between "
                f"{LOW:g} and {HIGH:g} of the limit"
            )
        if not (self.wander >= 0 and self.diffusion >= 0):
            raise AnalysisError(f"law {self.label}: wander and diffusion are standard deviations, not below zero")

    @property
    def label(self) -> str:
        return self.name + "".join(f", {name} = {value:g}" for name, value in self.shape)

    @classmethod
    def of(cls, name: str, growth: Callable[[np.ndarray], np.ndarray], **others) -> Law:
        """From a function, for tests and for laws that are not in the language."""
        settings = {"shape": (), "wander": 0.15, "diffusion": 0.02} | others
        return cls(name, growth=np.broadcast_to(growth(severities()), POINTS).astype(float), **settings)


class LawTable:
    """Growth, age and scatter of one law, as functions of arrays."""

    def __init__(self, law: Law):
        self.law = law
        self.x = severities()
        self.g = np.maximum(law.growth, STILL * law.growth.max())
        self.u = self._integral(1 / self.g)
        self._scatter = self._integral(1 / self.g**2)
        of_life = (self.x >= YOUNG) & (self.x <= 1)
        alive = of_life & (self.g >= SETTLED * self.g[of_life].max())
        self.life = float(self.u[np.flatnonzero(alive)[-1]] - np.interp(YOUNG, self.x, self.u))

    def _integral(self, values: np.ndarray) -> np.ndarray:
        """Of `values` over x from LOW, between points as powers of x: exact for linear, exponential and crack-like
        laws."""
        ratio = self.x[1] / self.x[0]
        power = np.log(values[1:] / values[:-1]) / np.log(ratio) + 1
        flat = np.abs(power) < 1e-9
        width = np.where(flat, np.log(ratio), np.expm1(power * np.log(ratio)) / np.where(flat, 1, power))
        return np.concatenate([[0.0], np.cumsum(self.x[:-1] * values[:-1] * width)])

    def growth(self, x):
        return np.interp(x, self.x, self.g)

    def age(self, x):
        """U(x); below and above the table growth is constant, so that the age goes on along its tangent."""
        inside = np.interp(x, self.x, self.u)
        return inside + np.minimum(x - LOW, 0) / self.g[0] + np.maximum(x - HIGH, 0) / self.g[-1]

    def severity(self, u):
        """The inverse of `age`."""
        inside = np.interp(u, self.u, self.x)
        return inside + np.minimum(u, 0) * self.g[0] + np.maximum(u - self.u[-1], 0) * self.g[-1]

    def scatter(self, x, limit):
        """Variance of the age on reaching `limit` from x, for a diffusion of 1: integral of 1/G^2."""
        return np.maximum(np.interp(limit, self.x, self._scatter) - np.interp(x, self.x, self._scatter), 0)


def tables(laws: Sequence[Law]) -> list[LawTable]:
    if not laws:
        raise AnalysisError("there is no degradation law to forecast by")
    return [LawTable(law) for law in laws]


def prior(laws: Sequence[Law]) -> np.ndarray:
    """[laws] every named law alike, and within a name every shape alike."""
    names = [law.name for law in laws]
    return np.array([1 / (len(set(names)) * names.count(name)) for name in names])
