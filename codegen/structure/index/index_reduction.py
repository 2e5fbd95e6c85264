"""Index reduction: which equations must be differentiated, and how often, so that all derivatives follow.

C. Pantelides, The consistent initialization of differential-algebraic systems, SIAM J. Sci. Stat. Comput. 9
(1988) 213-231. The derivatives that become algebraic are then chosen in `dummy_derivatives`.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.index.dummy_derivatives import choose_states
from lacuna.codegen.structure.index.hidden import expose
from lacuna.codegen.structure.sorting.singular import require_regular
from lacuna.codegen.structure.system import Row, System
from lacuna.codegen.symbolic.annotated import plain
from lacuna.codegen.symbolic.differentiate import Differentiator
from lacuna.codegen.symbolic.expr import ONE, ZERO, Expr, der, is_const, to_text, var
from lacuna.codegen.symbolic.leaves import leaves


def reduce_index(model: flat.FlatModel, equations: list[flat.Equation], relations: int = 0) -> System:
    """The index-1 (or 0) system that is equivalent to the continuous equations of `model`, which has so many relations
    already."""
    names = [
        v.name
        for v in model.variables.values()
        if v.variability == flat.CONTINUOUS and v.causality != "input" and v.type == "Real"
    ]
    rows = [Row(e.lhs, e.rhs, e) for e in equations]
    require_regular(rows, names, model)
    rows = expose(rows, names)
    model, started = _derivatives_at_start(model, rows, set(names))
    names += [str(row.lhs.value) for row in started]
    rows += started
    rows = _plain(_Pantelides(model, rows, names).run())
    return choose_states(model, rows, names, relations)


def _plain(rows: list[Row]) -> list[Row]:
    """The rows, what is differentiated no more without what it would take."""
    memo: dict[Expr, Expr] = {}
    done: dict[Row | None, Row | None] = {None: None}
    for row in rows:  # those that others are derivatives of come first
        lhs, rhs, integral = plain(row.lhs, memo), plain(row.rhs, memo), done[row.integral]
        same = lhs is row.lhs and rhs is row.rhs and integral is row.integral
        done[row] = row if same else Row(lhs, rhs, row.source, integral)
    return [done[row] for row in rows]


def _derivatives_at_start(model: flat.FlatModel, rows: list[Row], names: set[str]) -> tuple[flat.FlatModel, list[Row]]:
    """Variables and rows for derivatives that only the initial equations have: the reduction must know of them."""
    known = {n for row in rows for n in row.leaves}
    found: dict[Expr, flat.Equation] = {}
    for eq in model.initial_equations:
        for n in sorted(leaves(eq.lhs) | leaves(eq.rhs), key=to_text):
            if n.op == "der" and n not in known and base_name(n) in names:
                found.setdefault(n, eq)
    variables, started = dict(model.variables), []
    for n, eq in found.items():
        name = f"start of {to_text(n)}"
        variables[name] = flat.Variable(name, eq.span, description="a derivative that an initial equation has")
        started.append(Row(var(name), n, flat.Equation(var(name), n, eq.span, eq.origin, f"{name} = {to_text(n)}")))
    return replace(model, variables=variables), started


def base_name(n: Expr) -> str:
    """The variable that a derivative of any order is of."""
    while n.op == "der":
        n = n.args[0]
    return str(n.value)


class TimeDerivative:
    """d/dt of equations, where `still` does not move. The derivative of an input is not known: `require_known` refuses
    that, once all inputs are known that would have one."""

    def __init__(self, model: flat.FlatModel, still: Collection[Expr] = ()):
        self._model, self._still = model, still
        self._row: Row | None = None
        self._refused: dict[str, Diagnostic] = {}  # by the input, the first first
        self._differentiate = Differentiator(self._seed, rules=model.derivatives)

    def row(self, row: Row) -> Row:
        self._row = row
        return Row(self._differentiate(row.lhs), self._differentiate(row.rhs), row.source, integral=row)

    def require_known(self) -> None:
        """Raises S004, about all inputs that would have to be differentiated, where there are such."""
        for refusal in self._refused.values():
            raise replace(refusal, about=tuple(self._refused))

    def _seed(self, n: Expr) -> Expr:
        if n.op == "time":
            return ONE
        if n.op not in ("var", "der") or n in self._still:
            return ZERO
        v = self._model.variables[base_name(n)]
        if v.causality == "input":
            self._refused.setdefault(v.name, self._refusal(v))
            return ZERO
        return der(n) if v.variability == flat.CONTINUOUS else ZERO

    def _refusal(self, v: flat.Variable) -> Diagnostic:
        return Diagnostic(
            "S004", f"the input {v.name} would have to be differentiated: `{self._row.text}` constrains states",
            self._row.source.span,
            "let the input act through an inertia or a filter, or add its derivative as an input",
            [(v.span, f"{v.name} is declared here")],
        )  # fmt: skip


def _still(rows: list[Row]) -> set[Expr]:
    """Variables of which an equation says der(x) = 0: constraints on other variables do not determine them."""
    sides = [pair for row in rows for pair in ((row.lhs, row.rhs), (row.rhs, row.lhs))]
    return {a.args[0] for a, b in sides if a.op == "der" and is_const(b, 0)}


class _Pantelides:
    def __init__(self, model: flat.FlatModel, rows: list[Row], names: list[str]):
        self._unknown = set(names)
        self._position = {name: k for k, name in enumerate(names)}
        self._differentiate = TimeDerivative(model, _still(rows))
        self.rows = rows
        self.derivative_of: dict[Row, Row] = {}
        self.has_derivative: set[Expr] = set()  # variables whose derivative is in the system too
        self.row_of: dict[Expr, Row] = {}
        self.variable_of: dict[Row, Expr] = {}
        for row in rows:
            self._note(row)

    def _note(self, row: Row) -> None:
        for n in row.leaves:
            while n.op == "der":
                n = n.args[0]
                self.has_derivative.add(n)

    def _variables(self, row: Row) -> list[Expr]:
        """Highest derivatives that occur in a row, in a fixed order."""
        found = [
            n for n in row.leaves
            if n.op in ("var", "der") and n not in self.has_derivative and base_name(n) in self._unknown
        ]  # fmt: skip
        return sorted(found, key=lambda n: (self._position[base_name(n)], n.op))

    def run(self) -> list[Row]:
        try:
            for row in list(self.rows):
                while row is not None and not self._augment(row):
                    row = self.derivative_of[row]
        finally:
            self._differentiate.require_known()
        return self.rows

    def _augment(self, start: Row) -> bool:
        """Match `start` to a highest derivative; where that fails differentiate all rows that compete for one."""
        reached_from: dict[Expr, Row] = {}
        queue = [start]
        for row in queue:
            for v in self._variables(row):
                if v in reached_from:
                    continue
                reached_from[v] = row
                if v not in self.row_of:
                    self._flip(v, reached_from)
                    return True
                queue.append(self.row_of[v])
        self._differentiate_all(queue, list(reached_from))
        return False

    def _flip(self, v: Expr, reached_from: dict[Expr, Row]) -> None:
        while v is not None:
            row = reached_from[v]
            before = self.variable_of.get(row)
            self._match(v, row)
            v = before

    def _match(self, v: Expr, row: Row) -> None:
        self.row_of[v], self.variable_of[row] = row, v

    def _differentiate_all(self, rows: list[Row], variables: list[Expr]) -> None:
        for row in rows:
            if row not in self.derivative_of:
                new = self._differentiate.row(row)
                self.derivative_of[row] = new
                self.rows.append(new)
        self.has_derivative.update(variables)
        for row in rows:
            self._note(self.derivative_of[row])
        for v in variables:
            if v in self.row_of:
                row = self.row_of.pop(v)
                del self.variable_of[row]
                self._match(der(v), self.derivative_of[row])
