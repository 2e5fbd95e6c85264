"""Single samples of an output that leave and return at once, far outside the signal's own steps: errors of a logger,
not of a machine."""

from __future__ import annotations

import numpy as np


def spikes(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(numbers of such samples of a signal (n,), how far each jumps and returns); missing samples between are passed
    over."""
    seen = np.flatnonzero(np.isfinite(values))
    own = values[seen]
    left, right = own[1:-1] - own[:-2], own[1:-1] - own[2:]
    size = np.where(left * right > 0, np.minimum(np.abs(left), np.abs(right)), 0.0)
    steps = np.sort(np.abs(np.diff(own)))
    few = max(6, len(steps) // 1000)  # steps that a signal may make of its own, beyond its usual ones: of three spikes
    if len(steps) <= few:
        return seen[:0], size[:0]
    usual = max(float(steps[-1 - few]), 1e-300)
    found = np.flatnonzero(size > 8 * usual)  # an order of magnitude: no course of its own
    return seen[1:-1][found], size[found]
