"""Trajectories beside a reference that another tool computed: the largest deviation of each signal, in its range."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lacuna.rows import rows_of

JUMP = 1e-4  # of a signal's range: what two rows at one time differ by where the signal is discontinuous
CONSTANT = 1e-6  # of its magnitude: a signal that varies by less is judged by its magnitude


@dataclass(frozen=True)
class Reference:
    """`time` as recorded, both rows of an event kept, and the signals by name."""

    time: np.ndarray
    signals: dict[str, np.ndarray]
    digits: int  # significant ones that times are written with

    @property
    def grid(self) -> np.ndarray:
        """Every time, and both ends of what it may stand for where it is that of an event."""
        events = self.time[np.flatnonzero(np.diff(self.time) == 0)]
        off = self.rounding(events)
        around = np.clip(np.concatenate([events - off, events + off]), self.time[0], self.time[-1])
        return np.unique(np.concatenate([self.time, around]))

    def rounding(self, time: np.ndarray) -> np.ndarray:
        """By how much `time` may have been rounded when it was written (s)."""
        size = np.floor(np.log10(np.abs(time), out=np.zeros_like(time), where=time != 0))
        return np.where(time != 0, 0.5 * 10.0 ** (size + 1 - self.digits), 0.0)


def read_reference(path: Path) -> Reference:
    """A CSV file with a row of names; the first column is the time (s)."""
    (_, names), *rows = rows_of(path.read_text(encoding="utf-8"))
    written = [row for _, row in rows]
    table = np.array([[float(x) for x in row] for row in written])
    digits = max(len(row[0].lower().split("e")[0].replace(".", "").lstrip("0")) for row in written)
    return Reference(table[:, 0], {name: table[:, k] for k, name in enumerate(names) if k}, digits)


def scale_of(values: np.ndarray) -> float:
    """The range of a signal; its magnitude where it is constant, 1 where it is zero."""
    span, size = float(np.ptp(values)), float(np.max(np.abs(values)))
    return span if span > CONSTANT * size else size or 1.0


def deviation(reference: Reference, name: str, time: np.ndarray, values: np.ndarray) -> float:
    """The largest |values - reference| in units of the signal's range, outside a band of one output interval round
    each time at which the reference of this signal jumps. Infinite where a value is no number or rows are missing.

    `time` increases strictly and lies on the reference's grid. A time that was rounded when it was written stands for
    all that it may have been: the reference may have any value that the signal has there.
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
    off = reference.rounding(grid)
    around = [np.interp(grid + part * off, time, values) for part in (-1, 0, 1)]
    outside = np.ones(len(grid), dtype=bool)
    for at in jumps:
        outside &= np.abs(grid - at) > interval * 1.001
    nearest = np.clip(expected, np.min(around, axis=0), np.max(around, axis=0))
    return float(np.max(np.abs(nearest - expected)[outside] / scale, initial=0.0))
