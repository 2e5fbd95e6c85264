"""States, effort and errors of instruments as one Markov chain, on all recordings and for all hypotheses side by side.

A step of a filter is a dozen products of small matrices, and to call for one takes longer than to form it: so all
recordings go through their samples together, those that have ended with nothing to read and nothing that moves.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lacuna.discovery.efforts.linear import Along


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

    def with_effort(self, column: int, size: float, time: float) -> Colour:
        """The same, of one hypothesis, and an effort."""
        own = np.full(len(self.sensor), -1) if self.column is None else self.column
        return Colour(
            np.append(self.sensor, -1), np.append(self.size, [[size]], 1), np.append(self.time, [[time]], 1),
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


@dataclass
class Piece:
    """One recording: the linear model, `data` (n, y, 1 + p): the residual and, weighted by their beliefs, the responses
    to parameters, NaN where missing; `noise` (y,) standard deviations; `start` (x,) those of the first states."""

    along: Along
    data: np.ndarray
    noise: np.ndarray
    start: np.ndarray


class Chains:
    """The Markov chains of h hypotheses on r recordings of up to n samples: w states, of which x are the model's and c
    are effort and errors; y outputs, m columns of data. Where hypotheses differ they come last: products run over them.
    """

    def __init__(self, pieces: Sequence[Piece], latent: Latent) -> None:
        self.counts = [len(p.along.time) for p in pieces]
        self.r, self.n, self.h = len(pieces), max(self.counts), len(latent.size)
        data = _padded([p.data for p in pieces], self.n, np.nan)
        self.seen = np.isfinite(data).all(axis=3)  # (n, r, y)
        self.data = np.where(self.seen[..., None], data, 0.0)  # (n, r, y, m)
        self.noise = np.stack([p.noise for p in pieces])  # (r, y)
        self.start = np.stack([p.start for p in pieces])  # (r, x)
        self.step, self.drive, self.read, self.feed = (
            _padded([getattr(p.along, name) for p in pieces], self.n) for name in ("step", "drive", "read", "feed")
        )
        self.x = self.read.shape[3]
        for k, count in enumerate(self.counts):  # where a recording has ended nothing moves
            self.step[count - 1 :, k] = np.eye(self.x)
        self.acts = np.where(latent.column >= 0, 1.0, 0.0)
        self.column = np.maximum(latent.column, 0)
        self.size, time = latent.size[None], latent.time[None]  # (c, h)
        outputs = np.arange(data.shape[2])
        self.reads = (outputs[:, None] == latent.sensor)[:, None].astype(float)  # (y, c, h)
        beside: Sequence[int] | np.ndarray = ()
        if latent.colour is not None:
            colour = latent.colour
            self.size, time = np.vstack([self.size, colour.size.T]), np.vstack([time, colour.time.T])
            own = (outputs[:, None] == colour.sensor)[:, :, None]
            self.reads = np.concatenate([self.reads, np.broadcast_to(own, (*own.shape[:2], self.h))], axis=1)
            beside = () if colour.column is None else colour.column
        self.c, self.w = len(self.size), self.x + len(self.size)
        self.others = [(self.x + 1 + j, int(c)) for j, c in enumerate(beside) if c >= 0]  # state, column of its effort
        self.fed = bool(np.any(self.feed))
        intervals = _padded([np.diff(p.along.time) for p in pieces], self.n)
        self.keeps = np.exp(-intervals[:, :, None, None] / time)  # (n, r, c, h)
        self.added = self.size**2 * (1 - self.keeps**2)
        self.spread = np.concatenate(  # (r, w, h), of the first states
            [np.repeat(self.start[:, :, None], self.h, 2), np.repeat(self.size[None], self.r, 0)], axis=1
        )

    def far(self, k: int, output: int) -> np.ndarray:
        """(r, c, h), or (1, c, h) where it is the same on all: how an output reads effort and errors at sample k."""
        if not self.fed:
            return self.reads[None, output]
        read = np.repeat(self.reads[None, output], self.r, axis=0)
        if self.acts.any():
            read[:, 0] += self.feed[k, :, output][:, self.column] * self.acts
        for at, column in self.others:
            read[:, at - self.x] += self.feed[k, :, output, column, None]
        return read

    def moved(self, k: int, what: np.ndarray) -> np.ndarray:
        """States or covariances (r, w, j, h) after the step from sample k, but for what is added."""
        states = what[:, : self.x]
        result = np.empty_like(what)
        result[:, : self.x] = (self.step[k] @ states.reshape(self.r, self.x, -1)).reshape(states.shape)
        if self.acts.any():
            result[:, : self.x] += (self.drive[k][:, :, self.column] * self.acts)[:, :, None] * what[:, self.x, None]
        for at, column in self.others:
            result[:, : self.x] += self.drive[k, :, :, column, None, None] * what[:, at, None]
        result[:, self.x :] = self.keeps[k][:, :, None] * what[:, self.x :]
        return result

    def whole(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of the first hypothesis: readings (n, r, y, w) with rows of zero where a sample is missing, matrices
        (n, r, w, w) to the next sample, and what is added to the covariance (n, r, w, w) on the way."""
        shape, x = (self.n, self.r), self.x
        read = np.concatenate([self.read, np.broadcast_to(self.reads[..., 0], (*self.read.shape[:3], self.c))], axis=3)
        move, added = np.zeros((*shape, self.w, self.w)), np.zeros((*shape, self.w, self.w))
        move[..., :x, :x] = self.step
        efforts = [(x, int(self.column[0]))] if self.acts[0] else []
        for at, column in [*efforts, *self.others]:
            read[..., at] += self.feed[..., column]
            move[..., :x, at] = self.drive[..., column]
        tail = np.arange(x, self.w)
        move[..., tail, tail], added[..., tail, tail] = self.keeps[..., 0], self.added[..., 0]
        return read * self.seen[..., None], move, added


def _padded(parts: Sequence[np.ndarray], count: int, value: float = 0.0) -> np.ndarray:
    """(count, parts, ...): arrays (n, ...) side by side, the shorter ones followed by `value`."""
    whole = np.full((count, len(parts), *parts[0].shape[1:]), value)
    for k, part in enumerate(parts):
        whole[: min(len(part), count), k] = part[:count]
    return whole
