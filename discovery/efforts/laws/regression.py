"""Laws as regressions on the located effort: what each term would explain of the outputs along the guided run.

An effort that is a term's course answers linearly in the outputs; with the parameters in their beliefs that is one
weighted least-squares problem, solved for all terms at once. It is the regression of the effort with its full
covariance, since the outputs are all that is known of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lacuna.discovery.efforts.latent.chains import Latent, Piece
from lacuna.discovery.efforts.latent.smoother import Whitener
from lacuna.discovery.efforts.located import Guided, thinned_all
from lacuna.discovery.law.law import Law, Site
from lacuna.discovery.law.law_terms import Group

DISCREPANCIES = (0.3, 0.03)  # of the located effort's size, that a law may leave
NEAR = 5.0  # believed sigmas, within which parameters are looked for
FURTHER = 2.0  # times as far as beside an effort of any course, that a law may leave them; as that, where none else is
DEPENDENT = 1e-6  # share of a column that is left beside the others, below which it is none of its own


class Regression:
    """Answers of the outputs to terms at a place, along the guided run, in the metric of the located effort.

    What a law leaves is an effort at the same place of one of a few sizes (the discrepancy), so that a term counts by
    what it explains of the effort where the data tells it. Parameters in their beliefs are projected out.
    """

    def __init__(self, guided: Guided, place: Site, column: int) -> None:
        self.guided, self.place, self.column = guided, place, column
        self.thin = thinned_all(guided.pieces)
        self.every = -(-len(guided.pieces[0].along.time) // len(self.thin[0].along.time))
        self.groups: list[Group] = []
        self._picks: dict[tuple[str, ...], float] = {}
        self.metrics = [_Metric(self.thin, guided.latent, share) for share in DISCREPANCIES]
        self.rows = len(self.metrics[0].target)
        self.driven = np.abs(guided.mean)
        self.alone = np.zeros((len(self.metrics), 0))  # (metrics, groups) deviances of each group alone
        self._strains: dict[tuple[int, ...], float] = {}

    def add(self, groups: list[Group]) -> range:
        """Take groups in; their numbers."""
        answers = []
        for piece in self.guided.pieces:
            path = {v.local: v.course(piece.along.values) for v in self.place.variables} | {"time": piece.along.time}
            with np.errstate(all="ignore"):
                courses = np.column_stack([c for group in groups for c in group.values(path, self.place.sizes)])
            courses = np.nan_to_num(courses, nan=0.0, posinf=0.0, neginf=0.0)
            answers.append(piece.along.response(self.column, courses, every=self.every))
        for metric in self.metrics:
            metric.add(answers, [len(group.texts) for group in groups])
        begin = len(self.groups)
        self.groups += groups
        added = range(begin, len(self.groups))
        self.alone = np.hstack([self.alone, [metric.deviances((), added) for metric in self.metrics]])
        return added

    def _deviances(self, chosen: tuple[int, ...], others: Sequence[int]) -> np.ndarray:
        """(metrics, others) of the chosen groups with each of the others."""
        if not chosen:
            return self.alone[:, list(others)]
        return np.array([metric.deviances(chosen, others) for metric in self.metrics])

    def scores(self, chosen: tuple[int, ...], others: Sequence[int]) -> list[float]:
        """Deviance of the chosen groups with each of `others`, and their prices: ln(rows) for each number in them, and
        for having been picked among many."""
        base = sum(map(self._price, chosen))
        best = np.min(self._deviances(chosen, others), axis=0)
        return [float(d) + base + self._price(g) for d, g in zip(best, others, strict=True)]

    def _price(self, number: int) -> float:
        group = self.groups[number]
        if group.texts not in self._picks:
            self._picks[group.texts] = Law(self.place, (group,)).pick()
        return (len(group.texts) + len(group.shapes)) * float(np.log(self.rows)) + 2 * self._picks[group.texts]

    def coefficients(self, chosen: tuple[int, ...]) -> np.ndarray:
        return self._best_metric(chosen).coefficients(chosen)

    def explained(self, chosen: tuple[int, ...]) -> np.ndarray:
        """(rows,) what the groups explain, where a law may leave most."""
        metric = self.metrics[0]
        return np.column_stack([metric.columns[g] for g in chosen]) @ metric.coefficients(chosen)

    def _best_metric(self, chosen: tuple[int, ...]) -> _Metric:
        return self.metrics[int(np.argmin(self._deviances(chosen[:-1], chosen[-1:])))]

    def strain(self, chosen: tuple[int, ...]) -> float:
        """How far the parameters go from what is believed of them, in parts of how far they may. To first order
        anything can be had by parameters that no machine has: a term of the balance taken away whole, its inertia with
        it. Where an effort of any course at this place leaves them further off (what else is missing drives them), a
        law may as well."""
        if chosen not in self._strains:
            moved = np.abs(self._best_metric(chosen).parameters(chosen))
            self._strains[chosen] = float(np.max(moved / np.maximum(NEAR, FURTHER * self.driven), initial=0.0))
        return self._strains[chosen]


class _Metric:
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
        self.columns: list[np.ndarray] = []  # (rows, terms) of each group
        self.together: dict[range, np.ndarray] = {}  # (rows, terms) of groups that were added together
        self.grams: list[np.ndarray] = []  # (terms, terms), their products
        self.shares: list[np.ndarray] = []  # (parameters, terms): what the parameters' basis has of each

    def _beside(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(what is left beside the parameters, what their basis takes)."""
        count = self.basis.shape[1]
        share = self.basis[: len(rows)].T @ rows
        full = np.vstack([rows, np.zeros((count, rows.shape[1]))])
        full -= self.basis @ share
        return full, share

    def coefficients(self, chosen: tuple[int, ...]) -> np.ndarray:
        columns = np.column_stack([self.columns[g] for g in chosen])
        size = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
        return np.linalg.lstsq(columns / size, self.target, rcond=1e-9)[0] / size

    def parameters(self, chosen: tuple[int, ...]) -> np.ndarray:
        """Where the parameters go with these groups, in believed sigmas from what is believed."""
        taken = np.column_stack([self.shares[g] for g in chosen]) @ self.coefficients(chosen)
        return np.linalg.solve(self.triangle, self.target_share - taken)

    def add(self, answers: list[np.ndarray], terms: list[int]) -> None:
        columns, shares = self._beside(self.whitener(answers))
        self.together[range(len(self.columns), len(self.columns) + len(terms))] = columns
        at = 0
        for count in terms:
            own = columns[:, at : at + count]
            self.columns.append(own)
            self.grams.append(own.T @ own)
            self.shares.append(shares[:, at : at + count])
            at += count

    def deviances(self, chosen: tuple[int, ...], others: Sequence[int]) -> np.ndarray:
        """(len(others),) of the chosen groups with each of the others."""
        if not others:
            return np.zeros(0)
        target, basis = self.target, np.zeros((len(self.target), 0))
        if chosen:
            basis, _ = np.linalg.qr(np.column_stack([self.columns[g] for g in chosen]))
            target = target - basis @ (basis.T @ target)
        terms = self.together.get(others) if isinstance(others, range) else None
        terms = np.concatenate([self.columns[g] for g in others], axis=1) if terms is None else terms
        right, crossed = terms.T @ target, (basis.T @ terms).T
        counts = np.array([self.columns[g].shape[1] for g in others])
        first, taken = np.cumsum(counts) - counts, np.zeros(len(others))
        for count in np.unique(counts):
            alike = np.flatnonzero(counts == count)
            at = first[alike, None] + np.arange(count)
            taken[alike] = _taken(np.stack([self.grams[others[k]] for k in alike]), right[at], crossed[at])
        return float(target @ target) + self.logdet - taken


def _taken(gram: np.ndarray, right: np.ndarray, crossed: np.ndarray) -> np.ndarray:
    """Square sums (k,) that k blocks of j columns each take away beside a basis of c columns: from their products with
    themselves (k, j, j), with the target (k, j), and with the basis (k, j, c)."""
    rest = gram - crossed @ np.swapaxes(crossed, 1, 2)
    own = np.trace(rest, axis1=1, axis2=2) > DEPENDENT * np.trace(gram, axis1=1, axis2=2)  # not where one runs away
    rest, right = np.where(own[:, None, None], rest, np.eye(gram.shape[1])), np.where(own[:, None], right, 0.0)
    size = np.sqrt(np.maximum(np.diagonal(rest, axis1=1, axis2=2), 1e-300))
    inverse = np.linalg.pinv(rest / (size[:, :, None] * size[:, None]), rcond=1e-9, hermitian=True)
    right = right / size
    return np.sum(right * (inverse @ right[:, :, None])[:, :, 0], axis=1)
