"""The unknown effort at a place as a latent force: its evidence and its course, by a Kalman filter and smoother.

An effort f with a Gaussian-process prior of Matern type 1/2 (variance s^2, time constant l) drives the linear model; at
the samples it is f[k+1] = exp(-h/l) f[k] + noise, so that with the states it is one Markov chain (Hartikainen, Saerkkae
2011; Alvarez, Luengo, Lawrence 2009). The filter whitens the residual and the responses to the parameters with one and
the same gain (de Jong 1991), so that the parameters are integrated out exactly, over all recordings together. Many
hypotheses (place, s, l) run side by side.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

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


@dataclass
class Evidence:
    """Of each hypothesis: log evidence (natural, without the constant of the noise) and the parameters' estimate."""

    log: np.ndarray  # (h,)
    mean: np.ndarray  # (h, p) in units of belief
    information: np.ndarray  # (h, p, p) the belief included


def evidence(pieces: Sequence[Piece], latent: Latent) -> Evidence:
    """Log evidence with the parameters integrated out (beliefs are standard normal)."""
    count = pieces[0].data.shape[2]
    gram, logdet = np.zeros((len(latent.size), count, count)), np.zeros(len(latent.size))
    for piece in pieces:
        g, d = _filtered(piece, latent)
        gram, logdet = gram + g, logdet + d
    information = gram[:, 1:, 1:] + np.eye(count - 1)
    right = -gram[:, 1:, 0]
    mean = np.linalg.solve(information, right[:, :, None])[:, :, 0] if count > 1 else np.zeros((len(logdet), 0))
    square = gram[:, 0, 0] - np.sum(right * mean, axis=1)
    log = -0.5 * (square + logdet + np.linalg.slogdet(information)[1])
    return Evidence(log, mean, information)


def _filtered(piece: Piece, latent: Latent) -> tuple[np.ndarray, np.ndarray]:
    """(gram (h, m, m) of the whitened columns, log determinant (h,) of the innovations)."""
    chain = _Chain(piece, latent)
    gram, logdet = np.zeros((chain.h, chain.m, chain.m)), np.zeros(chain.h)
    state, cover = chain.begin()
    for k in range(chain.n):
        read, seen, miss = chain.read(k)
        if seen.any():
            gain, whitener, ld = _gain(cover, read, chain.noise)
            innovation = np.where(seen[None, :, None], miss[None] - read @ state, 0.0)
            white = whitener @ innovation
            gram += np.swapaxes(white, 1, 2) @ white
            logdet += ld
            state = state + gain @ innovation
            cover = _joseph(cover, gain, read, chain.noise)
        if k < chain.n - 1:
            move, added = chain.move(k)
            state = move @ state
            cover = move @ cover @ np.swapaxes(move, 1, 2) + added
    return gram, logdet


def _gain(cover: np.ndarray, read: np.ndarray, noise: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(gain, whitening matrix, log determinant); with readings in units of noise the last one is relative to it."""
    crossed = cover @ np.swapaxes(read, 1, 2)
    total = read @ crossed + np.diag(noise**2)
    lower = np.linalg.cholesky(total)
    whitener = np.linalg.inv(lower)
    gain = crossed @ np.swapaxes(whitener, 1, 2) @ whitener
    logdet = 2 * np.sum(np.log(np.diagonal(lower, axis1=1, axis2=2)), axis=1) - 2 * np.sum(np.log(noise))
    return gain, whitener, logdet


def _joseph(cover: np.ndarray, gain: np.ndarray, read: np.ndarray, noise: np.ndarray) -> np.ndarray:
    left = np.eye(cover.shape[1]) - gain @ read
    scaled = gain * noise
    return left @ cover @ np.swapaxes(left, 1, 2) + scaled @ np.swapaxes(scaled, 1, 2)


class _Chain:
    """The Markov chain of states, effort and errors of instruments on one recording, for all hypotheses."""

    def __init__(self, piece: Piece, latent: Latent) -> None:
        self.piece, self.latent, self.noise = piece, latent, piece.noise
        self.n, self.h, self.m = len(piece.along.time), len(latent.size), piece.data.shape[2]
        self.x = piece.along.step.shape[1]
        self.acts = np.where(latent.column >= 0, 1.0, 0.0)
        self.column = np.maximum(latent.column, 0)
        self.size, self.time = latent.size[:, None], latent.time[:, None]
        outputs = np.arange(len(piece.noise))
        self.reads = (outputs[None] == latent.sensor[:, None])[:, :, None].astype(float)
        if latent.colour is not None:
            colour = latent.colour
            self.size, self.time = np.hstack([self.size, colour.size]), np.hstack([self.time, colour.time])
            own = (outputs[:, None] == colour.sensor[None]).astype(float)
            self.reads = np.concatenate([self.reads, np.broadcast_to(own, (self.h, *own.shape))], axis=2)
        self.width = self.x + self.size.shape[1]
        beside = () if latent.colour is None or latent.colour.column is None else latent.colour.column
        self.others = [(self.x + 1 + j, int(c)) for j, c in enumerate(beside) if c >= 0]  # state, column of its effort

    def begin(self) -> tuple[np.ndarray, np.ndarray]:
        spread = np.hstack([np.broadcast_to(self.piece.start, (self.h, self.x)), self.size])
        return np.zeros((self.h, self.width, self.m)), spread[:, :, None] ** 2 * np.eye(self.width)

    def read(self, k: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(readings (h, y, states) with rows of zero where a sample is missing, which are there (y,), the data)."""
        along, data = self.piece.along, self.piece.data[k]
        seen = np.isfinite(data).all(axis=1)
        read = np.concatenate([np.broadcast_to(along.read[k], (self.h, *along.read[k].shape)), self.reads], axis=2)
        if along.feed.shape[2]:
            read[:, :, self.x] += along.feed[k][:, self.column].T * self.acts[:, None]
        for at, column in self.others:
            read[:, :, at] += along.feed[k][:, column]
        return read * seen[None, :, None], seen, np.where(seen[:, None], data, 0.0)

    def move(self, k: int) -> tuple[np.ndarray, np.ndarray]:
        """(matrices (h, states, states) to the next sample, what is added to the covariance)."""
        along = self.piece.along
        matrix = np.zeros((self.h, self.width, self.width))
        matrix[:, : self.x, : self.x] = along.step[k]
        if along.drive.shape[2]:
            matrix[:, : self.x, self.x] = along.drive[k][:, self.column].T * self.acts[:, None]
        for at, column in self.others:
            matrix[:, : self.x, at] = along.drive[k][:, column]
        keeps = np.exp(-(along.time[k + 1] - along.time[k]) / self.time)
        tail, added = np.arange(self.x, self.width), np.zeros_like(matrix)
        matrix[:, tail, tail] = keeps
        added[:, tail, tail] = self.size**2 * (1 - keeps**2)
        return matrix, added


class Whitener:
    """The filter of one hypothesis on one recording, with its gains: whitens any columns of outputs."""

    def __init__(self, piece: Piece, latent: Latent) -> None:
        chain = _Chain(piece, latent)
        self.seen = np.isfinite(piece.data).all(axis=2)
        self.logdet = 0.0
        self.steps: list[tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]] = []
        self.covers: list[np.ndarray] = []  # of states and effort before each sample is read
        self.at = chain.x  # where the effort is among the states
        self.others = chain.others
        _, cover = chain.begin()
        for k in range(chain.n):
            read, _, _ = chain.read(k)
            gain, whitener, logdet = _gain(cover, read, chain.noise)
            self.logdet += float(logdet[0])
            self.covers.append(cover[0])
            cover = _joseph(cover, gain, read, chain.noise)
            move, added = chain.move(k) if k < chain.n - 1 else (np.eye(chain.width)[None], 0.0)
            cover = move @ cover @ np.swapaxes(move, 1, 2) + added
            self.steps.append((read[0], whitener[0], gain[0], move[0]))

    def __call__(self, columns: np.ndarray) -> np.ndarray:
        """(rows, j): innovations of columns (n, y, j) in units of their standard deviations; rows of samples alone."""
        return self._filtered(columns)[0][self.seen]

    def innovations(self, readings: np.ndarray) -> np.ndarray:
        """(n, y) of readings (n, y), in units of their standard deviations; NaN where there is none."""
        return np.where(self.seen, self._filtered(readings[:, :, None])[0][:, :, 0], np.nan)

    def _filtered(self, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(innovations (n, y, j), states before each sample (n, states, j))."""
        state = np.zeros((len(self.steps[0][3]), columns.shape[2]))
        white, states = np.empty(columns.shape), np.empty((len(columns), *state.shape))
        for k, (read, whitener, gain, move) in enumerate(self.steps):
            states[k] = state
            innovation = np.where(self.seen[k][:, None], columns[k] - read @ state, 0.0)
            white[k] = whitener @ innovation
            state = move @ (state + gain @ innovation)
        return white, states

    def effort(self, readings: np.ndarray, at: int | None = None) -> tuple[np.ndarray, np.ndarray]:
        """(effort (n,), its standard deviation (n,)) from readings (n, y), backwards, no inverses (de Jong 1989); or
        another of the states, the one `at` a number."""
        at = self.at if at is None else at
        white, states = self._filtered(readings[:, :, None])
        pull, weight = np.zeros(len(self.covers[0])), np.zeros_like(self.covers[0])
        result = np.empty((len(states), 2))
        for k in reversed(range(len(states))):
            read, whitener, gain, move = self.steps[k]
            scaled = whitener @ read
            keep = move - move @ gain @ read
            pull = scaled.T @ white[k, :, 0] + keep.T @ pull
            weight = scaled.T @ scaled + keep.T @ weight @ keep
            row = self.covers[k][at]
            variance = row[at] - row @ weight @ row
            result[k] = states[k, at, 0] + row @ pull, np.sqrt(max(variance, 0.0))
        return result[:, 0], result[:, 1]


def course(piece: Piece, latent: Latent, mean: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(effort (n,), its standard deviation (n,)) of one hypothesis, the parameters at `mean` (in units of belief)."""
    left = piece.data[:, :, 0] + piece.data[:, :, 1:] @ mean
    return Whitener(piece, latent).effort(left)


def acting(piece: Piece, latent: Latent, mean: np.ndarray) -> list[tuple[int, np.ndarray]]:
    """(column, course (n,)) of every effort of one hypothesis: its own, and those beside it."""
    left, whitener = piece.data[:, :, 0] + piece.data[:, :, 1:] @ mean, Whitener(piece, latent)
    places = [(whitener.at, int(latent.column[0])), *whitener.others]
    return [(column, whitener.effort(left, at)[0]) for at, column in places]


def thinned(piece: Piece, every: int) -> Piece:
    """The same with one sample in `every`, efforts held in between; no more is lost than the readings left out."""
    if every <= 1:
        return piece
    along, n = piece.along, len(piece.along.time)
    kept = np.arange(0, n, every)
    steps, drives = [], []
    for begin, end in pairwise(kept):
        step, drive = along.step[begin], along.drive[begin]
        for k in range(begin + 1, end):
            step, drive = along.step[k] @ step, along.step[k] @ drive + along.drive[k]
        steps.append(step)
        drives.append(drive)
    (x, b), moves = along.drive.shape[1:], len(steps)
    thin = replace(
        along, time=along.time[kept], step=np.array(steps).reshape(moves, x, x),
        drive=np.array(drives).reshape(moves, x, b),
        read=along.read[kept], feed=along.feed[kept], direct=along.direct[kept],
    )  # fmt: skip
    return Piece(thin, piece.data[kept], piece.noise, piece.start)
