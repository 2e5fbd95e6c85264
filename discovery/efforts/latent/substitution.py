"""Linear equations solved at many samples at once, block by block in the order in which unknowns can be found.

Equations of a model are sparse: most unknowns follow from one equation once others are known, and answer to few of the
columns on the right. What stands in no equation is exactly zero then, whatever the units.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lacuna.codegen.structure.sorting.blocks import strong_components
from lacuna.codegen.structure.sorting.matching import Matching
from lacuna.codegen.symbolic.expr import Expr
from lacuna.discovery.efforts.latent.numeric import NotNumeric

ROUNDING = 1e-9  # of the terms of a sum that cancels: far above what double precision leaves, far below any answer


@dataclass(frozen=True)
class Answer:
    """Of an unknown: the columns (k,) of the right-hand side that it answers to, ascending, and how (k, samples)."""

    columns: np.ndarray
    values: np.ndarray


class Substitution:
    """Square equations M u + R = 0, a row of M as {unknown: coefficient}. Raises NotNumeric where equations cannot be
    assigned to the unknowns."""

    def __init__(self, matrix: Sequence[Mapping[int, Expr]]) -> None:
        self._matrix = matrix
        matching = Matching([list(row) for row in matrix], len(matrix))
        if matching.match_all():
            raise NotNumeric("its equations cannot be assigned to its unknowns")
        needs = [[matching.row_of[c] for c in row] for row in matrix]
        self._blocks = [(rows, [matching.column_of[r] for r in rows]) for rows in strong_components(needs)]

    def solve(
        self, course: Callable[[Expr], np.ndarray], right: Sequence[Mapping[int, np.ndarray]], samples: int,
        exact: range = range(0),
    ) -> list[Answer]:  # fmt: skip
        """The answer of each unknown. `course` gives a coefficient (samples,), a row of `right` what stands in a column
        (samples,). In `exact` columns a sum whose terms cancel but for their rounding is zero: an effort that does
        nothing there, as what is pushed into an ideal source. Raises LinAlgError where M is singular."""
        found: dict[int, Answer] = {}
        for rows, unknowns in self._blocks:
            parts = [list(self._terms(r, course, right[r], found)) for r in rows]
            columns = np.unique([c for own in parts for c, _ in own]).astype(int)
            low, high = np.searchsorted(columns, [exact.start, exact.stop])
            total, size = np.zeros((len(rows), len(columns), samples)), np.zeros((len(rows), high - low, samples))
            for own, sums, sizes in zip(parts, total, size, strict=True):
                for column, term in own:
                    k = np.searchsorted(columns, column)
                    sums[k] += term
                    if low <= k < high:
                        sizes[k - low] += np.abs(term)
            pivots = [[self._coefficient(r, u, course, samples) for u in unknowns] for r in rows]
            values, least = _solved(np.array(pivots), total, size)
            values[:, low:high][np.abs(values[:, low:high]) <= ROUNDING * least] = 0.0
            for u, own in zip(unknowns, values, strict=True):
                some = np.any(own != 0, axis=1)
                found[u] = Answer(columns[some], own[some])
        return [found[u] for u in range(len(self._matrix))]

    def _terms(
        self, row: int, course: Callable[[Expr], np.ndarray], right: Mapping[int, np.ndarray],
        found: Mapping[int, Answer],
    ) -> Iterator[tuple[int, np.ndarray]]:  # fmt: skip
        """(column, term (samples,)) of a row, what is known of other unknowns put in."""
        yield from right.items()
        for u, e in self._matrix[row].items():
            if u in found and len(found[u].columns):
                yield from zip(found[u].columns, course(e) * found[u].values, strict=True)

    def _coefficient(
        self, row: int, unknown: int, course: Callable[[Expr], np.ndarray], samples: int
    ) -> np.ndarray:  # fmt: skip
        e = self._matrix[row].get(unknown)
        return np.zeros(samples) if e is None else course(e)


def _solved(pivots: np.ndarray, total: np.ndarray, size: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(unknowns, columns, samples) of a block's (m, m, samples) equations, and what its terms come to if none of them
    cancels."""
    if len(pivots) == 1:
        if not np.all(pivots):
            raise np.linalg.LinAlgError("Singular matrix")
        return -total / pivots, size / np.abs(pivots)
    matrix = pivots.transpose(2, 0, 1)
    values = -np.linalg.solve(matrix, total.transpose(2, 0, 1))
    least = np.abs(np.linalg.inv(matrix)) @ size.transpose(2, 0, 1) if size.size else size.transpose(2, 0, 1)
    return values.transpose(1, 2, 0), least.transpose(1, 2, 0)
