"""The callbacks for continuous time: explicit form, residual form with its Jacobian, roots, initial system, asserts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
import re

from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.emit.callbacks.asserts import of_the_run, write_assert
from lacuna.codegen.emit.callbacks.equations import EquationTable
from lacuna.codegen.emit.text.body import Body
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.emit.text.steps import StepWriter, comment, place
from lacuna.codegen.structure.causal import Division, NonlinearBlock, Step, expressions_of, unknowns_of, upstream
from lacuna.codegen.structure.residual_form import CJ, needed
from lacuna.codegen.structure.sizes import told
from lacuna.codegen.structure.sorting.tearing import Assignment
from lacuna.codegen.symbolic.expr import ONE, Expr, sub, var
from lacuna.codegen.symbolic.leaves import leaves

RHS = "static int mdl_rhs(mdl_data *m, double t, const double *x, double *xdot, double *v)"
RESIDUAL = "static int mdl_residual(mdl_data *m, double t, const double *y, const double *yp, double *r)"
JACOBIAN = (
    "static int mdl_jacobian(mdl_data *m, double t, const double *y, const double *yp, double cj, double *values)"
)
ROOTS = "static int mdl_roots(mdl_data *m, double t, const double *x, const double *xdot, const double *v, double *g)"
GUARD_RATES = "static int mdl_guard_rates(mdl_data *m, double t, const double *x, double *g)"
INITIAL = "static int mdl_initial_system(mdl_data *m, double t)"
CHECK = "static int mdl_check(mdl_data *m, double t, const double *x, const double *xdot, const double *v)"
STARTS = "static int mdl_starts(mdl_data *m)"


def function(signature: str, body: Body) -> str:
    """A C function that returns 0 at its end; arguments that it does not use are marked so."""
    return c_function(signature, body.text())


def c_function(signature: str, text: str) -> str:
    """As `function`, of a body that is text."""
    arguments = signature[signature.index("(") + 1 : -1].replace("*", " ").split(",")
    names = [a.split()[-1] for a in arguments]
    words = set(re.findall(r"(?<!->)(?<!\.)\b[A-Za-z_]\w*", re.sub(r"/\*.*?\*/", "", text)))
    unused = [f"  (void){n};" for n in names if n not in words]
    parts = [f"{signature} {{", *unused]
    result = "0"
    notes = "fn_" in text and re.search(r"\bfn_\w+\(", text)  # the first is quick
    if notes and "const mdl_data" not in signature:  # functions note their failures
        parts.append("  m->failure.kind = MDL_FAILURE_NONE;")
        result = "m->failure.kind != MDL_FAILURE_NONE"
    return "\n".join([*parts, *([text] if text else []), f"  return {result};", "}"])


def _starts_from_values(step: Step) -> bool:
    return isinstance(step, NonlinearBlock) or (isinstance(step, Division) and step.guess)


class Continuous:
    """Writes the callbacks for continuous time of one model."""

    def __init__(self, prepared: Prepared, names: Names, equations: EquationTable):
        self._p, self._names, self._equations = prepared, names, equations
        self._storage = prepared.storage

    # -- explicit form ----------------------------------------------------------------------------------------

    def _steps(self, body: Body, steps: Sequence[Step], start: Callable[[Expr], str]) -> None:
        writer = StepWriter(body, self._equations.index, start, self.nominal)
        body.plan(writer.plan(steps))
        writer.write(steps)

    def nominal(self, unknown: Expr) -> Expr:
        size = self._p.nominals.get(unknown)
        return told(size) if size else ONE

    def rhs(self) -> str:
        """What x' follows from first, with the values that the next solutions start from; then the rest."""
        body, steps = Body(self._names, self._storage.explicit), self._p.explicit
        writer = StepWriter(body, self._equations.index, self._storage.place, self.nominal)
        derivatives = set(self._p.system.derivatives)
        first = set(map(id, upstream(steps, derivatives)))
        needed, rest = ([s for s in steps if (id(s) in first) == own] for own in (True, False))
        kept = derivatives.union(*(unknowns_of(s) for s in needed if _starts_from_values(s)))
        body.plan(writer.plan(steps))
        writer.write(needed)
        self._store(body, [u for s in needed for u in unknowns_of(s) if u in kept])
        later = [u for s in steps for u in unknowns_of(s) if u not in kept]
        if later:
            with body.scope("if (!m->brief)", writer.plan(rest)):
                writer.write(rest)
                self._store(body, later)
        return function(RHS, body)

    def _store(self, body: Body, unknowns: Iterable[Expr]) -> None:
        for u in unknowns:
            body.line(f"{self._storage.place(u)} = {self._names.leaf(u)};")

    def initial_system(self) -> str:
        body = Body(self._names, self._storage.frozen)
        states = {var(n) for n in self._p.system.states}
        if self._p.initial.from_start:
            starts = [s for s in self._p.initial.steps if set(unknowns_of(s)) <= states]
            self._steps(body, starts, self._start)
            for s in starts:
                body.line(f"m->{self._storage.place(s.unknown)} = {self._names.leaf(s.unknown)};")
            body.line("return mdl_rhs(m, t, m->x, m->xdot, m->v);")
            return re.sub(r"\n  return [^;]*;\n}$", "\n}", function(INITIAL, body))
        self._steps(body, self._p.initial.steps, self._start)
        for step in self._p.initial.steps:
            for u in unknowns_of(step):
                body.line(f"m->{self._storage.place(u)} = {self._names.leaf(u)};")
        return function(INITIAL, body)

    def _start(self, unknown: Expr) -> str:
        return f"m->{self._storage.place(unknown)}"

    def starts(self) -> str:
        """Start attributes, from the parameters."""
        body = Body(self._names, self._storage.frozen)
        model, storage = self._p.model, self._storage
        given = [(n, v.start) for n in (*storage.states, *storage.algebraics, *storage.discretes)
                 if (v := model.variables[n]).start is not None]  # fmt: skip
        body.plan(e for _, e in given)
        for name, start in given:
            slot = storage.slot(name)
            body.line(f"m->{slot.array}[{slot.index}] = {body.value(start)};")
        for k in range(len(storage.discretes)):
            body.line(f"m->pre_d[{k}] = m->d[{k}];")
        return function(STARTS, body)

    # -- residual form ----------------------------------------------------------------------------------------

    def _assign(self, body: Body, chain: Sequence[Assignment]) -> None:
        for step in chain:
            body.line(comment(step.row.source, step.row.text))
            body.let(step.unknown, step.value)

    def residual(self) -> str:
        form, tears = self._p.residual, self._p.residual.tears
        body = Body(self._names, lambda n: self._storage.residual(n, tears))
        body.plan([*(s.value for s in form.assignments), *(row.residual for row in form.residuals)])
        self._assign(body, form.assignments)
        for k, row in enumerate(form.residuals):
            body.line(comment(row.source, row.text))
            body.line(f"r[{k}] = {body.value(row.residual)};")
        return function(RESIDUAL, body)

    def jacobian(self) -> str:
        form, jac = self._p.residual, self._p.jacobian
        tears = form.tears
        body = Body(self._names, lambda n: self._storage.residual(n, tears), {CJ: "cj"})
        values = [value for column in jac.entries for _, value in column]
        wanted = [leaves(e) for e in (*values, *(value for _, value in jac.tangents))]
        chain = needed(form.assignments, wanted)
        body.plan([*(s.value for s in chain), *(value for _, value in jac.tangents), *values])
        self._assign(body, chain)
        for tangent, value in jac.tangents:
            body.let(tangent, value)
        for k, value in enumerate(values):
            body.line(f"values[{k}] = {body.value(value)};")
        return function(JACOBIAN, body)

    # -- roots and asserts ------------------------------------------------------------------------------------

    def roots(self) -> str:
        body = Body(self._names, self._storage.point)
        body.plan(sub(r.left, r.right) for r in self._p.relations if r.slope is None)
        for k, r in enumerate(self._p.relations):
            value = body.value(sub(r.left, r.right)) if r.slope is None else "0.0"
            body.line(f"g[{k}] = {value};  {comment(r.source, r.text)}")
        return function(ROOTS, body)

    def guard_rates(self) -> str:
        """Affine guards as far as they move; nothing where there are none."""
        shapes = self._p.guards
        if not shapes.moving:
            return ""
        body = Body(self._names, self._storage.moving)
        writer = StepWriter(body, self._equations.index, self._storage.place, self.nominal)
        body.plan([*writer.plan(shapes.steps), *shapes.moving.values()])
        writer.write(shapes.steps)
        used = {n for e in (*shapes.moving.values(), *(e for s in shapes.steps for e in expressions_of(s)))
                for n in leaves(e)}  # fmt: skip
        for unknown in (u for step in shapes.steps for u in unknowns_of(step) if u not in used):
            body.line(f"(void){self._names.leaf(unknown)};")
        for k, value in shapes.moving.items():
            r = self._p.relations[k]
            body.line(f"g[{k}] = {body.value(value)};  {comment(r.source, r.text)}")
        return function(GUARD_RATES, body)

    def check(self) -> str:
        body = Body(self._names, self._storage.point)
        asserts = of_the_run(self._p)
        body.plan(a.condition for _, a in asserts)
        for row, a in asserts:
            body.line(f"/* {place(a.span)}  assert */")
            write_assert(body, a, row)
        return function(CHECK, body)
