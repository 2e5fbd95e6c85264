"""The callbacks of models with many equations, as `rolled` writes them; each is None where it is small.

They compute what `continuous` and `discrete` write for small models, with every variable in memory instead of in a
named local.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from lacuna.codegen import flat
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.emit.callbacks.asserts import of_parameters, of_the_run, warned
from lacuna.codegen.emit.callbacks.continuous import (
    CHECK,
    GUARD_RATES,
    INITIAL,
    JACOBIAN,
    RESIDUAL,
    RHS,
    ROOTS,
    STARTS,
    Continuous,
    c_function,
)
from lacuna.codegen.emit.callbacks.discrete import PARAMETERS, dependent_parameters
from lacuna.codegen.emit.callbacks.equations import EquationTable
from lacuna.codegen.emit.text.body import Access, Body
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.emit.text.rolled import Rolled, Statement, assignment, in_parts
from lacuna.codegen.emit.text.steps import StepWriter, comment, place
from lacuna.codegen.structure.causal import Division, Step, expressions_of, unknowns_of
from lacuna.codegen.structure.residual_form import CJ, needed
from lacuna.codegen.structure.sorting.tearing import Assignment
from lacuna.codegen.symbolic.expr import ZERO, Expr, relation, sub, var
from lacuna.codegen.symbolic.leaves import leaves

LARGE = 500  # statements: up to here a function of named locals compiles in a fraction of a second, and reads better

_DIVIDE = "{{ const double divisor = {{1}}; if (divisor == 0.0) {failure}; {place}[#0] = ({{0}}) / divisor; }}"
_GUESS = (
    "{{ const double divisor = {{1}}, above = {{0}}; if (divisor == 0.0 && above != 0.0) {failure}; "
    "if (divisor != 0.0) {place}[#0] = above / divisor; }}"
)
_SINGULAR = "return mdl_fail(m, MDL_FAILURE_SINGULAR, #1, 0.0)"
_BOUND = "if (!({0})) { m->failure = (mdl_failure){MDL_FAILURE_BOUND, -1, #0, {1}, {2}}; return -1; }"
_WARNING = warned("{0}", "#0")
_ASSERT = "if (!({0})) { (void)mdl_fail(m, MDL_FAILURE_ASSERT, #0, 0.0); return -1; }"


class Large:
    def __init__(self, prepared: Prepared, names: Names, equations: EquationTable, rows: dict[str, int]):
        self._p, self._names, self._equations, self._rows = prepared, names, equations, rows
        self._storage = prepared.storage
        self._small = Continuous(prepared, names, equations)

    def _written(self, signature: str, rolled: Rolled, last: str = "") -> str:
        parts = [*rolled.parts(), *([last] if last else [])]
        return in_parts(signature, parts, rolled.shared, c_function)

    # -- explicit form and initial system ---------------------------------------------------------------------

    def rhs(self) -> str | None:
        steps = self._p.explicit
        if _size(steps) <= LARGE:
            return None
        return self._written(RHS, self._steps(steps, self._storage.explicit, self._storage.place))

    def initial_system(self) -> str | None:
        initial, steps, last = self._p.initial, self._p.initial.steps, ""
        if initial.from_start:
            states = {var(n) for n in self._p.system.states}
            steps = [s for s in steps if states.issuperset(unknowns_of(s))]
            last = "  const int failed = mdl_rhs(m, t, m->x, m->xdot, m->v);\n  if (failed) return failed;"
        if _size(steps) <= LARGE:
            return None
        rolled = self._steps(steps, self._storage.frozen, lambda u: f"m->{self._storage.place(u)}")
        return self._written(INITIAL, rolled, last)

    def _steps(self, steps: Sequence[Step], access: Access, place_of: Callable[[Expr], str]) -> Rolled:
        rolled = Rolled(self._names, access)
        rolled.plan(_planned(steps))
        self._write_steps(rolled, steps, access, place_of)
        return rolled

    def _write_steps(
        self, rolled: Rolled, steps: Sequence[Step], access: Access, place_of: Callable[[Expr], str]
    ) -> None:
        for step in steps:
            match step:
                case Assignment():
                    note = comment(step.row.source, step.row.text)
                    rolled.add(assignment(place_of(step.unknown), step.value, step.unknown, note))
                case Division():
                    rolled.add(self._division(step, place_of(step.unknown)))
                case _:
                    self._block(rolled, step, access, place_of)

    def _division(self, step: Division, target: str) -> Statement:
        array, _, index = target[:-1].rpartition("[")
        form = (_GUESS if step.guess else _DIVIDE).format(failure=_SINGULAR, place=array)
        indices = (int(index), self._equations.index(step.row.source))
        note = comment(step.row.source, step.row.text)
        return Statement(form, (step.numerator, step.denominator), indices, step.unknown, target, note)

    def _block(self, rolled: Rolled, step: Step, access: Access, place_of: Callable[[Expr], str]) -> None:
        body = Body(self._names, lambda n: rolled.place(n) or access(n))
        writer = StepWriter(body, self._equations.index, place_of, self._small.nominal)
        body.plan(writer.plan([step]))
        writer.write([step])
        unknowns = [(u, place_of(u)) for u in unknowns_of(step)]
        for u, target in unknowns:
            body.line(f"{target} = {self._names.leaf(u)};")
        rolled.part(body.text(), unknowns)

    # -- residual form ----------------------------------------------------------------------------------------

    def _of_residual(self) -> Rolled:
        first = len(self._storage.states)
        tears = {z: f"y[{k}]" for k, z in enumerate(self._p.residual.tears, first)}
        return Rolled(self._names, lambda n: tears.get(n) or self._storage.residual(n, []), {CJ: "cj"})

    def _chain(self, rolled: Rolled, chain: Sequence[Assignment]) -> None:
        for step in chain:
            note = comment(step.row.source, step.row.text)
            rolled.add(assignment(rolled.scratch(), step.value, step.unknown, note))

    def residual(self) -> str | None:
        form = self._p.residual
        if len(form.assignments) + len(form.residuals) <= LARGE:
            return None
        rolled = self._of_residual()
        rolled.plan([*(s.value for s in form.assignments), *(row.residual for row in form.residuals)])
        self._chain(rolled, form.assignments)
        for k, row in enumerate(form.residuals):
            rolled.add(assignment(f"r[{k}]", row.residual, comment=comment(row.source, row.text)))
        return self._written(RESIDUAL, rolled)

    def jacobian(self) -> str | None:
        jac = self._p.jacobian
        values = [value for column in jac.entries for _, value in column]
        chain = needed(self._p.residual.assignments, map(leaves, (*values, *(value for _, value in jac.tangents))))
        if len(values) + len(jac.tangents) + len(chain) <= LARGE:
            return None
        rolled = self._of_residual()
        rolled.plan([*(s.value for s in chain), *(value for _, value in jac.tangents), *values])
        self._chain(rolled, chain)
        for tangent, value in jac.tangents:
            rolled.add(assignment(rolled.scratch(), value, tangent))
        for k, value in enumerate(values):
            rolled.add(assignment(f"values[{k}]", value))
        return self._written(JACOBIAN, rolled)

    # -- the rest ---------------------------------------------------------------------------------------------

    def roots(self) -> str | None:
        relations = self._p.relations
        if len(relations) <= LARGE:
            return None
        rolled = Rolled(self._names, self._storage.point)
        rolled.plan(sub(r.left, r.right) for r in relations if r.slope is None)
        for k, r in enumerate(relations):
            value = sub(r.left, r.right) if r.slope is None else ZERO
            rolled.add(assignment(f"g[{k}]", value, comment=comment(r.source, r.text)))
        return self._written(ROOTS, rolled)

    def guard_rates(self) -> str | None:
        moving, steps = self._p.guards.moving, self._p.guards.steps
        if len(moving) + _size(steps) <= LARGE:
            return None
        rolled = Rolled(self._names, self._storage.moving)
        rolled.plan([*_planned(steps), *moving.values()])
        self._write_steps(rolled, steps, self._storage.moving, lambda u: rolled.scratch())
        for k, value in moving.items():
            rolled.add(assignment(f"g[{k}]", value))
        return self._written(GUARD_RATES, rolled)

    def check(self) -> str | None:
        asserts = of_the_run(self._p)
        if len(asserts) <= LARGE:
            return None
        rolled = Rolled(self._names, self._storage.point)
        rolled.plan(a.condition for _, a in asserts)
        self._asserts(rolled, asserts)
        return self._written(CHECK, rolled)

    def _asserts(self, rolled: Rolled, asserts: Iterable[tuple[int, flat.Assert]]) -> None:
        for row, a in asserts:
            text = _WARNING if a.level == "warning" else _ASSERT
            rolled.add(Statement(text, (a.condition,), (row,), comment=f"/* {place(a.span)}  assert */"))

    def starts(self) -> str | None:
        model, storage = self._p.model, self._storage
        names = (*storage.states, *storage.algebraics, *storage.discretes)
        given = [(n, start) for n in names if (start := model.variables[n].start) is not None]
        if len(given) <= LARGE:
            return None
        rolled = Rolled(self._names, storage.frozen)
        rolled.plan(start for _, start in given)
        for name, start in given:
            slot = storage.slot(name)
            rolled.add(assignment(f"m->{slot.array}[{slot.index}]", start))
        count = len(storage.discretes)
        last = f"  memcpy(m->pre_d, m->d, {count} * sizeof *m->d);" if count else ""
        return self._written(STARTS, rolled, last)

    def parameters(self) -> str | None:
        model, storage = self._p.model, self._storage
        dependent = dependent_parameters(self._p)
        if len(dependent) + len(storage.parameters) <= LARGE:
            return None
        rolled = Rolled(self._names, storage.frozen)
        rolled.plan(equation.rhs for _, equation in dependent)
        for name, equation in dependent:
            leaf, target = var(name, model.variables[name].type), f"m->p[{storage.slot(name).index}]"
            rolled.add(assignment(target, equation.rhs, leaf, comment(equation)))
        for name in storage.parameters:
            self._bounds(rolled, model.variables[name])
        self._asserts(rolled, of_parameters(self._p))
        return self._written(PARAMETERS, rolled)

    def _bounds(self, rolled: Rolled, v: flat.Variable) -> None:
        leaf = var(v.name, v.type)
        for limit, op in ((v.min, ">="), (v.max, "<=")):
            if limit is None or v.name not in self._rows:
                continue
            inside = relation(op, leaf, limit)
            if inside.op != "const":
                rolled.add(Statement(_BOUND, (inside, leaf, limit), (self._rows[v.name],)))


def _planned(steps: Sequence[Step]) -> list[Expr]:
    return [e for step in steps if isinstance(step, Assignment | Division) for e in expressions_of(step)]


def _size(steps: Sequence[Step]) -> int:
    return sum(len(unknowns_of(step)) for step in steps)
