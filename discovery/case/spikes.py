"""Single samples of an output that leave and return at once, far outside the signal's own steps: errors of a logger,
not of a machine. They are left out, as samples that are missing, and the report says so."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lacuna.discovery.case.cases import Case, Recording


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


def without_spikes(case: Case) -> Case:
    """The case with such samples of its outputs as missing ones."""

    def cleared(recording: Recording) -> Recording:
        columns = dict(recording.columns)
        for signal in case.outputs:
            found, _ = spikes(columns[signal.column])
            if len(found):
                columns[signal.column] = columns[signal.column].copy()
                columns[signal.column][found] = np.nan
        return replace(recording, columns=columns)

    return replace(case, fit=[cleared(r) for r in case.fit], validate=[cleared(r) for r in case.validate])
