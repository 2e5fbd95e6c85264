"""Standard errors of fitted parameters: noise with its colour, and rough ground.

Sandwich covariance: each signal's share of the score has the variance that the colour of its residual gives it. Where
events make the sum of squares rough, sensitivities are taken with the shafts held near their recorded motion, and what
the values move by when they are released is an error too: no derivative at the end of such a fit says how far it may
be from the best one.
"""

from __future__ import annotations

import numpy as np

from .fit import Fit
from .lead import Lead


def standard_errors(fit: Fit, lead: Lead | None = None) -> dict[str, float]:
    """1-sigma of each free parameter (in its unit; 0 at a bound); `lead` is how the fit was led."""
    held = lead.hold_fast(fit) if lead else fit
    variance = np.diag(covariance(held)) + (held.estimate.values - fit.estimate.values) ** 2
    return {
        f.name: 0.0 if fit.estimate.at_bound(f.name) else float(np.sqrt(max(v, 0.0)))
        for f, v in zip(fit.estimate.free, variance, strict=True)
    }


def covariance(fit: Fit) -> np.ndarray:
    """Covariance (p, p) of the free parameters in their units, rows of those at a bound zero."""
    estimate = fit.estimate
    if not estimate.jacobian:
        return estimate.covariance(fit.inflation())
    scales = np.array([0.0 if estimate.at_bound(f.name) else f.scale for f in estimate.free])
    inside = scales > 0
    inverse = np.zeros_like(estimate.normal)
    inverse[np.ix_(inside, inside)] = np.linalg.pinv(estimate.normal[np.ix_(inside, inside)], hermitian=True)
    return inverse @ _score_covariance(fit) @ inverse * np.outer(scales, scales)


def _score_covariance(fit: Fit) -> np.ndarray:
    """Covariance (p, p) of half the gradient in scaled coordinates: beliefs, and each signal with its colour."""
    colour = fit.correlation()
    data = np.zeros_like(fit.estimate.normal)
    total = np.zeros_like(data)
    for block, residuals in zip(fit.estimate.jacobian, fit.residuals.values(), strict=True):
        lengths = [len(residuals[c]) for c in fit.noise]
        for column, rows in zip(fit.noise, np.split(block, np.cumsum(lengths)), strict=False):
            data += rows.T @ rows
            total += colour[column] * (rows.T @ rows)
    return total + np.maximum(fit.estimate.normal - data, 0.0) * np.eye(len(total))
