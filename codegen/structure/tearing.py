"""Tearing: assign what one equation gives explicitly; where none does, assume the most used unknown as known.

H. Elmqvist, M. Otter, Methods for tearing systems of equations in object-oriented modeling, ESM 1994.
An equation is used for an unknown only where it is affine in it with a coefficient that is safely not zero.

In the residual form derivatives are known, but only as differences of the integrator: what is computed from them
must not go into a nonlinear function (the exponential of a diode, say), which would amplify their error.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

from lacuna.codegen.structure.system import DeclaredValues, Row
from lacuna.codegen.symbolic.affine import UNSAFE, division_rank, isolate
from lacuna.codegen.symbolic.differentiate import partial
from lacuna.codegen.symbolic.expr import Expr, div

AMPLIFICATION = 1e5


@dataclass(eq=False)
class Assignment:
    """unknown = value, from `row`."""

    unknown: Expr
    value: Expr
    row: Row


@dataclass
class Torn:
    """`assignments` in order, given `tears`; `residuals` are the equations left over for the tears."""

    assignments: list[Assignment] = field(default_factory=list)
    tears: list[Expr] = field(default_factory=list)
    residuals: list[Row] = field(default_factory=list)


class Tearing:
    def __init__(self, values: DeclaredValues):
        self._values = values
        self._explicit: dict[tuple[Row, Expr], tuple[int, Expr | None]] = {}
        self._linear: dict[tuple[Row, Expr], bool] = {}

    def explicit(self, row: Row, unknown: Expr) -> tuple[int, Expr | None]:
        """(rank, value) of `unknown` from `row`; rank UNSAFE and None where it may not be used."""
        key = (row, unknown)
        if key not in self._explicit:
            parts = isolate(row.lhs, row.rhs, unknown)
            rank = division_rank(parts[1], self._values.parametric) if parts else UNSAFE
            self._explicit[key] = (rank, div(*parts) if rank < UNSAFE else None)
        return self._explicit[key]

    def _is_linear(self, row: Row, unknown: Expr) -> bool:
        key = (row, unknown)
        if key not in self._linear:
            self._linear[key] = isolate(row.lhs, row.rhs, unknown) is not None
        return self._linear[key]

    def tear(
        self, rows: Sequence[Row], unknowns: Sequence[Expr], rough: Iterable[Expr] = (), given: Sequence[Expr] = ()
    ) -> Torn:
        """Order `rows` for `unknowns`, of which `given` are tears from the start; every leaf that is not among them is
        known, `rough` leaves only roughly."""
        position = {u: k for k, u in enumerate(unknowns)}
        missing = {row: {u for u in row.leaves if u in position} for row in rows}
        users: dict[Expr, list[Row]] = {u: [] for u in unknowns}
        for row in rows:
            for u in missing[row]:
                users[u].append(row)
        number = {row: k for k, row in enumerate(rows)}
        torn = Torn()
        ready = [row for row in rows if len(missing[row]) <= 1]

        def settle(unknown: Expr) -> None:
            del users_left[unknown]
            for row in users[unknown]:
                missing[row].discard(unknown)
                if row in unused and len(missing[row]) == 1:
                    ready.append(row)

        users_left, unused, rough = dict(users), dict.fromkeys(rows), set(rough)

        def spoils(row: Row, unknown: Expr) -> bool:
            """Whether `row` would carry rough values through `unknown` into a nonlinear equation."""
            others = (other for other in users[unknown] if other in unused and other is not row)
            return not rough.isdisjoint(row.leaves) and not all(self._is_linear(other, unknown) for other in others)

        for unknown in given:
            torn.tears.append(unknown)
            settle(unknown)
        while users_left:
            choice = self._best(ready, missing, unused, number, spoils)
            if choice is None:
                unknown = min(users_left, key=lambda u: (-sum(r in unused for r in users[u]), position[u]))
                torn.tears.append(unknown)
            else:
                row, unknown, value = choice
                torn.assignments.append(Assignment(unknown, value, row))
                del unused[row]
                if not rough.isdisjoint(row.leaves):
                    rough.add(unknown)
            settle(unknown)
        torn.residuals = list(unused)
        return torn

    def amplifies(self, torn: Torn, known: Iterable[Expr] = ()) -> bool:
        """Whether the chain of assignments blows up rounding of the tears or of `known` leaves.

        A long chain may do so without bound, as the recursion along a ladder of resistors does; then a block is better
        solved whole. Only quantities of one unit are compared; slopes are those at the declared values.
        """
        return any(self._largest_slope(torn, leaf) > AMPLIFICATION for leaf in (*torn.tears, *known))

    def _largest_slope(self, torn: Torn, leaf: Expr) -> float:
        slopes, largest = {leaf: 1.0}, 0.0
        for step in torn.assignments:
            used = [n for n in slopes if n in step.row.leaves and n is not step.unknown]
            parts = [(self._values(partial(step.value, n)), slopes[n]) for n in used]
            if used:
                slopes[step.unknown] = sum(own * before for own, before in parts if own is not None)
                if step.unknown.op == leaf.op and self._values.unit(step.unknown) == self._values.unit(leaf):
                    largest = max(largest, abs(slopes[step.unknown]))
        return largest

    def _best(
        self,
        ready: list[Row],
        missing: dict[Row, set[Expr]],
        unused: dict[Row, None],
        number: dict[Row, int],
        spoils: Callable[[Row, Expr], bool],
    ) -> tuple[Row, Expr, Expr] | None:
        """The explicit equation to use next: constants before parameters as divisors, short before long."""
        ready[:] = [row for row in ready if row in unused and len(missing[row]) == 1]
        found = []
        for row in ready:
            (unknown,) = missing[row]
            rank, value = self.explicit(row, unknown)
            if value is not None and not spoils(row, unknown):
                found.append(((rank, any(n.op == "der" for n in row.leaves), number[row]), row, unknown, value))
        return min(found, key=lambda f: f[0])[1:] if found else None
