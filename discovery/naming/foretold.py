"""How far the errors of fitted parameters let a model be off on recordings that it was not fitted to.

A pendulum near its upper rest or a lightly damped resonance makes much of little: an error there is no sign of missing
physics while parameters within their own errors make as large ones. Drawn, not linearised, for that reason.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lacuna.discovery.case.cases import Recording
from lacuna.discovery.fit.fit import Fit, nrmse, residuals_of

DRAWS = 19  # of the parameters: that the truth is further off than all of them has a chance of 1 in 20


def foretold(found: Fit, recordings: Sequence[Recording]) -> dict[str, float]:
    """The most, as NRMSE of each output, that draws of the parameters change on these recordings; 0 where none runs."""
    case, estimate = found.machine.case, found.estimate
    here = residuals_of(found.machine, recordings, found.point)
    covariance = estimate.covariance(found.inflation())
    values, vectors = np.linalg.eigh(covariance)
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    random = np.random.default_rng(0)
    moves: list[dict[str, float]] = []
    for _ in range(DRAWS):
        moved = estimate.values + root @ random.standard_normal(len(values))
        point = found.fixed | {f.name: f.clip(v) for f, v in zip(estimate.free, moved, strict=True)}
        there = residuals_of(found.machine, recordings, point)
        if here is None or there is None:
            continue
        change = {
            r.name: {c: there[r.name][c] - here[r.name][c] for c in found.noise} for r in recordings
        }  # fmt: skip
        moves.append(nrmse(case, recordings, change))
    return {c: max((m[c] for m in moves), default=0.0) for c in found.noise}
