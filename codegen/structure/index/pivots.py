"""Which candidate each constraint determines: Gaussian elimination of the constraints' Jacobian at the start values."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
import heapq

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.aliases import STATE_SELECT
from lacuna.codegen.structure.constants import is_parametric
from lacuna.codegen.structure.system import DeclaredValues, GenericValues, Row
from lacuna.codegen.symbolic.differentiate import partial
from lacuna.codegen.symbolic.expr import Expr

PIVOT = 1e-6  # smallest pivot accepted, relative to the largest entry of its equation
ROUNDING = 1e-10  # of the largest number that entered a sum: at generic values what is smaller is a zero


@dataclass
class Entry:
    value: float
    varies: bool  # with the states; else with parameters only
    summed: float = 0.0  # the largest number that entered the value


@dataclass
class Pivot:
    column: Expr
    varies: bool


class Elimination:
    """Rows by the candidates they hold; `strength(candidate)`, which begins with whether a
    reinit sets it and its stateSelect, sorts those first that are to be determined."""

    def __init__(
        self,
        model: flat.FlatModel,
        rows: Sequence[Row],
        candidates: Sequence[Expr],
        values: DeclaredValues,
        strength: Callable[[Expr], tuple],
    ):
        self._model, self._rows, self._candidates, self._values = model, rows, candidates, values
        column = {v: k for k, v in enumerate(candidates)}
        self._matrix = [{column[n]: self._entry(row, n) for n in row.leaves if n in column} for row in rows]
        for line in self._matrix:
            scale = max((abs(e.value) for e in line.values()), default=0.0) or 1.0
            for e in line.values():
                e.value /= scale
                e.summed = abs(e.value)
        self._users: list[set[int]] = [set() for _ in candidates]
        for r, line in enumerate(self._matrix):
            for c in line:
                self._users[c].add(r)
        self._strength = [strength(v) for v in candidates]
        self._taken: list[tuple[int, int, float]] = []  # row, column and value of each pivot, in turn

    def _entry(self, row: Row, v: Expr) -> Entry:
        slope = partial(row.residual, v)
        value = self._values(slope)
        return Entry(1.0 if value is None else float(value), not is_parametric(slope, self._model.variables))

    def _is_pivot(self, e: Entry) -> bool:
        return abs(e.value) > (ROUNDING * e.summed if isinstance(self._values, GenericValues) else PIVOT)

    def run(self, steady_first: bool = False) -> dict[Row, Pivot]:
        """For each row one of the candidates, with a regular Jacobian at the start values. `steady_first`: pivots that
        no state can make singular before others, unless they would determine what is rather to be a state."""

        def key(r: int, c: int) -> tuple:
            """Sorts first: the weakest candidate, of those the largest pivot, of those the last declared."""
            reset, select = self._strength[c][:2]
            wanted = reset or select > STATE_SELECT.index("default")
            late = steady_first and (self._matrix[r][c].varies or wanted)
            return late, self._strength[c], -abs(self._matrix[r][c].value), -c, r

        matrix, chosen = self._matrix, {}
        queue = [key(r, c) for r, line in enumerate(matrix) for c, e in line.items() if self._is_pivot(e)]
        heapq.heapify(queue)
        while queue:
            found = heapq.heappop(queue)
            c, r = -found[-2], found[-1]
            if self._rows[r] in chosen or c not in matrix[r] or key(r, c) != found:
                continue  # eliminated, or another number by now
            pivot = matrix[r].pop(c)
            chosen[self._rows[r]] = Pivot(self._candidates[c], pivot.varies)
            self._taken.append((r, c, pivot.value))
            for other in sorted(o for o in self._users[c] if self._rows[o] not in chosen):
                for k in self._subtract(r, pivot, other, c):
                    heapq.heappush(queue, key(other, k))
        if len(chosen) < len(self._rows):
            self._refuse()
        return chosen

    def slopes(self) -> dict[Expr, dict[Expr, float]]:
        """After `run`, of each candidate that is determined by those that are not, at the start values."""
        found: dict[Expr, dict[Expr, float]] = {}
        for r, c, pivot in reversed(self._taken):
            own = found[self._candidates[c]] = {}
            for k, e in self._matrix[r].items():
                of = self._candidates[k]
                for state, slope in found.get(of, {of: 1.0}).items():
                    own[state] = own.get(state, 0.0) - e.value / pivot * slope
        return found

    def _subtract(self, r: int, pivot: Entry, other: int, c: int) -> list[int]:
        """Take row r from another one, so that it is free of column c; the columns that may be pivots there now."""
        line, changed = self._matrix[other], []
        head = line.pop(c)
        for k, a in self._matrix[r].items():
            before = line.get(k, Entry(0.0, False))
            varies = before.varies or head.varies or pivot.varies or a.varies
            share = head.value / pivot.value * a.value
            line[k] = Entry(before.value - share, varies, max(before.summed, abs(share)))
            self._users[k].add(other)
            if self._is_pivot(line[k]):
                changed.append(k)
        return changed

    def _refuse(self) -> None:
        raise Diagnostic(
            "S005", "these constraints between states do not determine any of them at the start values",
            self._rows[0].source.span, "give start values at which the constraint is regular: "
            + ", ".join(text_of(c.args[0]) for c in self._candidates),
            [(row.source.span, row.text) for row in self._rows],
        )  # fmt: skip


def text_of(n: Expr) -> str:
    return f"der({text_of(n.args[0])})" if n.op == "der" else str(n.value)


def base_of(n: Expr) -> Expr:
    """The variable that a derivative of any order is of."""
    while n.op == "der":
        n = n.args[0]
    return n
