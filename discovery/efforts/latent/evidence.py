"""The evidence of an unknown effort: many hypotheses (place, size, time constant) in one Kalman filter.

Outputs are read one after the other, their noises being independent: each is a number, with no matrix to invert.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lacuna.discovery.efforts.latent.chains import Chains, Latent, Piece


@dataclass
class Evidence:
    """Of each hypothesis: log evidence (natural, without the constant of the noise) and the parameters' estimate."""

    log: np.ndarray  # (h,)
    mean: np.ndarray  # (h, p) in units of belief
    information: np.ndarray  # (h, p, p) the belief included


def evidence(pieces: Sequence[Piece], latent: Latent) -> Evidence:
    """Log evidence with the parameters integrated out (beliefs are standard normal)."""
    gram, logdet = _filtered(Chains(pieces, latent))
    count = gram.shape[2]
    information = gram[:, 1:, 1:] + np.eye(count - 1)
    right = -gram[:, 1:, 0]
    mean = np.linalg.solve(information, right[:, :, None])[:, :, 0] if count > 1 else np.zeros((len(logdet), 0))
    square = gram[:, 0, 0] - np.sum(right * mean, axis=1)
    log = -0.5 * (square + logdet + np.linalg.slogdet(information)[1])
    return Evidence(log, mean, information)


def _filtered(chains: Chains, most: int = 1 << 20) -> tuple[np.ndarray, np.ndarray]:
    """(gram (h, m, m) of the whitened columns, log determinant (h,) of the innovations), of all recordings; of the
    whitened columns no more than about `most` numbers are held."""
    columns, tail = chains.data.shape[3], np.arange(chains.x, chains.w)
    gram, logdet = np.zeros((chains.h, columns, columns)), np.zeros(chains.h)
    state = np.zeros((chains.r, chains.w, columns, chains.h))
    cover = chains.spread[:, :, None] ** 2 * np.eye(chains.w)[:, :, None]
    white: list[np.ndarray] = []
    for k in range(chains.n):
        for output in np.flatnonzero(chains.seen[k].any(axis=0)):
            state, cover, innovation, variance = _read(chains, k, int(output), state, cover)
            white.append(innovation / np.sqrt(variance)[:, None])
            logdet += np.sum(np.log(variance / chains.noise[:, output, None] ** 2), axis=0)
        if len(white) * state[:, 0].size > most or k == chains.n - 1:
            gram, white = gram + _gram(white, gram), []
        state, cover = chains.moved(k, state), chains.moved(k, cover)
        cover = chains.moved(k, np.ascontiguousarray(np.swapaxes(cover, 1, 2)))
        cover[:, tail, tail] += chains.added[k]
    return gram, logdet


def _read(
    chains: Chains, k: int, output: int, state: np.ndarray, cover: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """(states, covariance after an output of sample k is read, innovations (r, m, h), their variance (r, h)): Joseph's
    form, in which what rounding has left of the gain's share is taken out again."""
    seen, power = chains.seen[k, :, output, None], chains.noise[:, output, None] ** 2
    near, far = chains.read[k, :, output] * seen, chains.far(k, output)
    far = far if seen.all() else far * seen[:, :, None]

    def reading(what: np.ndarray) -> np.ndarray:
        """(r, j, h) of (r, w, j, h)."""
        states = what[:, : chains.x].reshape(chains.r, chains.x, -1)
        own = (near[:, None] @ states).reshape(chains.r, *what.shape[2:])
        return own + np.sum(far[:, :, None] * what[:, chains.x :], axis=1)

    crossed = reading(cover)
    variance = reading(crossed[:, :, None])[:, 0] + power
    if not np.all(variance > 0):
        raise np.linalg.LinAlgError("what an effort may do is beyond numbers")
    innovation = chains.data[k, :, output, :, None] - reading(state)
    gain = crossed / variance[:, None]
    state = state + gain[:, :, None] * innovation[:, None]
    cover = cover - crossed[:, :, None] * gain[:, None]
    missed = power[:, None] * gain - reading(cover)
    return state, cover + gain[:, :, None] * missed[:, None], innovation, variance


def _gram(white: list[np.ndarray], like: np.ndarray) -> np.ndarray:
    """(h, m, m) of whitened columns, each (r, m, h)."""
    if not white:
        return np.zeros_like(like)
    rows = np.concatenate(white)
    return rows.transpose(2, 1, 0) @ rows.transpose(2, 0, 1)
