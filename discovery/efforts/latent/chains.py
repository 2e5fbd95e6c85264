"""An unknown effort, and errors of instruments, as hypotheses about one recording after the other."""

from __future__ import annotations

from collections.abc import Sequence
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

    def of(self, rows: Sequence[int]) -> Colour:
        """Those of these hypotheses alone."""
        return replace(self, size=self.size[rows], time=self.time[rows])

    def beside(self, other: Latent) -> Colour:
        """The same, of one hypothesis, and the efforts, or the error of a sensor, of another one."""
        own = np.full(len(self.sensor), -1) if self.column is None else self.column
        column, count = other.column[0], other.column.shape[1]
        sensor = np.full(count, -1)
        sensor[0] = other.sensor[0]
        size, time = (np.repeat(v[:1, None], count, axis=1) for v in (other.size, other.time))
        return Colour(
            np.append(self.sensor, sensor), np.hstack([self.size, size]), np.hstack([self.time, time]),
            np.append(own, column),
        )  # fmt: skip


@dataclass(frozen=True)
class Latent:
    """Hypotheses side by side: the columns where efforts act (-1: nowhere), their size s and their time constant l, s.

    At the places of a family each has an effort of a course of its own, all of one size and time constant.
    A `sensor` (an output's number, -1: none) has the effort added to its reading instead. `colour` is what instruments
    may have of their own.
    """

    column: np.ndarray  # (h, m) int; those of fewer columns end in -1
    sensor: np.ndarray  # (h,) int
    size: np.ndarray  # (h,)
    time: np.ndarray  # (h,)
    colour: Colour | None = None

    def of(self, rows: Sequence[int]) -> Latent:
        """These hypotheses alone, with as many columns as they need."""
        widest = max(1, int(np.max(self.width[rows])))
        own = (v[rows] for v in (self.sensor, self.size, self.time))
        return Latent(self.column[rows][:, :widest], *own, self.colour.of(rows) if self.colour else None)

    @property
    def width(self) -> np.ndarray:
        """(h,) how many columns each acts in."""
        return np.sum(self.column >= 0, axis=1)

    def of_library(self) -> tuple[CLatent, list[np.ndarray]]:
        """The same for the library's filters: of each hypothesis its efforts, then its colour; and the arrays that have
        to last as long."""
        none = np.full(self.column[:, 1:].shape, -1)
        size, time = (np.broadcast_to(v[:, None], self.column.shape) for v in (self.size, self.time))
        whole = [self.column, np.hstack([self.sensor[:, None], none]), size, time]
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
