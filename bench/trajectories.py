"""Trajectories beside a reference that another tool computed: the largest deviation of each signal, in its range."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

JUMP = 1e-4  # of a signal's range: what two rows at one time differ by where the signal is discontinuous
CONSTANT = 1e-6  # of its magnitude: a signal that varies by less is judged by its magnitude


@dataclass(frozen=True)
class Reference:
    """`time` as recorded, both rows of an event kept, and the signals by name."""

    time: np.ndarray
    signals: dict[str, np.ndarray]

    @property
    def grid(self) -> np.ndarray:
        return np.unique(self.time)


def read_reference(path: Path) -> Reference:
    """A CSV file with a row of names; the first column is the time (s)."""
    with path.open(newline="") as file:
        rows = csv.reader(file)
        names = next(rows)
        table = np.array([[float(x) for x in row] for row in rows])
    return Reference(table[:, 0], {name: table[:, k] for k, name in enumerate(names) if k})


def scale_of(values: np.ndarray) -> float:
    """The range of a signal; its magnitude where it is constant, 1 where it is zero."""
    span, size = float(np.ptp(values)), float(np.max(np.abs(values)))
    return span if span > CONSTANT * size else size or 1.0


def deviation(reference: Reference, name: str, time: np.ndarray, values: np.ndarray) -> float:
    """The largest |values - reference| in units of the signal's range, outside a band of one output interval round
    each time at which the reference of this signal jumps. Infinite where a value is no number or rows are missing.

    `time` increases strictly and lies on the reference's grid.
    """
    wanted = reference.signals[name]
    scale = scale_of(wanted)
    keep = np.append(np.diff(reference.time) > 0, True)  # the last row of each time
    grid, expected = reference.time[keep], wanted[keep]
    if len(values) < len(grid) or not np.all(np.isfinite(values)):
        return float("inf")
    interval = float(np.median(np.diff(grid)))
    at_event = np.flatnonzero(np.diff(reference.time) == 0)
    jumps = reference.time[at_event[np.abs(wanted[at_event + 1] - wanted[at_event]) > JUMP * scale]]
    found = np.interp(grid, time, values)
    outside = np.ones(len(grid), dtype=bool)
    for at in jumps:
        outside &= np.abs(grid - at) > interval * 1.001
    return float(np.max(np.abs(found - expected)[outside] / scale, initial=0.0))
