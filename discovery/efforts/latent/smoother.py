"""The unknown effort at a place as a latent force: its evidence and its course, by a Kalman filter and smoother.

An effort f with a Gaussian-process prior of Matern type 1/2 (variance s^2, time constant l) drives the linear model; at
the samples it is f[k+1] = exp(-h/l) f[k] + noise, so that with the states it is one Markov chain (Hartikainen, Saerkkae
2011; Alvarez, Luengo, Lawrence 2009). The filter whitens the residual and the responses to the parameters with one and
the same gain (de Jong 1991), so that the parameters are integrated out exactly, over all recordings together. Outputs
are read one after the other, their noises being independent; the smoother goes back without inverses (de Jong 1989).
The arithmetic is in C++ (analysis/native/src/latent.cpp).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from lacuna.analysis.spectra.library import CLatentGains, library, pointer
from lacuna.discovery.efforts.latent.chains import Latent, Piece
from lacuna.discovery.efforts.latent.evidence import products
from lacuna.discovery.fit.solver.side_by_side import side_by_side


class Whitener:
    """The filter of one hypothesis on some recordings: whitens any columns of outputs. Raises LinAlgError where what an
    effort may do is beyond numbers."""

    def __init__(self, pieces: Sequence[Piece], latent: Latent) -> None:
        self.pieces, self.latent = pieces, latent
        self._gains = side_by_side(lambda piece: _Gains(piece, latent), pieces)

    def __call__(self, columns: Sequence[np.ndarray]) -> np.ndarray:
        """(rows, j): `innovations`, one recording after the other; rows of readings alone."""
        white = side_by_side(lambda p: p[0].whitened(p[1]), list(zip(self._gains, columns, strict=True)))
        return np.concatenate([part[p.seen] for p, part in zip(self.pieces, white, strict=True)])

    def innovations(self, columns: Sequence[np.ndarray]) -> list[np.ndarray]:
        """(n, y, j) of columns (n, y, j) on each recording, in units of their standard deviations; NaN where there is
        no reading."""
        white = [gains.whitened(part) for gains, part in zip(self._gains, columns, strict=True)]
        return [np.where(p.seen[:, :, None], part, np.nan) for p, part in zip(self.pieces, white, strict=True)]

    def transposed(self, rows: np.ndarray) -> list[np.ndarray]:
        """(n, y, j) on each recording: readings whose products with any others are those of whitened rows (rows, j)
        with those others whitened."""
        ends = np.cumsum([p.seen.sum() for p in self.pieces])
        parts = np.split(rows[: ends[-1]], ends[:-1])
        return side_by_side(lambda p: p[0].transposed(p[1]), list(zip(self._gains, parts, strict=True)))

    @property
    def logdet(self) -> float:
        """Logarithm of the determinant of the innovations' covariance, in units of the noise."""
        return float(products(self.pieces, self.latent)[1][0])


class _Gains:
    """What the filter does to every column of readings of one recording."""

    def __init__(self, piece: Piece, latent: Latent) -> None:
        forces, _forces = latent.of_library()
        samples, outputs, states = piece.along.read.shape
        self.seen, self.forces = np.ascontiguousarray(piece.seen), forces.forces
        self._model = piece.along.model(piece.noise, piece.start)
        row, gain = np.zeros((2, samples, outputs, states + self.forces))
        rest = (
            np.zeros((samples, outputs)),
            np.zeros((samples, states, self.forces)),
            np.zeros((samples, self.forces)),
        )
        self._kept = piece, (row, gain, *rest)  # what is borrowed of both lasts as long
        self._gains = CLatentGains(*map(pointer, self._kept[1]))
        _checked(library().lacuna_latent_filter(self._model, forces, self.seen.ctypes.data, self._gains))

    def whitened(self, columns: np.ndarray) -> np.ndarray:
        """(n, y, j) of columns (n, y, j); zero where there is no reading."""
        data = np.array(columns, dtype=float, order="C")
        self._run(library().lacuna_latent_whiten, data)
        return data

    def transposed(self, rows: np.ndarray) -> np.ndarray:
        """(n, y, j) of whitened rows (readings, j)."""
        data = np.zeros((*self.seen.shape, rows.shape[1]))
        data[self.seen] = rows
        self._run(library().lacuna_latent_whiten_transposed, data)
        return data

    def _run(self, function: Callable[..., None], data: np.ndarray) -> None:
        function(self._model, self._gains, self.forces, pointer(data), self.seen.ctypes.data, data.shape[2])


def courses(pieces: Sequence[Piece], latent: Latent, mean: np.ndarray) -> list[np.ndarray]:
    """(2, n) on each recording: the effort of one hypothesis and its standard deviation, the parameters at `mean` (in
    units of belief)."""
    return [np.stack([means[0], deviations[0]]) for means, deviations in _smoothed(pieces, latent, mean)]


def acting(pieces: Sequence[Piece], latent: Latent, mean: np.ndarray) -> list[list[tuple[int, np.ndarray]]]:
    """(column, course (n,)) of every effort of one hypothesis on each recording: its own, and those beside it."""
    beside = latent.colour.column if latent.colour is not None and latent.colour.column is not None else ()
    columns = [(k, int(c)) for k, c in enumerate((*latent.column[0], *beside)) if c >= 0]
    return [[(column, means[k]) for k, column in columns] for means, _ in _smoothed(pieces, latent, mean)]


def _smoothed(pieces: Sequence[Piece], latent: Latent, mean: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """On each recording the means (c, n) of efforts and errors of instruments, and their standard deviations."""
    forces, _forces = latent.of_library()

    def of_one(piece: Piece) -> tuple[np.ndarray, np.ndarray]:
        readings = np.ascontiguousarray(piece.data[:, :, 0] + piece.data[:, :, 1:] @ mean)
        seen = np.ascontiguousarray(piece.seen)
        means, deviations = np.empty((2, forces.forces, len(readings)))
        model = piece.along.model(piece.noise, piece.start)
        failed = library().lacuna_latent_smooth(
            model, forces, pointer(readings), seen.ctypes.data, pointer(means), pointer(deviations)
        )
        _checked(failed)
        return means, deviations

    return side_by_side(of_one, pieces)


def _checked(failed: int) -> None:
    if failed:
        raise np.linalg.LinAlgError("what an effort may do is beyond numbers")
