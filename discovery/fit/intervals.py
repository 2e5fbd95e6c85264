"""Standard errors of fitted parameters: noise with its colour, rounding, and rough ground.

Sandwich covariance: each signal's share of the score has the variance that the colour of its residual gives it. The
error of a signal whose resolution is coarser than its noise is rounding, which is the same wherever the signal comes
by the same value again; so the fitted outputs are rounded, the levels anywhere, and the variance that this gives the
score counts where it is the larger. Where events make the sum of squares rough, sensitivities are taken with the
shafts held near their recorded motion, and what the values move by when they are released is an error too: no
derivative at the end of such a fit says how far it may be from the best one. So is what the solver's error moves, and
what the digits that are not written of recorded inputs may have moved. Nor are the zeros of the sensors known better
than a reading is: what they are, and how they drift, is a part of each error.
"""

from __future__ import annotations

import numpy as np

from lacuna.discovery.case.noise import is_coarse, sample_weights
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.lead import Lead
from lacuna.discovery.fit.secants import input_shift, solver_shift, with_secants
from lacuna.discovery.fit.zeros import beside_zeros

UNHELD = 1e-13  # share of the largest eigenvalue, below which a direction is rounding's alone
PART = 1e-3  # component of such a direction, from which a parameter is part of it
ROUNDINGS = 32  # places of the levels, over which rounding is averaged


def standard_errors(fit: Fit, lead: Lead | None = None) -> dict[str, float]:
    """1-sigma of each free parameter in its unit, to the inside at a bound; `lead` is how the fit was led.

    Infinite where neither data nor belief tells a direction that the parameter is part of, or no more than that it is
    within its bounds.
    """
    held = with_secants(lead.hold_fast(fit) if lead else fit)
    moved = held.estimate.values - fit.estimate.values
    noisy = np.diag(covariance(beside_zeros(held)))[: len(moved)]  # those of the zeros come last
    variance = noisy + moved**2 + solver_shift(held) ** 2 + input_shift(held) ** 2
    free = undetermined(held.estimate.normal) | ~narrowed(held)
    return {
        f.name: float("inf") if open_ else from_bound(held, k) if fit.estimate.at_bound(f.name) else float(np.sqrt(v))
        for k, (f, v, open_) in enumerate(zip(fit.estimate.free, variance, free, strict=True))
    }


def narrowed(fit: Fit) -> np.ndarray:
    """Of which parameters (p,) data or belief tell more than their bounds do, were all others known."""
    estimate = fit.estimate
    moves = np.sqrt(np.diag(estimate.normal))
    within = np.array([(f.upper - f.lower) / f.scale for f in estimate.free])
    return (moves > 0) & (within * np.where(moves > 0, moves, 1.0) > 1.0)


def from_bound(fit: Fit, k: int) -> float:
    """How far from its bound a parameter costs what one sigma does, 2 g s + h s^2 = 1, the others following, with the
    gradient 2 g, by which the data pushes it there, and the curvature h."""
    estimate = fit.estimate
    inside = [j for j, f in enumerate(estimate.free) if j != k and not estimate.at_bound(f.name)]
    normal, across = estimate.normal[np.ix_(inside, inside)], estimate.normal[inside, k]
    curvature = float(estimate.normal[k, k] - across @ np.linalg.pinv(normal, hermitian=True) @ across)
    rows = zip(estimate.jacobian, estimate.residuals, strict=True)  # those of what holds a shaft come last
    pull = sum(float(b[: len(r), k] @ r) for b, r in rows)
    f, value = estimate.free[k], float(estimate.values[k])
    pull = abs(pull + ((value - f.centre) * f.scale / f.sigma**2 if f.sigma else 0.0))
    return f.scale * fit.inflation() / (pull + float(np.sqrt(pull**2 + max(curvature, 0.0) * fit.inflation())))


def undetermined(normal: np.ndarray) -> np.ndarray:
    """Which parameters (p,) are part of a direction that the normal matrix (p, p) does not hold."""
    size = np.sqrt(np.diag(normal))
    dead = size == 0
    scaled = normal / np.outer(np.where(dead, 1.0, size), np.where(dead, 1.0, size))
    values, vectors = np.linalg.eigh(scaled)
    null = vectors[:, values < UNHELD * max(values.max(initial=0.0), 1e-300)]
    return dead | np.any(np.abs(null) > PART, axis=1)


def covariance(fit: Fit) -> np.ndarray:
    """Covariance (p, p) of the free parameters in their units, rows of those at a bound zero, and of those of which
    nothing is known but their bounds."""
    estimate = fit.estimate
    if not estimate.jacobian:
        return estimate.covariance(fit.inflation())
    scales = np.array([0.0 if estimate.at_bound(f.name) else f.scale for f in estimate.free])
    inside = (scales > 0) & narrowed(fit)
    inverse = np.zeros_like(estimate.normal)
    normal = estimate.normal[np.ix_(inside, inside)]
    size = np.sqrt(np.diag(normal))
    size = np.outer(size, size)
    inverse[np.ix_(inside, inside)] = np.linalg.pinv(normal / size, hermitian=True) / size

    def sandwich(score: np.ndarray) -> np.ndarray:
        return inverse @ score @ inverse * np.outer(scales, scales)

    noisy = sandwich(_score_covariance(fit, []))
    coarse = [c for c in fit.noise if is_coarse(fit.noise[c])]
    if not coarse:
        return noisy
    rounded, as_noise = np.diag(sandwich(_score_covariance(fit, coarse))), np.diag(noisy)
    larger = np.sqrt(np.maximum(1.0, rounded / np.where(as_noise > 0, as_noise, 1.0)))
    return noisy * np.outer(larger, larger)


def _score_covariance(fit: Fit, coarse: list[str]) -> np.ndarray:
    """Covariance (p, p) of half the gradient in scaled coordinates: beliefs, and each signal's noise with its colour,
    or the rounding of those that are `coarse`."""
    colour = fit.correlation()
    data = np.zeros_like(fit.estimate.normal)
    total = np.zeros_like(data)
    scores = {c: np.zeros((ROUNDINGS, len(data))) for c in coarse}
    for block, (name, residuals) in zip(fit.estimate.jacobian, fit.residuals.items(), strict=True):
        lengths = [len(residuals[c]) for c in fit.noise]
        for column, rows in zip(fit.noise, np.split(block, np.cumsum(lengths)), strict=False):
            data += rows.T @ rows
            if column in coarse:
                scores[column] += _rounding(fit, name, column) @ rows
            else:
                total += colour[column] * (rows.T @ rows)
    total += sum(s.T @ s / ROUNDINGS for s in scores.values())
    return total + np.maximum(fit.estimate.normal - data, 0.0) * np.eye(len(total))


def _rounding(fit: Fit, recording: str, column: str) -> np.ndarray:
    """Errors (ROUNDINGS, n) that rounding gives a simulated output, weighted so that rows of the Jacobian, which have
    the weights of the recorded samples, make a score of them."""
    noise, weights = fit.noise[column], fit.weights[recording][column]
    measured = next(r.columns[column] for r in fit.machine.case.fit if r.name == recording)
    levels = (measured - fit.residuals[recording][column]) / noise.quantum
    result = np.zeros((ROUNDINGS, len(levels)))
    seen = weights > 0
    for k in range(ROUNDINGS):
        place = (k + 0.5) / ROUNDINGS
        rounded = np.round(levels + place)
        error = (rounded - place - levels) * noise.quantum / (noise.std * fit.level[column])
        result[k, seen] = (error * sample_weights(rounded, noise) ** 2)[seen] / weights[seen]
    return result
