"""The least squares of a regression: columns whitened for what a law leaves, beside parameters in their beliefs.

Of each group of columns only its triangle is kept, and the target in the basis that goes with it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lacuna.discovery.efforts.latent.chains import Latent, Piece
from lacuna.discovery.efforts.latent.smoother import Whitener

DEPENDENT = 1e-6  # share of a column that is left beside the others, below which it is none of its own


@dataclass
class Bases:
    """Of several choices of groups, side by side: an orthonormal basis of each, and what it leaves of the target."""

    whole: np.ndarray  # (rows, all)
    sizes: list[int]  # of the bases
    triangles: list[np.ndarray]  # (size, terms) that each is multiplied by


@dataclass
class Kept:
    """Of each group."""

    triangles: list[np.ndarray]  # (terms, terms): its columns are a basis times this
    onto: list[np.ndarray]  # (terms,) the target in that basis
    shares: list[np.ndarray]  # (parameters, terms): what the parameters' basis has of each


class Metric:
    """The regression with what a law leaves as an effort of `share` of the size of the one that was located."""

    def __init__(self, pieces: list[Piece], located: Latent, share: float) -> None:
        latent = replace(located, size=share * located.size)
        self.whitener = Whitener(pieces, latent)
        self.logdet = self.whitener.logdet
        rows = self.whitener([p.data for p in pieces])
        count = rows.shape[1] - 1
        self.basis, self.triangle = np.linalg.qr(np.vstack([-rows[:, 1:], np.eye(count)]))
        target, share = self._beside(rows[:, :1])
        self.target, self.target_share = target[:, 0], share[:, 0]
        self.triangles: list[np.ndarray] = []  # of each group, as `Kept` says
        self.onto: list[np.ndarray] = []
        self.shares: list[np.ndarray] = []

    def _beside(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(what is left beside the parameters, what their basis takes)."""
        share = self.basis[: len(rows)].T @ rows
        full = self.basis @ -share
        full[: len(rows)] += rows
        return full, share

    def beside_parameters(self, answers: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
        """(columns (rows, terms), shares (parameters, terms)) of answers on each recording."""
        return self._beside(self.whitener(answers))

    def parameters(self, chosen: tuple[int, ...], coefficients: np.ndarray) -> np.ndarray:
        """Where the parameters go with these groups, in believed sigmas from what is believed."""
        taken = np.column_stack([self.shares[g] for g in chosen]) @ coefficients
        return np.linalg.solve(self.triangle, self.target_share - taken)

    def parameters_of_ones(self, numbers: Sequence[int]) -> np.ndarray:
        """(parameters, numbers) where they go with each of some groups of one term by itself."""
        if not numbers:
            return np.zeros((len(self.target_share), 0))
        size, onto = (np.array([kept[g].item() for g in numbers]) for kept in (self.triangles, self.onto))
        found = np.divide(onto, size, out=np.zeros_like(onto), where=size > 0)
        taken = np.column_stack([self.shares[g] for g in numbers]) * found
        return np.linalg.solve(self.triangle, self.target_share[:, None] - taken)

    def of(self, answers: list[np.ndarray], terms: list[int]) -> tuple[Kept, np.ndarray]:
        """What is kept of groups of so many terms each, and their columns."""
        columns, shares = self.beside_parameters(answers)
        kept = [(np.zeros((0, 0)), np.zeros(0))] * len(terms)
        for alike, at in _of_one_size(np.array(terms)):
            for k, *found in zip(alike, *_triangular(columns[:, at], self.target), strict=True):
                kept[k] = tuple(found)
        triangles, onto = map(list, zip(*kept, strict=True))
        return Kept(triangles, onto, np.split(shares, np.cumsum(terms)[:-1], axis=1)), columns

    def take(self, kept: Kept) -> None:
        """Take groups in."""
        self.triangles += kept.triangles
        self.onto += kept.onto
        self.shares += kept.shares

    def bases(self, chosen: list[np.ndarray]) -> Bases:
        """Bases of several choices of columns."""
        bases, triangles = zip(*map(np.linalg.qr, chosen), strict=True)
        left = [self.target - basis @ (basis.T @ self.target) for basis in bases]
        whole = np.column_stack([x for pair in zip(bases, left, strict=True) for x in pair])
        return Bases(whole, [basis.shape[1] for basis in bases], list(triangles))

    def transposed(self, bases: Bases, pieces: list[Piece], column: int, every: int) -> list[np.ndarray]:
        """(n, all) on each recording: courses whose products with others are those of bases with what those do."""
        readings = self.whitener.transposed(bases.whole)
        return [p.along.response_transposed(column, r, every) for p, r in zip(pieces, readings, strict=True)]

    def deviances_alone(self, numbers: Sequence[int]) -> np.ndarray:
        """(numbers,) of each group."""
        right = [self.triangles[g].T @ self.onto[g] for g in numbers]
        terms = sum(map(len, right))
        whole = np.concatenate(right) if right else np.zeros(0)
        return float(self.target @ self.target) - self._taken_by(numbers, whole, np.zeros((terms, 0))) + self.logdet

    def deviances(self, bases: Bases, others: Sequence[int], products: np.ndarray) -> np.ndarray:
        """(choices, others) of each choice with each of the others, whose products with the bases are (all, terms)."""
        found, at = [], 0
        for size in bases.sizes:
            left, own = bases.whole[:, at + size], products[at : at + size + 1]
            taken = self._taken_by(others, own[size], own[:size].T)
            found.append(float(left @ left) + self.logdet - taken)
            at += size + 1
        return np.array(found)

    def together(self, bases: Bases, n: int, other: int, products: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(coefficients of choice n, of another group), whose products with the bases are (all, terms): none of the
        other where it is no direction of its own."""
        size, at = bases.sizes[n], sum(bases.sizes[:n]) + n
        crossed, right, gram = products[at : at + size], products[at + size], self.triangles[other]
        gram = gram.T @ gram
        rest = gram - crossed.T @ crossed
        scale = np.sqrt(np.maximum(np.diagonal(gram), 1e-300))
        own = np.trace(rest) > DEPENDENT * np.trace(gram)
        found = np.linalg.lstsq(rest / np.outer(scale, scale), right / scale, rcond=1e-9)[0] / scale
        found = found if own else np.zeros(len(right))
        onto = bases.whole[:, at : at + size].T @ self.target
        return least_squares(bases.triangles[n], onto - crossed @ found), found

    def _taken_by(self, numbers: Sequence[int], right: np.ndarray, crossed: np.ndarray) -> np.ndarray:
        """Square sums that groups take away beside a basis, from their products with the target and with that basis."""
        taken = np.zeros(len(numbers))
        for alike, at in _of_one_size(np.array([len(self.onto[g]) for g in numbers], dtype=int)):
            triangles = np.stack([self.triangles[numbers[k]] for k in alike])
            taken[alike] = _taken(np.swapaxes(triangles, 1, 2) @ triangles, right[at], crossed[at])
        return taken


def _of_one_size(counts: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """(which blocks (k,), their places (k, j)) of those of j places each, for every j there is."""
    first = np.cumsum(counts) - counts
    for count in np.unique(counts):
        alike = np.flatnonzero(counts == count)
        yield alike, first[alike, None] + np.arange(count)


def _triangular(columns: np.ndarray, target: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of k groups of j columns (rows, k, j) the triangles (k, j, j) that an orthonormal basis of each is multiplied by,
    and the target in that basis (k, j): by the modified Gram-Schmidt process, which is as exact as reflections where
    the target goes through it, too (A. Bjoerck, BIT 7, 1967)."""
    _, groups, count = columns.shape
    triangles, onto = np.zeros((groups, count, count)), np.zeros((groups, count))
    left = [columns[:, :, j] for j in range(count)] + [np.broadcast_to(target[:, None], columns.shape[:2])]
    for j in range(count):
        triangles[:, j, j] = size = np.sqrt(np.einsum("rk,rk->k", left[j], left[j]))
        unit = left[j] / np.maximum(size, 1e-300)
        for other in range(j + 1, count + 1):
            share = np.einsum("rk,rk->k", unit, left[other])
            if other < count:
                triangles[:, j, other] = share
            else:
                onto[:, j] = share
            if j + 1 < count:
                left[other] = left[other] - unit * share
    return triangles, onto


def least_squares(columns: np.ndarray, target: np.ndarray) -> np.ndarray:
    size = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
    return np.linalg.lstsq(columns / size, target, rcond=1e-9)[0] / size


def _taken(gram: np.ndarray, right: np.ndarray, crossed: np.ndarray) -> np.ndarray:
    """Square sums (k,) that k blocks of j columns each take away beside a basis of c columns: from their products with
    themselves (k, j, j), with the target (k, j), and with the basis (k, j, c)."""
    rest = gram - crossed @ np.swapaxes(crossed, 1, 2)
    own = np.trace(rest, axis1=1, axis2=2) > DEPENDENT * np.trace(gram, axis1=1, axis2=2)  # not where one runs away
    rest, right = np.where(own[:, None, None], rest, np.eye(gram.shape[1])), np.where(own[:, None], right, 0.0)
    least = DEPENDENT**2 * np.diagonal(gram, axis1=1, axis2=2) + 1e-300
    size = np.sqrt(np.maximum(np.diagonal(rest, axis1=1, axis2=2), least))
    inverse = np.linalg.pinv(rest / (size[:, :, None] * size[:, None]), rcond=1e-9, hermitian=True)
    right = right / size
    return np.sum(right * (inverse @ right[:, :, None])[:, :, 0], axis=1)
