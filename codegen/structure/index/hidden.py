"""Constraints that only numbers show: currents into a part of a circuit that is joined to the rest by nothing else.

The equations of the nodes of such a part, added up, say that the currents into it are zero together; if these flow
through inductances they are states, and one of them follows from the others. Structure alone does not show it, as each
node has currents of its own, which cancel. The same holds of voltages in a loop without a ground.

Among equations whose coefficients are whole numbers, elimination of what is not differentiated leaves such a constraint
in place of one of the equations that it is made of, and index reduction goes on from there.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction
from typing import TypeVar

from lacuna.codegen.structure.system import Row
from lacuna.codegen.symbolic.expr import ZERO, Expr, add, const, is_const, mul, sub

Coefficients = dict[Expr, Fraction]
K = TypeVar("K")
WORK = 20  # times the coefficients that there are at first: trees need one, nets that need more are left as they are


def expose(rows: list[Row], names: Iterable[str]) -> list[Row]:
    """`rows`, with a constraint in place of one row for each that they hide."""
    states = {n.args[0] for row in rows for n in row.leaves if n.op == "der"}
    known = set(names)
    whole = {k: c for k, row in enumerate(rows) if (c := _coefficients(row, known)) and not states.issuperset(c)}
    exposed = list(rows)
    for made_of, constraint in _Elimination(whole, states).constraints():
        unknowns = {n for k in made_of for n in whole[k] if n not in states}
        if len(made_of) <= len(unknowns):  # else structure shows it
            last = made_of[-1]
            exposed[last] = replace(rows[last], lhs=_sum(constraint), rhs=ZERO)
    return exposed


def _coefficients(row: Row, names: set[str]) -> Coefficients | None:
    """Of a row that is a sum of variables times whole numbers."""
    if any(n.op != "var" or str(n.value) not in names for n in row.leaves):
        return None
    found: Coefficients = defaultdict(Fraction)
    if not (_collect(row.lhs, Fraction(1), found) and _collect(row.rhs, Fraction(-1), found)):
        return None
    return {n: c for n, c in found.items() if c}


def _collect(e: Expr, factor: Fraction, found: Coefficients) -> bool:
    if e.op == "var":
        found[e] += factor
        return True
    if e.op in ("+", "-", "neg"):
        signs = (-factor,) if e.op == "neg" else (factor, factor if e.op == "+" else -factor)
        return all(_collect(a, s, found) for a, s in zip(e.args, signs, strict=True))
    if e.op == "*" and is_const(e.args[0]) and float(e.args[0].value).is_integer():
        return _collect(e.args[1], factor * int(e.args[0].value), found)
    return is_const(e) and e.value == 0


class _Elimination:
    """Sparse, over fractions; each row remembers which rows it is made of."""

    def __init__(self, rows: dict[int, Coefficients], states: set[Expr]):
        self._rows = {k: dict(row) for k, row in rows.items()}
        self._parts: dict[int, dict[int, Fraction]] = {k: {k: Fraction(1)} for k in rows}
        self._states = states
        self._users: dict[Expr, set[int]] = defaultdict(set)
        for k, row in rows.items():
            for n in row:
                if n not in states:
                    self._users[n].add(k)
        self._work = WORK * sum(map(len, rows.values()))

    def constraints(self) -> list[tuple[list[int], Coefficients]]:
        """(rows that it is made of, coefficients of the states) of each."""
        self._peel(self._users)
        found = []
        while self._rows and self._work > 0:
            k = min(self._rows, key=lambda k: len(self._rows[k]))
            row = self._rows[k]
            unknowns = [n for n in row if n not in self._states]
            if not unknowns:
                if row and len(self._parts[k]) > 1:
                    found.append((sorted(self._parts[k]), row))
                self._drop(k)
                continue
            self._eliminate(k, min(unknowns, key=lambda n: len(self._users[n])))
        return found

    def _peel(self, unknowns: Iterable[Expr]) -> None:
        """Rows that alone have an unknown say nothing about others."""
        waiting = [n for n in unknowns if len(self._users[n]) == 1]
        while waiting:
            users = self._users[waiting.pop()]
            if len(users) == 1:
                waiting += self._drop(next(iter(users)))

    def _drop(self, k: int) -> list[Expr]:
        """Take a row out; unknowns that one row is left with."""
        unknowns = [n for n in self._rows.pop(k) if n not in self._states]
        for n in unknowns:
            self._users[n].discard(k)
        return [n for n in unknowns if len(self._users[n]) == 1]

    def _eliminate(self, k: int, unknown: Expr) -> None:
        pivot, parts = self._rows[k], self._parts[k]
        for other in sorted(self._users[unknown] - {k}):
            factor = self._rows[other][unknown] / pivot[unknown]
            _add(self._rows[other], pivot, -factor)
            _add(self._parts[other], parts, -factor)
            for n in pivot:
                if n not in self._states:
                    (self._users[n].add if n in self._rows[other] else self._users[n].discard)(other)
            self._work -= len(pivot) + len(parts)
        self._peel(self._drop(k))


def _add(to: dict[K, Fraction], what: dict[K, Fraction], factor: Fraction) -> None:
    for n, c in what.items():
        total = to.get(n, Fraction(0)) + factor * c
        if total:
            to[n] = total
        else:
            to.pop(n, None)


def _sum(coefficients: Coefficients) -> Expr:
    total = ZERO
    for n, c in coefficients.items():
        total = add(total, n) if c == 1 else sub(total, n) if c == -1 else add(total, mul(const(float(c)), n))
    return total
