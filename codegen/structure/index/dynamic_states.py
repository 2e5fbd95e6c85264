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

from collections.abc import Iterable
from functools import reduce

from lacuna.codegen import flat
from lacuna.codegen.structure.aliases import STATE_SELECT
from lacuna.codegen.structure.index.pivots import base_of, text_of
from lacuna.codegen.structure.index.tangents import Group, Tangent, product
from lacuna.codegen.structure.system import Row, Switch
from lacuna.codegen.symbolic.expr import (
    BOOLEAN,
    FALSE,
    Expr,
    add,
    const,
    der,
    div,
    logical_and,
    mul,
    node,
    pre,
    relation,
    sub,
    var,
)
from lacuna.codegen.symbolic.rewrite import Rewriter

BOUND = 4.0  # mean square of the entries of dq/ds at which states are chosen anew
EXCHANGE = 2.0  # square of the smallest entry that is exchanged: well above 1, so that no exchange is taken back
PREFERENCE = 10.0  # how much larger a pivot stateSelect puts up with: prefer and avoid, beside default


class Selection(Tangent):
    """The variables, rows, guard and algorithm of one group; `sizes` gives the nominal value of a candidate."""

    def __init__(self, number: int, group: Group, model: flat.FlatModel, sizes: dict[Expr, Expr]):
        self._weights = {d: const(_weight(model, d)) for d in (*group.free, *group.others)}
        super().__init__(number, group, {d: mul(sizes[d.args[0]], w) for d, w in self._weights.items()})
        self._candidates = [d.args[0] for d in group.free]
        self._sizes = [sizes[d.args[0]] for d in group.free]
        self.states = [f"$state{number}[{i + 1}]" for i in range(len(group.selected))]
        for name, d in zip(self.states, group.selected, strict=True):
            self.declare(name, f"the state of this group, at the start {text_of(d.args[0])} by its size")
        self._matrix = [
            [self._entry(i, j, d is chosen) for j, d in enumerate(group.free)]
            for i, chosen in enumerate(group.selected)
        ]

        self._late = self._delay() if group.reset else None

    def _delay(self) -> Expr:
        """The choice is made a pass after it has become bad, where a reinit may set the same state in that pass."""
        name = f"$late{self.number}"
        self.variables[name] = flat.Variable(
            name, self.span, type=BOOLEAN, variability=flat.DISCRETE, start=FALSE,
            description="true where another choice is made in the next pass",
        )  # fmt: skip
        return var(name, BOOLEAN)

    def _entry(self, i: int, j: int, selected: bool) -> Expr:
        name, text = f"$selects{self.number}[{i + 1},{j + 1}]", text_of(self._candidates[j])
        start = const(float(selected))
        return self.declare(name, f"1 where {text} is the state", variability=flat.DISCRETE, start=start)

    # -- equations --------------------------------------------------------------------------------------------

    def rows(self) -> list[Row]:
        """States, their derivatives, and the tangent; by the choice before an event, until the states are set for the
        new one."""
        found = []
        matrix = [[pre(p) for p in line] for line in self._matrix]
        for i, (name, chosen) in enumerate(zip(self.states, matrix, strict=True)):
            shares = [div(q, size) for q, size in zip(self._candidates, self._sizes, strict=True)]
            found.append(self.row(var(name), product(chosen, shares)))
            rates = [div(d, size) for d, size in zip(self.group.free, self._sizes, strict=True)]
            found.append(self.row(der(var(name)), product(chosen, rates)))
            found += self.along(i, matrix)
        return found

    # -- events -----------------------------------------------------------------------------------------------

    def _entries(self) -> list[tuple[int, int, Expr]]:
        return [(i, j, self.slopes[i][d]) for i in range(len(self.states)) for j, d in enumerate(self.group.free)]

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
        targets = [str(p.value) for line in self._matrix for p in line]
        body: list[flat.Statement] = [flat.If([(bad, [flat.If(exchanges, self.span)])], self.span)]
        if self._late:
            body = [
                flat.If([(logical_and(bad, pre(self._late)), [flat.If(exchanges, self.span)])], self.span),
                flat.Assign(str(self._late.value), bad, self.span),
            ]
            targets.append(str(self._late.value))
        return flat.Algorithm(body, tuple(targets), self.span, self.origin)

    def set_by(self, s: flat.Reinit) -> flat.Reinit:
        """reinit of a candidate that need not be the state: along the tangent, which is a straight line for what the
        constraints hold linearly."""
        d = self.group.reset
        assert d is not None
        weight = product([pre(p) for p in self._matrix[0]], [self._weights[k] for k in self.group.free])
        slope = div(mul(self.scales[d], self.slopes[0][d]), weight)
        state = var(self.states[0])
        return flat.Reinit(self.states[0], add(state, div(sub(s.value, d.args[0]), slope)), s.span)

    def _exchange(self, i: int, j: int) -> list[flat.Statement]:
        chosen = [flat.Assign(str(p.value), const(float(k == j)), self.span) for k, p in enumerate(self._matrix[i])]
        value = div(self._candidates[j], self._sizes[j])
        return [*chosen, flat.Reinit(self.states[i], value, self.span)]


class Resets(Rewriter):
    """A model with the reinits of what may not be the state as those of what is; `selections` by the target."""

    def __init__(self, selections: Iterable[Selection]):
        super().__init__(lambda e: None)
        self._by_target = {s.group.reset.args[0]: s for s in selections if s.group.reset}

    def _assign(self, s: flat.Assign | flat.Reinit) -> flat.Statement:
        selection = self._by_target.get(var(s.target)) if isinstance(s, flat.Reinit) else None
        return selection.set_by(s) if selection and isinstance(s, flat.Reinit) else s


def _weight(model: flat.FlatModel, derivative: Expr) -> float:
    """A candidate that is rather a state counts for smaller: its slope is, and slopes by it are larger."""
    level = STATE_SELECT.index(model.variables[str(base_of(derivative).value)].state_select) - STATE_SELECT.index(
        "default"
    )
    return PREFERENCE ** -max(-1, min(1, level))
