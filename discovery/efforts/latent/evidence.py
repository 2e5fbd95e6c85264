"""The evidence of an unknown effort: many hypotheses (place, size, time constant) side by side, in C++
(analysis/native/src/latent.cpp)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lacuna.analysis.spectra.library import library, pointer
from lacuna.discovery.efforts.latent.chains import Latent, Piece
from lacuna.discovery.fit.solver import time_limit
from lacuna.discovery.fit.solver.side_by_side import side_by_side


@dataclass
class Evidence:
    """Of each hypothesis: log evidence (natural, without the constant of the noise) and the parameters' estimate."""

    log: np.ndarray  # (h,)
    mean: np.ndarray  # (h, p) in units of belief
    information: np.ndarray  # (h, p, p) the belief included


def evidence(pieces: Sequence[Piece], latent: Latent) -> Evidence:
    """Log evidence with the parameters integrated out (beliefs are standard normal). Raises LinAlgError where what an
    effort may do is beyond numbers."""
    gram, logdet = products(pieces, latent)
    count = gram.shape[2]
    information = gram[:, 1:, 1:] + np.eye(count - 1)
    right = -gram[:, 1:, 0]
    mean = np.linalg.solve(information, right[:, :, None])[:, :, 0] if count > 1 else np.zeros((len(logdet), 0))
    square = gram[:, 0, 0] - np.sum(right * mean, axis=1)
    log = -0.5 * (square + logdet + np.linalg.slogdet(information)[1])
    return Evidence(log, mean, information)


def products(pieces: Sequence[Piece], latent: Latent) -> tuple[np.ndarray, np.ndarray]:
    """(products of the whitened columns (h, m, m), log determinant (h,) of the innovations), of all recordings. Those
    that act in as many columns go side by side."""
    columns = pieces[0].data.shape[2]
    gram, logdet = np.zeros((len(latent.size), columns, columns)), np.zeros(len(latent.size))
    for width in np.unique(latent.width):
        rows = np.flatnonzero(latent.width == width)
        gram[rows], logdet[rows] = _products(pieces, latent.of(rows), columns)
    return gram, logdet


def _products(pieces: Sequence[Piece], latent: Latent, columns: int) -> tuple[np.ndarray, np.ndarray]:
    forces, _forces = latent.of_library()

    def of_one(piece: Piece) -> tuple[np.ndarray, np.ndarray]:
        time_limit.check()
        gram, logdet = np.zeros((len(latent.size), columns, columns)), np.zeros(len(latent.size))
        model = piece.along.model(piece.noise, piece.start)
        data, seen = np.ascontiguousarray(piece.data), np.ascontiguousarray(piece.seen)
        if library().lacuna_latent_evidence(
            model, forces, pointer(data), seen.ctypes.data, columns, pointer(gram), pointer(logdet)
        ):
            raise np.linalg.LinAlgError("what an effort may do is beyond numbers")
        return gram, logdet

    grams, logdets = zip(*side_by_side(of_one, pieces), strict=True)
    return sum(grams), sum(logdets)
