"""Tearing: assign what one equation gives explicitly; where none does, assume the most used unknown as known.

H. Elmqvist, M. Otter, Methods for tearing systems of equations in object-oriented modeling, ESM 1994.
An equation is used for an unknown only where it is affine in it with a coefficient that is safely not zero.

In the residual form derivatives are known, but only as differences of the integrator: what is computed from them
must not go into a nonlinear function (the exponential of a diode, say), which would amplify their error. Nor must what
an exponential gives go into another one: of that no machine number holds the values nearby, and Newton's method crawls.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
import heapq
import itertools

from lacuna.codegen.structure.reach import Reach, Users, users_of
from lacuna.codegen.structure.system import DeclaredValues, Row
from lacuna.codegen.symbolic.affine import UNSAFE, division_rank, isolate, nonlinear
from lacuna.codegen.symbolic.differentiate import partial
from lacuna.codegen.symbolic.expr import FALSE, TRUE, Expr, div, substitute, walk
from lacuna.codegen.symbolic.leaves import leaves

AMPLIFICATION = 1e5  # of rounding, 1e-16, tolerated along a chain: it stays far below the tolerances of a run
MODES = 4  # conditions of one slope whose combinations are all looked at


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
    """`switching`: whether divisors may differ from mode to mode."""

    def __init__(self, values: DeclaredValues, switching: bool = True):
        self._values, self._switching = values, switching
        self._explicit: dict[tuple[Row, Expr], tuple[int, Expr | None]] = {}
        self._steepest: dict[Expr, float | None] = {}
        self._exponents: dict[Row, frozenset[Expr]] = {}

    def explicit(self, row: Row, unknown: Expr) -> tuple[int, Expr | None]:
        """(rank, value) of `unknown` from `row`; rank UNSAFE and None where it may not be used."""
        key = (row, unknown)
        if key not in self._explicit:
            parts = isolate(row.lhs, row.rhs, unknown)
            usable = parts is not None and (self._switching or all(n.op != "if" for n in walk(parts[1])))
            rank = division_rank(parts[1], self._values.parametric) if usable else UNSAFE
            self._explicit[key] = (rank, div(*parts) if rank < UNSAFE else None)
        return self._explicit[key]

    @cached_property
    def steady(self) -> Tearing:
        """The same without divisors that differ from mode to mode."""
        return Tearing(self._values, switching=False)

    def exponents(self, row: Row) -> frozenset[Expr]:
        """What stands under an exponential in `row`."""
        if row not in self._exponents:
            under = [leaves(e) for n in (*walk(row.lhs), *walk(row.rhs)) if (e := _exponent(n)) is not None]
            self._exponents[row] = frozenset().union(*under)
        return self._exponents[row]

    def is_linear(self, row: Row, unknown: Expr) -> bool:
        return unknown not in nonlinear(row.lhs) and unknown not in nonlinear(row.rhs)

    def tear(
        self,
        rows: Sequence[Row],
        unknowns: Sequence[Expr],
        rough: Iterable[Expr] = (),
        given: Sequence[Expr] = (),
        values_first: bool = False,
    ) -> Torn:
        """Order `rows` for `unknowns`, of which `given` are tears from the start; every leaf that is not among them is
        known, `rough` leaves only roughly. `values_first`: rows without derivatives before rows without divisions."""
        return _Order(self, rows, unknowns, rough, values_first).run(given)

    def tear_at_guesses(self, rows: Sequence[Row], unknowns: Sequence[Expr]) -> Torn:
        """As `tear`, for an iteration: what has a guess becomes a tear before what has none, for an iteration
        begins at the values of its tears, and a guess for anything else would go unheard."""
        return _Order(self, rows, unknowns, guessed=frozenset(u for u in unknowns if self._values.guess(u))).run(())

    def amplifies(self, torn: Torn, known: Iterable[Expr] = ()) -> bool:
        """Whether the chain of assignments blows up rounding of the tears or of `known` leaves.

        A long chain may do so without bound, as the recursion along a ladder of resistors does; then a block is better
        solved whole. Only quantities of one unit are compared; slopes are those at the declared values.
        """
        users = users_of(step.row.leaves for step in torn.assignments)
        place = {step.unknown: k for k, step in enumerate(torn.assignments)}
        own = cache(lambda k, n: self._in_worst_mode(partial(torn.assignments[k].value, n)))
        return any(self._largest_slope(torn, leaf, users, place, own) > AMPLIFICATION for leaf in (*torn.tears, *known))

    def _in_worst_mode(self, slope: Expr) -> float | None:
        """The value of largest size that `slope` has over the modes of its conditions."""
        if slope not in self._steepest:
            conditions = list(dict.fromkeys(n.args[0] for n in walk(slope) if n.op == "if"))[:MODES]
            modes = itertools.product((FALSE, TRUE), repeat=len(conditions))
            found = [self._values(substitute(slope, dict(zip(conditions, m, strict=True)))) for m in modes]
            self._steepest[slope] = max((v for v in found if v is not None), key=abs, default=None)
        return self._steepest[slope]

    def _largest_slope(
        self, torn: Torn, leaf: Expr, users: Users, place: dict[Expr, int], own: Callable[[int, Expr], float | None]
    ) -> float:
        slopes, largest = {leaf: 1.0}, 0.0
        reach = Reach(users, [leaf])
        for k in reach:
            step = torn.assignments[k]
            few, many = sorted((slopes, step.row.leaves), key=len)
            used = sorted((n for n in few if n in many and n is not step.unknown), key=lambda n: place.get(n, -1))
            parts = [(own(k, n), slopes[n]) for n in used]
            slopes[step.unknown] = sum(slope * before for slope, before in parts if slope is not None)
            reach.add(step.unknown)
            if step.unknown.op == leaf.op and self._values.unit(step.unknown) == self._values.unit(leaf):
                largest = max(largest, abs(slopes[step.unknown]))
        return largest


def _exponent(n: Expr) -> Expr | None:
    """What is in the exponent of a node, where there is any."""
    if n.op == "call" and n.value in ("exp", "sinh", "cosh"):
        return n.args[0]
    return n.args[1] if n.op == "^" and n.args[1].op != "const" else None


class _Order:
    """One run of tearing. Two heaps hold what may come next, so that a step costs what its row and unknown hold:
    rows with one unknown left, constants before parameters as divisors, values before derivatives; and unknowns by
    the equations that still use them."""

    def __init__(
        self,
        tearing: Tearing,
        rows: Sequence[Row],
        unknowns: Sequence[Expr],
        rough: Iterable[Expr] = (),
        values_first: bool = False,
        guessed: Collection[Expr] = (),
    ):
        self._tearing, self._rows, self._rough = tearing, rows, set(rough)
        self._steep: set[Expr] = set()
        self._values_first = values_first
        self._open = dict.fromkeys(unknowns)
        self._missing = {row: {u for u in row.leaves if u in self._open} for row in rows}
        self._users: dict[Expr, list[Row]] = {u: [] for u in unknowns}
        for row in rows:
            for u in self._missing[row]:
                self._users[u].append(row)
        self._number = {row: k for k, row in enumerate(rows)}
        self._unused = dict.fromkeys(rows)
        self._uses = {u: len(users) for u, users in self._users.items()}
        self._tears = [(u not in guessed, -self._uses[u], k, u) for k, u in enumerate(unknowns)]
        heapq.heapify(self._tears)
        self._ready: list[tuple[tuple[int, int, int], Row, Expr, Expr]] = []
        self._torn = Torn()

    def run(self, given: Sequence[Expr]) -> Torn:
        torn = self._torn
        for row in self._rows:
            self._offer(row)
        for unknown in given:
            torn.tears.append(unknown)
            self._settle(unknown)
        while self._open:
            choice = self._best()
            if choice is None:
                unknown = self._most_used()
                torn.tears.append(unknown)
            else:
                row, unknown, value = choice
                torn.assignments.append(Assignment(unknown, value, row))
                self._use(row)
                if not self._rough.isdisjoint(row.leaves):
                    self._rough.add(unknown)
                if self._is_steep(row, unknown):
                    self._steep.add(unknown)
            self._settle(unknown)
        torn.residuals = list(self._unused)
        return torn

    def _offer(self, row: Row) -> None:
        """Enter a row with one unknown left as a way to compute it, if it is explicit in it."""
        if len(self._missing[row]) != 1:
            return
        (unknown,) = self._missing[row]
        rank, value = self._tearing.explicit(row, unknown)
        if value is not None:
            derivatives = any(n.op == "der" for n in row.leaves)
            ranks = (derivatives, rank) if self._values_first else (rank, derivatives)
            key = (*ranks, self._number[row])
            heapq.heappush(self._ready, (key, row, unknown, value))

    def _settle(self, unknown: Expr) -> None:
        del self._open[unknown]
        for row in self._users[unknown]:
            self._missing[row].discard(unknown)
            if row in self._unused:
                self._offer(row)

    def _use(self, row: Row) -> None:
        del self._unused[row]
        for n in row.leaves:
            if n in self._uses:
                self._uses[n] -= 1

    def _best(self) -> tuple[Row, Expr, Expr] | None:
        """The explicit equation to use next. One that spoils does so as long as its unknown is open: the equations
        that it would spoil cannot be used before."""
        while self._ready:
            _, row, unknown, value = heapq.heappop(self._ready)
            if unknown in self._open and not self._spoils(row, unknown):
                return row, unknown, value
        return None

    def _spoils(self, row: Row, unknown: Expr) -> bool:
        """Whether `row` would carry rough values through `unknown` into a nonlinear equation, or those of an
        exponential into another one."""
        others = [other for other in self._users[unknown] if other in self._unused and other is not row]
        if not self._rough.isdisjoint(row.leaves) and not all(self._tearing.is_linear(o, unknown) for o in others):
            return True
        return self._is_steep(row, unknown) and any(unknown in self._tearing.exponents(o) for o in others)

    def _is_steep(self, row: Row, unknown: Expr) -> bool:
        """Whether `row` gives `unknown` by an exponential of what is unknown, or by what has such a value."""
        own = self._tearing.exponents(row)
        return not self._steep.isdisjoint(row.leaves) or any(n in self._uses and n is not unknown for n in own)

    def _most_used(self) -> Expr:
        """The open unknown that most unused equations have, one with a guess before others, the first of them; counts
        in the heap may be old."""
        while True:
            blind, uses, k, unknown = heapq.heappop(self._tears)
            if unknown not in self._open:
                continue
            if -uses == self._uses[unknown]:
                return unknown
            heapq.heappush(self._tears, (blind, -self._uses[unknown], k, unknown))
