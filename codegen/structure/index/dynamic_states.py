"""Dynamic choice of states: where none is good for a whole run, a discrete matrix P selects them and events change it.

S. Mattsson, H. Olsson, H. Elmqvist, Dynamic selection of states in Dymola, Modelica Workshop 2000, 61-67. A group is a
set of constraints G(q) q' = ... whose n candidates q leave m degrees of freedom. The candidates all become algebraic;
the states are s = P q with one 1 in each row of P, and der(s) = P der(q) belongs to the equations as they are. So the
one set of equations is right for each choice, and P is no more than m n discrete variables.

How good a choice is tells the tangent w = dq/ds, the solution of P w = 1, G w = 0, in units in which the candidates are
of size 1. Where an entry of w is larger than 1, the candidate of that row is the better state: to exchange it enlarges
the determinant of the constraints' pivots by that factor (D. Knuth, Semi-optimal bases for linear dependencies, Linear
and Multilinear Algebra 17 (1985) 1-4). The event is where the mean square of the entries reaches 2^2, and exchanges
entries of at least sqrt(2) until it is below: each exchange makes the determinant larger, so they end, and in between
no pivot is further from the best than a factor that the numbers of rows and columns bound.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce

from lacuna.codegen import flat
from lacuna.codegen.structure.aliases import STATE_SELECT
from lacuna.codegen.structure.index.pivots import base_of, text_of
from lacuna.codegen.structure.system import Row, Switch
from lacuna.codegen.symbolic.differentiate import partial
from lacuna.codegen.symbolic.expr import BOOLEAN, ONE, ZERO, Expr, add, const, der, div, mul, node, pre, relation, var

BOUND = 4.0  # mean square of the entries of dq/ds at which states are chosen anew
EXCHANGE = 2.0  # square of the smallest entry that is exchanged: well above 1, so that no exchange is taken back
PREFERENCE = 10.0  # how much larger a pivot stateSelect puts up with: prefer and avoid, beside default


@dataclass
class Group:
    """Constraints that determine all but `len(selected)` of the derivatives `free` (and all of `others`)."""

    rows: list[Row]
    free: list[Expr]  # derivatives of those that may be states
    others: list[Expr]  # derivatives that never are states
    selected: list[Expr]  # of `free`, those of the states at the start


class Selection:
    """The variables, rows, guard and algorithm of one group; `sizes` gives the nominal value of a candidate."""

    def __init__(self, number: int, group: Group, model: flat.FlatModel, sizes: dict[Expr, Expr]):
        self.group, self._number = group, number
        self._span, self._origin = group.rows[0].source.span, group.rows[0].source.origin
        self._candidates = [d.args[0] for d in group.free]
        self._sizes = [sizes[d.args[0]] for d in group.free]
        self._scales = {d: mul(sizes[d.args[0]], const(_weight(model, d))) for d in (*group.free, *group.others)}
        self.states = [f"$state{number}[{i + 1}]" for i in range(len(group.selected))]
        self.variables: dict[str, flat.Variable] = {}
        for name, d in zip(self.states, group.selected, strict=True):
            self._declare(name, f"the state of this group, at the start {text_of(d.args[0])} by its size")
        self._tangents = [
            {d: self._new(f"$slope{number}[{k + 1},{i + 1}]") for k, d in enumerate(self._scales)}
            for i in range(len(self.states))
        ]
        self._matrix = [
            [self._entry(i, j, d is chosen) for j, d in enumerate(group.free)]
            for i, chosen in enumerate(group.selected)
        ]

    # -- variables --------------------------------------------------------------------------------------------

    def _declare(self, name: str, description: str, **more: object) -> None:
        self.variables[name] = flat.Variable(name, self._span, nominal=ONE, description=description, **more)

    def _new(self, name: str) -> Expr:
        self._declare(name, "slope of a candidate by a state, both by their sizes")
        return var(name)

    def _entry(self, i: int, j: int, selected: bool) -> Expr:
        name = f"$selects{self._number}[{i + 1},{j + 1}]"
        self._declare(
            name, f"1 where {text_of(self._candidates[j])} is the state", variability=flat.DISCRETE,
            start=const(float(selected)),
        )  # fmt: skip
        return var(name)

    # -- equations --------------------------------------------------------------------------------------------

    def rows(self) -> list[Row]:
        """States, their derivatives, and the tangent; by the choice before an event, until the states are set for the
        new one."""
        found = []
        matrix = [[pre(p) for p in line] for line in self._matrix]
        for i, (name, chosen) in enumerate(zip(self.states, matrix, strict=True)):
            shares = [div(q, size) for q, size in zip(self._candidates, self._sizes, strict=True)]
            found.append(self._row(var(name), _product(chosen, shares)))
            rates = [div(d, size) for d, size in zip(self.group.free, self._sizes, strict=True)]
            found.append(self._row(der(var(name)), _product(chosen, rates)))
            slopes = self._tangents[i]
            for k, line in enumerate(matrix):
                along = _product(line, [slopes[d] for d in self.group.free])
                found.append(self._row(along, const(float(k == i))))
            for row in self.group.rows:
                used = [d for d in self._scales if d in row.leaves]
                terms = [mul(mul(partial(row.residual, d), self._scales[d]), slopes[d]) for d in used]
                found.append(self._row(reduce(add, terms), ZERO))
        return found

    def _row(self, lhs: Expr, rhs: Expr) -> Row:
        source = self.group.rows[-1].source
        text = f"choice of states for  {source.text}"
        return Row(lhs, rhs, flat.Equation(lhs, rhs, source.span, source.origin, text))

    # -- events -----------------------------------------------------------------------------------------------

    def _entries(self) -> list[tuple[int, int, Expr]]:
        return [(i, j, self._tangents[i][d]) for i in range(len(self.states)) for j, d in enumerate(self.group.free)]

    def switch(self) -> Switch:
        """True where the choice has become a bad one. The states' own entries are ones."""
        m, k = len(self.states), len(self._candidates) - len(self.states)
        squares = reduce(add, [mul(w, w) for _, _, w in self._entries()])
        source = self.group.rows[-1].source
        names = ", ".join(map(text_of, self._candidates))
        return Switch(squares, const(m + BOUND * m * k), source, f"another choice of states among {names}")

    def algorithm(self, number: int) -> flat.Algorithm:
        """Where relation `number` holds, exchange the first state for which there is a better candidate."""
        exchanges = [(relation(">=", mul(w, w), const(EXCHANGE)), self._exchange(i, j)) for i, j, w in self._entries()]
        bad = node("rel", (), number, BOOLEAN)
        choose = flat.If([(bad, [flat.If(exchanges, self._span)])], self._span)
        targets = tuple(str(p.value) for line in self._matrix for p in line)
        return flat.Algorithm([choose], targets, self._span, self._origin)

    def _exchange(self, i: int, j: int) -> list[flat.Statement]:
        chosen = [flat.Assign(str(p.value), const(float(k == j)), self._span) for k, p in enumerate(self._matrix[i])]
        value = div(self._candidates[j], self._sizes[j])
        return [*chosen, flat.Reinit(self.states[i], value, self._span)]


def _weight(model: flat.FlatModel, derivative: Expr) -> float:
    """A candidate that is rather a state counts for smaller: its slope is, and slopes by it are larger."""
    level = STATE_SELECT.index(model.variables[str(base_of(derivative).value)].state_select) - STATE_SELECT.index(
        "default"
    )
    return PREFERENCE ** -max(-1, min(1, level))


def _product(line: Sequence[Expr], values: Sequence[Expr]) -> Expr:
    return reduce(add, [mul(p, v) for p, v in zip(line, values, strict=True)])
