"""The unknown effort at a place as a latent force: its evidence and its course, by a Kalman filter and smoother.

An effort f with a Gaussian-process prior of Matern type 1/2 (variance s^2, time constant l) drives the linear model; at
the samples it is f[k+1] = exp(-h/l) f[k] + noise, so that with the states it is one Markov chain (Hartikainen, Saerkkae
2011; Alvarez, Luengo, Lawrence 2009). The filter whitens the residual and the responses to the parameters with one and
the same gain (de Jong 1991), so that the parameters are integrated out exactly, over all recordings together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lacuna.discovery.efforts.latent.chains import Chains, Latent, Piece


class Whitener:
    """The filter of one hypothesis on some recordings, with its gains: whitens any columns of outputs."""

    def __init__(self, pieces: Sequence[Piece], latent: Latent) -> None:
        chains = Chains(pieces, latent)
        self.counts, self.seen = chains.counts, chains.seen
        self.at = chains.x  # where the effort is among the states
        self.others = chains.others
        self.read, self.move, added = chains.whole()
        cover = chains.spread[:, :, :1] ** 2 * np.eye(chains.w)
        found = []
        for read, move, more in zip(self.read, self.move, added, strict=True):
            gain, whitener, logdet = _gain(cover, read, chains.noise)
            found.append((whitener, gain, logdet, cover))
            cover = _joseph(cover, gain, read, chains.noise)
            cover = move @ cover @ np.swapaxes(move, 1, 2) + more
        # each (n, r, ...); the last are the covariances of states and effort before each sample is read
        self.whitener, self.gain, logdets, self.cover = (np.stack(parts) for parts in zip(*found, strict=True))
        self.logdet = float(logdets.sum())

    def __call__(self, columns: Sequence[np.ndarray]) -> np.ndarray:
        """(rows, j): innovations of columns (n, y, j) of each recording in units of their standard deviations; rows of
        samples alone."""
        white, _ = self._filtered(columns)
        return np.concatenate([white[: self.counts[k], k][self._seen(k)] for k in range(len(self.counts))])

    def innovations(self, readings: Sequence[np.ndarray]) -> list[np.ndarray]:
        """(n, y) of readings (n, y) of each recording, in units of their standard deviations; NaN where there is
        none."""
        white, _ = self._filtered([r[:, :, None] for r in readings])
        return [np.where(self._seen(k), white[:n, k, :, 0], np.nan) for k, n in enumerate(self.counts)]

    def _seen(self, k: int) -> np.ndarray:
        return self.seen[: self.counts[k], k]

    def _filtered(self, columns: Sequence[np.ndarray], states: bool = False) -> tuple[np.ndarray, np.ndarray]:
        """(innovations (n, r, y, j), states before each sample (n, r, w, j) if asked for)."""
        shape = (*self.seen.shape, columns[0].shape[2])
        white = np.zeros(shape)
        for k, part in enumerate(columns):
            white[: len(part), k] = np.where(self._seen(k)[:, :, None], part, 0.0)
        state = np.zeros((shape[1], self.cover.shape[2], shape[3]))
        kept = np.empty((shape[0] if states else 0, *state.shape))
        for k, (read, gain, move) in enumerate(zip(self.read, self.gain, self.move, strict=True)):
            if states:
                kept[k] = state
            white[k] -= read @ state  # nothing is read where a sample is missing
            state = move @ (state + gain @ white[k])
        return self.whitener @ white, kept

    def efforts(self, readings: Sequence[np.ndarray], places: Sequence[int]) -> list[list[np.ndarray]]:
        """[recording][place] -> (2, n): the states that are numbered by `places`, and their standard deviations, from
        readings (n, y) of each recording, backwards, no inverses (de Jong 1989)."""
        white, states = self._filtered([r[:, :, None] for r in readings], states=True)
        scaled = self.whitener @ self.read
        keep = self.move - self.move @ self.gain @ self.read
        pushed, heavy = np.swapaxes(scaled, 2, 3) @ white, np.swapaxes(scaled, 2, 3) @ scaled
        pull, weight = np.zeros_like(states), np.zeros_like(self.cover)
        pull[-1], weight[-1] = pushed[-1], heavy[-1]
        for k in reversed(range(len(keep) - 1)):
            back = np.swapaxes(keep[k], 1, 2)
            pull[k] = pushed[k] + back @ pull[k + 1]
            weight[k] = heavy[k] + back @ weight[k + 1] @ keep[k]
        found = []
        for at in places:
            row = self.cover[:, :, at, None]
            mean = states[:, :, at, 0] + (row @ pull)[:, :, 0, 0]
            variance = row[:, :, 0, at] - (row @ weight @ np.swapaxes(row, 2, 3))[:, :, 0, 0]
            found.append(np.stack([mean, np.sqrt(np.maximum(variance, 0.0))]))
        return [[each[:, :n, k] for each in found] for k, n in enumerate(self.counts)]


def _gain(cover: np.ndarray, read: np.ndarray, noise: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(gain, whitening matrix, log determinant); with readings in units of noise the last one is relative to it."""
    crossed = cover @ np.swapaxes(read, 1, 2)
    total = read @ crossed + noise[:, :, None] ** 2 * np.eye(noise.shape[1])
    lower = np.linalg.cholesky(total)
    whitener = np.linalg.inv(lower)
    gain = crossed @ np.swapaxes(whitener, 1, 2) @ whitener
    return gain, whitener, 2 * np.log(np.diagonal(lower, axis1=1, axis2=2) / noise)


def _joseph(cover: np.ndarray, gain: np.ndarray, read: np.ndarray, noise: np.ndarray) -> np.ndarray:
    left, scaled = np.eye(cover.shape[2]) - gain @ read, gain * noise[:, None]
    return left @ cover @ np.swapaxes(left, 1, 2) + scaled @ np.swapaxes(scaled, 1, 2)


def courses(pieces: Sequence[Piece], latent: Latent, mean: np.ndarray) -> list[np.ndarray]:
    """(2, n) on each recording: the effort of one hypothesis and its standard deviation, the parameters at `mean` (in
    units of belief)."""
    whitener = Whitener(pieces, latent)
    return [each for (each,) in whitener.efforts(_left(pieces, mean), [whitener.at])]


def acting(pieces: Sequence[Piece], latent: Latent, mean: np.ndarray) -> list[list[tuple[int, np.ndarray]]]:
    """(column, course (n,)) of every effort of one hypothesis on each recording: its own, and those beside it."""
    whitener = Whitener(pieces, latent)
    places = [(whitener.at, int(latent.column[0])), *whitener.others]
    found = whitener.efforts(_left(pieces, mean), [at for at, _ in places])
    columns = [column for _, column in places]
    return [[(column, each[0]) for column, each in zip(columns, efforts, strict=True)] for efforts in found]


def _left(pieces: Sequence[Piece], mean: np.ndarray) -> list[np.ndarray]:
    return [p.data[:, :, 0] + p.data[:, :, 1:] @ mean for p in pieces]


def thinned(piece: Piece, every: int) -> Piece:
    """The same with one sample in `every`, efforts held in between; no more is lost than the readings left out."""
    if every <= 1:
        return piece
    along, n = piece.along, len(piece.along.time)
    kept = np.arange(0, n, every)
    begins = kept[:-1]
    step, drive = along.step[begins], along.drive[begins]
    for k in range(1, every):
        step, drive = along.step[begins + k] @ step, along.step[begins + k] @ drive + along.drive[begins + k]
    thin = replace(
        along, time=along.time[kept], step=step, drive=drive, read=along.read[kept], feed=along.feed[kept],
        direct=along.direct[kept],
    )  # fmt: skip
    return Piece(thin, piece.data[kept], piece.noise, piece.start)
