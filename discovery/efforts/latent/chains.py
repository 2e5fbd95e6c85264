"""An unknown effort, and errors of instruments, as hypotheses about one recording after the other."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lacuna.analysis.spectra.library import INTEGERS, CLatent, pointer
from lacuna.discovery.efforts.latent.along import Along


@dataclass(frozen=True)
class Colour:
    """Errors of instruments that have a memory, beside their white noise: drifts and coloured noise of unknown level,
    each a chain like an effort's, added to the reading of its `sensor` (an output's number); and efforts at other
    places, each in its `column`."""

    sensor: np.ndarray  # (c,) int; -1: it is an effort
    size: np.ndarray  # (h, c)
    time: np.ndarray  # (h, c) s
    column: np.ndarray | None = None  # (c,) int; -1: it is an error of a sensor. None: all are

    def repeated(self, count: int) -> Colour:
        """Those of the first hypothesis for each of `count`."""
        return replace(self, size=np.tile(self.size[:1], (count, 1)), time=np.tile(self.time[:1], (count, 1)))

    def one(self, k: int) -> Colour:
        """Those of hypothesis k alone."""
        return replace(self, size=self.size[k : k + 1], time=self.time[k : k + 1])

    def beside(self, column: int, sensor: int, size: float, time: float) -> Colour:
        """The same, of one hypothesis, and an effort, or a further error of a sensor."""
        own = np.full(len(self.sensor), -1) if self.column is None else self.column
        return Colour(
            np.append(self.sensor, sensor), np.append(self.size, [[size]], 1), np.append(self.time, [[time]], 1),
            np.append(own, column),
        )  # fmt: skip


@dataclass(frozen=True)
class Latent:
    """Hypotheses side by side: the column where the effort acts (-1: nowhere), its size s and its time constant l, s.

    A `sensor` (an output's number, -1: none) has the effort added to its reading instead. `colour` is what instruments
    may have of their own.
    """

    column: np.ndarray  # (h,) int
    sensor: np.ndarray  # (h,) int
    size: np.ndarray  # (h,)
    time: np.ndarray  # (h,)
    colour: Colour | None = None

    def of_library(self) -> tuple[CLatent, list[np.ndarray]]:
        """The same for the library's filters: of each hypothesis its effort, then its colour; and the arrays that have
        to last as long."""
        parts = [self.column, self.sensor], [self.size, self.time]
        whole = [np.reshape(a, (-1, 1)) for part in parts for a in part]
        if self.colour is not None:
            colour, none = self.colour, np.full(len(self.colour.sensor), -1)
            own = (none if colour.column is None else colour.column, colour.sensor, colour.size, colour.time)
            wide = [np.broadcast_to(a, (len(self.size), len(none))) for a in own]
            whole = [np.hstack(pair) for pair in zip(whole, wide, strict=True)]
        column, sensor = (np.ascontiguousarray(a, dtype=np.intc) for a in whole[:2])
        size, time = (np.ascontiguousarray(a, dtype=float) for a in whole[2:])
        numbers = [a.ctypes.data_as(INTEGERS) for a in (column, sensor)]
        return CLatent(*column.shape, *numbers, pointer(size), pointer(time)), [column, sensor, size, time]


@dataclass
class Piece:
    """One recording: the linear model, `data` (n, y, 1 + p): the residual and, weighted by their beliefs, the responses
    to parameters, NaN where missing; `noise` (y,) standard deviations; `start` (x,) those of the first states."""

    along: Along
    data: np.ndarray
    noise: np.ndarray
    start: np.ndarray

    @property
    def seen(self) -> np.ndarray:
        """(n, y) where there is a reading."""
        return np.isfinite(self.data).all(axis=2)
