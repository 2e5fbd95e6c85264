"""What a fit says of recordings that it is not fitted to: each left out in turn, to first order, without a simulation.

With the Jacobian of a fit at hand the parameters that the other recordings give are one step of Gauss and Newton away,
and exact where the outputs are linear in them. A case of one recording is left out in stretches. Choices are made by
this; validation recordings only judge what was chosen.

Reference: R. D. Cook, S. Weisberg, Residuals and Influence in Regression, 1982, ch. 5.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.linalg import eigh

from lacuna.discovery.case.cases import Case
from lacuna.discovery.fit.fit import Fit, nrmse

STRETCHES = 4  # of the only recording
TOLD = 0.05  # share of what is known of a direction, that the others must hold: less says nothing, and it stays


def left_out(case: Case, found: Fit) -> dict[str, float]:
    """NRMSE of each output, and of the case under "", each fit recording told by the others."""
    return nrmse(case, case.fit, left_out_residuals(found))


def left_out_residuals(found: Fit) -> dict[str, dict[str, np.ndarray]]:
    """Measured minus told (n,), SI, by recording and column."""
    estimate = found.estimate
    if not estimate.jacobian:
        return found.residuals
    moves = [np.zeros_like(residuals) for residuals in estimate.residuals]
    for k, rows in _parts(found):  # no row is in two
        block, error = estimate.jacobian[k][rows], estimate.residuals[k][rows]
        moves[k][rows] = block @ _step(estimate.normal, block, error)
    return {name: found.moved(name, move) for name, move in zip(found.residuals, moves, strict=True)}


def _parts(found: Fit) -> Iterator[tuple[int, np.ndarray]]:
    """(recording, rows of its Jacobian) that are left out together; rows of trackers never are."""
    for k, (columns, block) in enumerate(zip(found.residuals.values(), found.estimate.jacobian, strict=True)):
        samples = len(next(iter(columns.values())))
        whole = np.arange(min(samples * len(found.noise), len(block)))
        pieces = np.array_split(np.arange(samples), 1 if len(found.residuals) > 1 else STRETCHES)
        yield from ((k, whole[np.isin(whole % samples, piece)]) for piece in pieces)


def _step(normal: np.ndarray, block: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Step (p,) in scaled coordinates from the fit to that without the rows of `block`, in directions that the rest
    tells."""
    size = np.sqrt(np.maximum(np.diag(normal), 1e-300))
    whole = normal / np.outer(size, size)
    values, vectors = np.linalg.eigh(whole)
    seen = values > 1e-12 * values[-1]
    root = vectors[:, seen] / np.sqrt(values[seen])  # whole = identity in these coordinates
    own = (block / size) @ root
    shares, axes = eigh(np.eye(own.shape[1]) - own.T @ own)
    told = shares > TOLD
    load = axes[:, told].T @ (own.T @ error)
    return (root @ (axes[:, told] @ (load / shares[told]))) / size
