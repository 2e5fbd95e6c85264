"""Laws as regressions on the located effort: what each term would explain of the outputs along the guided run.

An effort that is a term's course answers linearly in the outputs; with the parameters in their beliefs that is one
weighted least-squares problem, solved for all terms at once. It is the regression of the effort with its full
covariance, since the outputs are all that is known of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from operator import itemgetter

import numpy as np

from lacuna.discovery.efforts.guide import Guided
from lacuna.discovery.efforts.latent.chains import Piece
from lacuna.discovery.efforts.laws.beside import Beside
from lacuna.discovery.efforts.laws.metric import Bases, Kept, Metric, least_squares
from lacuna.discovery.fit.solver import time_limit
from lacuna.discovery.fit.solver.side_by_side import in_threads
from lacuna.discovery.law.law import Law, Site
from lacuna.discovery.law.terms.courses import Courses
from lacuna.discovery.law.terms.law_terms import Group

DISCREPANCIES = (0.3, 0.03)  # of the located effort's size, that a law may leave
NEAR = 5.0  # believed sigmas, within which parameters are looked for
FURTHER = 2.0  # times as far as beside an effort of any course, that a law may leave them; as that, where none else is
BLOCK = 128  # terms that are looked at together: many beside the work that a filter has of its own, little memory


class Regression:
    """Answers of the outputs to terms at a place, along the guided run, in the metric of the located effort; where the
    same law holds at every place of a family, those to all at once.

    What a law leaves is an effort at the same place of one of a few sizes (the discrepancy), so that a term counts by
    what it explains of the effort where the data tells it. Parameters in their beliefs are projected out.

    Of each group only products are kept. Its columns, one number for each sample of each output, are found again where
    they are wanted: thousands of groups would take gigabytes.
    """

    def __init__(self, guided: Guided, place: Site, columns: Sequence[int]) -> None:
        self.guided, self.place, self.columns = guided, place, tuple(columns)
        members = place.place.members
        of_all = [[v.of_member(members[0], member) for v in place.variables] for member in members]
        self.variables = of_all or [list(place.variables)]  # of each place where the law holds
        thin = guided.thin
        self.every = -(-len(guided.pieces[0].along.time) // len(thin[0].along.time))
        self.groups: list[Group] = []
        self._picks: dict[tuple[str, ...], float] = {}
        self.metrics = [Metric(thin, guided.latent, share) for share in DISCREPANCIES]
        self.rows = len(self.metrics[0].target)
        self._reach = np.maximum(NEAR, FURTHER * np.abs(guided.mean))  # of the parameters
        self.alone = np.zeros((len(self.metrics), 0))  # (metrics, groups) deviances of each group alone
        self._strains: dict[tuple[int, ...], float] = {}
        self._beside: list[Beside] = []  # pairs that were looked at
        self._kept: dict[int, list[np.ndarray]] = {}  # (rows, terms) in each metric, of the groups that were used last

    def add(self, groups: list[Group], wanted: bool = False) -> range:
        """Take groups in; their numbers. `wanted`: what is next asked of them takes their columns."""
        added = range(len(self.groups), len(self.groups) + len(groups))
        self.groups += groups
        blocks = self._blocks(added)
        for block, found in zip(blocks, in_threads(lambda b: self._regressed(b, wanted), blocks), strict=True):
            for metric, (kept, _) in zip(self.metrics, found, strict=True):
                metric.take(kept)
            if wanted:
                self._keep(block, [columns for _, columns in found])
        self.alone = np.hstack([self.alone, [metric.deviances_alone(added) for metric in self.metrics]])
        self._strain_ones([g for g in added if len(self.groups[g].texts) == 1])
        return added

    def _regressed(self, numbers: Sequence[int], wanted: bool) -> list[tuple[Kept, np.ndarray | None]]:
        """What is kept of groups in each metric, and their columns where they are wanted."""
        time_limit.check()
        answers, counts = self._answers(numbers), [len(self.groups[g].texts) for g in numbers]
        found = (metric.of(answers, counts) for metric in self.metrics)
        return [(kept, columns if wanted else None) for kept, columns in found]

    def _blocks(self, numbers: Sequence[int]) -> list[list[int]]:
        """Groups in blocks of so many terms."""
        first = np.cumsum([0, *(len(self.groups[g].texts) for g in numbers)])[:-1]
        parted = zip(first // BLOCK, numbers, strict=True)
        return [[g for _, g in block] for _, block in groupby(parted, key=itemgetter(0))]

    def _answers(self, numbers: Sequence[int]) -> list[np.ndarray]:
        """(n, y, terms) of the outputs on each recording."""
        return [
            sum(p.along.response(column, self._courses(numbers, p, k), every=self.every)
                for k, column in enumerate(self.columns))
            for p in self.guided.pieces
        ]  # fmt: skip

    def _courses(self, numbers: Sequence[int], piece: Piece, member: int) -> np.ndarray:
        """(n, terms) along a recording, at one of the places where the law holds."""
        path = {v.local: v.course(piece.along.values) for v in self.variables[member]} | {"time": piece.along.time}
        with np.errstate(all="ignore"):
            along = Courses(path, self.place.sizes)
            courses = np.column_stack([c for g in numbers for c in self.groups[g].values(along)])
        courses[~np.isfinite(courses)] = 0.0
        return courses

    def _keep(self, numbers: Sequence[int], found: Sequence[np.ndarray]) -> None:
        """Columns of a block, for the next that want them, in place of those used longest ago."""
        at = 0
        for g in numbers:
            count = len(self.groups[g].texts)
            self._kept[g] = [columns[:, at : at + count].copy() for columns in found]
            at += count
        held = sum(len(self.groups[g].texts) for g in self._kept)
        for g in list(self._kept):
            if held <= 2 * BLOCK or g in numbers:
                break
            held -= len(self.groups[g].texts)
            del self._kept[g]

    def forget(self) -> None:
        """Keep no columns: no more is asked for the time being."""
        self._kept.clear()
        self._beside.clear()

    def _columns(self, numbers: Sequence[int]) -> list[np.ndarray]:
        """(rows, terms) of some groups, of no more than a block's terms, in each metric."""
        self._kept |= {g: self._kept.pop(g) for g in dict.fromkeys(numbers) if g in self._kept}  # now used last
        for block in self._blocks([g for g in dict.fromkeys(numbers) if g not in self._kept]):
            answers = self._answers(block)
            self._keep(block, [metric.beside_parameters(answers)[0] for metric in self.metrics])
        return [np.column_stack([self._kept[g][k] for g in numbers]) for k in range(len(self.metrics))]

    def _deviances(self, several: Sequence[tuple[int, ...]], others: Sequence[int]) -> np.ndarray:
        """(several, metrics, others) of each of several choices of groups with each of the others."""
        if not any(several):
            return np.repeat(self.alone[None, :, list(others)], len(several), axis=0)
        chosen = [self._columns(groups) for groups in several]
        bases = [metric.bases([c[k] for c in chosen]) for k, metric in enumerate(self.metrics)]
        blocks = self._blocks(others)
        if len(blocks) > 1:
            products = self._products(bases, blocks)
        else:
            products = [b.whole.T @ columns for b, columns in zip(bases, self._columns(others), strict=True)]
        self._beside.append(Beside(self.metrics, several, others, bases, products))
        return self._beside[-1].deviances

    def _products(self, bases: list[Bases], blocks: list[list[int]]) -> list[np.ndarray]:
        """(all, terms) in each metric: products of bases with the columns of groups, which are not found for that:
        those of courses are the same with what the bases are to courses, by the transposes of filter and response."""
        turned = [[m.transposed(b, self.guided.pieces, column, self.every) for column in self.columns]
                  for m, b in zip(self.metrics, bases, strict=True)]  # fmt: skip

        def of_block(block: list[int]) -> list[np.ndarray]:
            courses = [[self._courses(block, p, n) for p in self.guided.pieces] for n in range(len(self.columns))]
            found = []
            for k, metric in enumerate(self.metrics):
                own = (pair for t, c in zip(turned[k], courses, strict=True) for pair in zip(t, c, strict=True))
                whole = sum(t.T @ c for t, c in own)
                shares = np.column_stack([metric.shares[g] for g in block])
                found.append(whole - (metric.basis.T @ bases[k].whole).T @ shares)
            return found

        return [np.concatenate(parts, axis=1) for parts in zip(*in_threads(of_block, blocks), strict=True)]

    def scores(self, chosen: tuple[int, ...], others: Sequence[int]) -> list[float]:
        """Deviance of the chosen groups with each of `others`, and their prices: ln(rows) for each number in them, and
        for having been picked among many."""
        return self.scores_of([chosen], others)[0]

    def scores_of(self, several: Sequence[tuple[int, ...]], others: Sequence[int]) -> list[list[float]]:
        """The same of several choices of groups, whose products with the others are found all at once."""
        best = np.min(self._deviances(several, others), axis=1) if others else np.zeros((len(several), 0))
        prices = np.array([self._price(g) for g in others])
        return [(d + sum(map(self._price, chosen)) + prices).tolist() for chosen, d in zip(several, best, strict=True)]

    def _price(self, number: int) -> float:
        group = self.groups[number]
        if group.texts not in self._picks:
            self._picks[group.texts] = Law(self.place, (group,)).pick()
        return (len(group.texts) + len(group.shapes)) * float(np.log(self.rows)) + 2 * self._picks[group.texts]

    def coefficients(self, chosen: tuple[int, ...]) -> np.ndarray:
        return self._from_columns(chosen)[1]

    def explained(self, chosen: tuple[int, ...]) -> np.ndarray:
        """(rows,) what the groups explain, where a law may leave most."""
        return self._columns(chosen)[0] @ self._solved(0, chosen)

    def _solved(self, k: int, chosen: tuple[int, ...]) -> np.ndarray:
        """Coefficients in a metric; of one group from what is kept of it."""
        metric = self.metrics[k]
        if len(chosen) == 1:
            return least_squares(metric.triangles[chosen[0]], metric.onto[chosen[0]])
        return least_squares(self._columns(chosen)[k], metric.target)

    def strain(self, chosen: tuple[int, ...]) -> float:
        """How far the parameters go from what is believed of them, in parts of how far they may. To first order
        anything can be had by parameters that no machine has: a term of the balance taken away whole, its inertia with
        it. Where an effort of any course at this place leaves them further off (what else is missing drives them), a
        law may as well."""
        if chosen not in self._strains:
            k, found = self._among_pairs(chosen) or self._from_columns(chosen)
            moved = self.metrics[k].parameters(chosen, found)
            self._strains[chosen] = float(np.max(np.abs(moved) / self._reach, initial=0.0))
        return self._strains[chosen]

    def _strain_ones(self, numbers: Sequence[int]) -> None:
        """The same of groups of one term, all at once: of thousands one in each kind is asked for."""
        least = np.argmin(self.alone[:, list(numbers)], axis=0)
        for k, metric in enumerate(self.metrics):
            own = [g for g, best in zip(numbers, least, strict=True) if best == k]
            strains = np.max(np.abs(metric.parameters_of_ones(own)) / self._reach[:, None], axis=0, initial=0.0)
            self._strains |= {(g,): float(strain) for g, strain in zip(own, strains, strict=True)}

    def _from_columns(self, chosen: tuple[int, ...]) -> tuple[int, np.ndarray]:
        """(metric in which the groups leave least, their coefficients there)."""
        k = int(np.argmin(self._deviances([chosen[:-1]], chosen[-1:])))
        return k, self._solved(k, chosen)

    def _among_pairs(self, chosen: tuple[int, ...]) -> tuple[int, np.ndarray] | None:
        """The same of two groups, where one was looked at beside the other."""
        first, last = chosen[:-1], chosen[-1]
        for beside in self._beside if len(chosen) == 2 else ():
            if beside.holds(first, last):
                k, own, other = beside.solution(first, last)
                return k, np.concatenate([own, other])
            if beside.holds((last,), first[0]):
                k, own, other = beside.solution((last,), first[0])
                return k, np.concatenate([other, own])
        return None
