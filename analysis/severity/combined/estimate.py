"""Both severities of a recording: their joint posterior on a fine grid, and what it says."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.stats import chi2

from lacuna.analysis.severity.combined.grid import Grid

FINER = 8  # nodes of the fine grid for one of the simulated one
READABLE = 0.5  # of an axis: a severity whose 95 % interval is wider cannot be read


@dataclass(frozen=True)
class Reading:
    """Of one severity."""

    severity: float
    low: float  # 95 % interval
    high: float
    readable: bool


@dataclass(frozen=True)
class JointEstimate:
    first: Reading
    second: Reading
    correlation: float  # of the two
    misfit: float  # squared distance to the map, in standard deviations
    covered: bool
    density: np.ndarray  # posterior on the fine grid, [x, y], largest 1


class JointEstimator:
    """Generalised least squares over a grid, averaged over the levels of the first nuisance.

    With s the signature, m its mean and C its covariance at the nearest simulated node of a level, the posterior at a
    node of the fine grid is proportional to exp(-(s - m)' C^-1 (s - m)/2), each level weighed by the likelihood of its
    best node. Both severities are equally likely over their axes beforehand.
    """

    def __init__(self, grid: Grid):
        self.grid = grid
        self.x, self.y = (np.linspace(a[0], a[-1], FINER * (len(a) - 1) + 1) for a in (grid.x, grid.y))
        fine = np.stack(np.meshgrid(self.x, self.y, indexing="ij"), axis=-1)
        self._mean = np.array([RegularGridInterpolator((grid.x, grid.y), m, method="cubic")(fine) for m in grid.mean])
        whitening = np.linalg.inv(np.linalg.cholesky(grid.covariance))
        near_x, near_y = (np.abs(f[:, None] - a).argmin(axis=1) for f, a in ((self.x, grid.x), (self.y, grid.y)))
        self._whitening = whitening[:, near_x][:, :, near_y]
        self._log_determinant = -2 * np.log(np.diagonal(self._whitening, axis1=-2, axis2=-1)).sum(axis=-1)
        improbable = grid.settings.table("assessment")["improbable"]
        self._limit = float(chi2.isf(improbable, self._mean.shape[-1] - 2))

    def estimate(self, signature: np.ndarray) -> JointEstimate:
        """`signature` [n]."""
        apart = np.einsum("lxyij,lxyj->lxyi", self._whitening, signature - self._mean)
        distance = (apart**2).sum(axis=-1)
        flat = distance.reshape(len(distance), -1)
        best = flat.argmin(axis=1)
        evidence = self._log_determinant.reshape(len(distance), -1)[np.arange(len(best)), best]
        cost = distance + evidence[:, None, None]
        density = np.exp(-0.5 * (cost - cost.min())).sum(axis=0)
        density /= density.sum()
        mean_x, mean_y = density.sum(axis=1) @ self.x, density.sum(axis=0) @ self.y
        dx, dy = self.x - mean_x, self.y - mean_y
        variances = (density.sum(axis=1) @ dx**2) * (density.sum(axis=0) @ dy**2)
        misfit = float(distance.min())
        return JointEstimate(
            first=_reading(self.x, density.sum(axis=1)),
            second=_reading(self.y, density.sum(axis=0)),
            correlation=float(dx @ density @ dy / np.sqrt(variances)) if variances > 0 else 0.0,
            misfit=misfit,
            covered=misfit <= self._limit,
            density=density / density.max(),
        )


def _reading(axis: np.ndarray, weight: np.ndarray) -> Reading:
    """Mean and 95 % interval of a density that is piecewise constant about the nodes of `axis`.

    The interval is widened to its mean, which lies beyond it where nearly all weight is on the first node or the last.
    """
    edges = np.concatenate([axis[:1], (axis[1:] + axis[:-1]) / 2, axis[-1:]])
    low, high = np.interp([0.025, 0.975], np.concatenate([[0.0], np.cumsum(weight)]), edges)
    mean = float(weight @ axis)
    low, high = min(float(low), mean), max(float(high), mean)
    return Reading(mean, low, high, high - low <= READABLE * float(axis[-1] - axis[0]))
