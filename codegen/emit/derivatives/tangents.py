"""The functions of mdl_tangent.h: each callback of the model once more, as directional derivatives."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.emit.callbacks.continuous import function
from lacuna.codegen.emit.callbacks.discrete import dependent_parameters, is_settable
from lacuna.codegen.emit.callbacks.equations import EquationTable
from lacuna.codegen.emit.derivatives.event_tangent import EventTangent
from lacuna.codegen.emit.derivatives.lanes import Lanes, Place, needed_tangents, rows_of
from lacuna.codegen.emit.text.body import Access, Body
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.structure.causal import Step, unknowns_of
from lacuna.codegen.structure.constants import dependency_order
from lacuna.codegen.structure.residual_form import needed as needed_assignments
from lacuna.codegen.symbolic.expr import REAL, Expr, sub, var
from lacuna.codegen.symbolic.gradient import Gradients
from lacuna.codegen.symbolic.leaves import leaves

POINT = (
    "(mdl_data *m, double t, const double *x, const double *xdot, const double *v,\n"
    "                           mdl_tangent *tangent"
)
PARAMETERS = "static int mdl_parameters_tangent(mdl_data *m, mdl_tangent *tangent)"
STARTS = "static int mdl_starts_tangent(mdl_data *m, mdl_tangent *tangent)"
SAMPLES = (
    "static int mdl_samples_tangent(mdl_data *m, mdl_tangent *tangent, mdl_lanes *tangent_start, "
    "mdl_lanes *tangent_interval)"
)
INITIAL = f"static int mdl_initial_system_tangent{POINT})"
RHS = f"MDL_WIDE static int mdl_rhs_tangent{POINT})"
DERIVATIVES = f"MDL_WIDE static int mdl_derivatives_tangent{POINT})"
RESIDUAL = (
    "MDL_WIDE static int mdl_residual_tangent(mdl_data *m, double t, const double *y, const double *yp,\n"
    "                                mdl_tangent *tangent, const mdl_lanes *tangent_y,\n"
    "                                const mdl_lanes *tangent_yp, mdl_lanes *tangent_r)"
)
ROOTS = f"static int mdl_roots_tangent{POINT}, mdl_lanes *tangent_g)"
TABLE = """\
static const struct mdl_tangents mdl_model_tangents = {
  .differentiable = %s,
  .rounds = %d,
  .parameters = mdl_parameters_tangent,
  .starts = mdl_starts_tangent,
  .samples = mdl_samples_tangent,
  .initial_system = mdl_initial_system_tangent,
  .rhs = mdl_rhs_tangent,
  .derivatives = mdl_derivatives_tangent,
  .residual = mdl_residual_tangent,
  .roots = mdl_roots_tangent,
  .event = mdl_event_tangent,
};"""


class Tangents:
    """Writes the derivatives of one model."""

    def __init__(self, prepared: Prepared, names: Names, equations: EquationTable, rows: dict[str, int]):
        self._p, self._names, self._equations = prepared, names, equations
        self._storage = prepared.storage
        self.gradients = Gradients()
        self._event = EventTangent(prepared, names, rows, equations, self.gradients)

    def functions(self) -> list[str]:
        return [self._parameters(), self._starts(), self._samples(), self._initial(), self._rhs(), self._derivatives(),
                self._residual(), self._roots(), self._event.event()]  # fmt: skip

    def table(self, everything: Iterable[Expr]) -> str:
        """The table of functions; `everything` are all expressions of the model's own code."""
        parameters = self._storage.parameters
        differentiable = self._differentiable(everything)
        rounds = self._event.rounds()
        if not parameters:
            return TABLE % ("NULL", rounds)
        flags = ", ".join("01"[name in differentiable] for name in parameters)
        array = f"static const unsigned char mdl_differentiable[] = {{{flags}}};"
        return f"{array}\n\n{TABLE % ('mdl_differentiable', rounds)}"

    def _differentiable(self, everything: Iterable[Expr]) -> set[str]:
        """Real parameters that a derivative was taken for, themselves or through parameters that depend on them, and
        those that nothing depends on."""
        variables = self._p.model.variables
        smooth = {str(n.value) for n in self.gradients.used if n.op == "var"} & {*self._storage.parameters}
        used = {str(n.value) for e in everything for n in leaves(e) if n.op == "var"}
        for name in reversed(dependency_order(self._p.model)):
            if name in smooth and not is_settable(variables[name]):
                smooth |= {str(n.value) for _, n in self.gradients(variables[name].binding)}
        free = {n for n in self._storage.parameters if n not in used}
        return {n for n in smooth | free if variables[n].type == REAL}

    # -- parameters and starts --------------------------------------------------------------------------------

    def _open(self, access: Access, place: Place | None = None) -> tuple[Body, Lanes]:
        body = Body(self._names, access)
        return body, Lanes(body, self.gradients, place or rows_of(self._storage), self._equations.index)

    def _plan(self, body: Body, values: Iterable[Expr]) -> None:
        body.plan(d for e in values for d, _ in self.gradients(e))

    def _parameters(self) -> str:
        model = self._p.model
        names = [name for name, _ in dependent_parameters(self._p)]
        chain = Gradients()  # of its own: what only dependent parameters use is not thereby used
        body = Body(self._names, self._storage.frozen)
        lanes = Lanes(body, chain, rows_of(self._storage), self._equations.index)
        real = [var(n) for n in names if model.variables[n].type == REAL]
        values = {leaf: model.variables[str(leaf.value)].binding for leaf in real}
        body.plan(d for e in values.values() for d, _ in chain(e))
        for leaf, value in values.items():
            lanes.define(leaf, chain(value))
            lanes.store(leaf)
        lanes.finish()
        return function(PARAMETERS, body)

    def _starts(self) -> str:
        model, storage = self._p.model, self._storage
        body, lanes = self._open(storage.frozen)
        named = (*storage.states, *storage.algebraics, *storage.discretes)
        starts = {n: v.start for n in named if (v := model.variables[n]).start is not None and v.type == REAL}
        self._plan(body, starts.values())
        for name, start in starts.items():
            slot = storage.slot(name)
            for array in ("d", "pre_d") if slot.array == "d" else (slot.array,):
                lanes.write(f"{array}[{slot.index}]", self.gradients(start))
        lanes.finish()
        return function(STARTS, body)

    def _samples(self) -> str:
        body, lanes = self._open(self._storage.frozen)
        self._plan(body, [e for sample in self._p.samples for e in sample])
        lanes.given("start", "interval")
        for k, (start, interval) in enumerate(self._p.samples):
            lanes.write(f"start[{k}]", self.gradients(start))
            lanes.write(f"interval[{k}]", self.gradients(interval))
        lanes.finish()
        return function(SAMPLES, body)

    # -- continuous -------------------------------------------------------------------------------------------

    def _of_steps(self, signature: str, steps: list[Step], wanted: Callable[[Expr], bool]) -> str:
        body, lanes = self._open(self._storage.point)
        needed = needed_tangents(steps, {u for step in steps for u in unknowns_of(step) if wanted(u)}, self.gradients)
        body.plan(lanes.coefficients(list(needed)))
        lanes.steps(needed)
        for step in needed:
            for unknown in filter(wanted, unknowns_of(step)):
                lanes.store(unknown)
        lanes.finish()
        return function(signature, body)

    def _initial(self) -> str:
        """Only the states: rhs gives the rest from them."""
        states = {var(n) for n in self._p.system.states}
        steps = self._p.initial.steps
        if self._p.initial.from_start:
            steps = [s for s in steps if set(unknowns_of(s)) <= states]
        return self._of_steps(INITIAL, steps, states.__contains__)

    def _rhs(self) -> str:
        return self._of_steps(RHS, self._p.explicit, lambda unknown: True)

    def _derivatives(self) -> str:
        wanted = set(self._p.system.derivatives)
        return self._of_steps(DERIVATIVES, self._p.explicit, wanted.__contains__)

    def _residual(self) -> str:
        form, tears, _n_x = self._p.residual, self._p.residual.tears, len(self._storage.states)
        point = rows_of(self._storage)

        def place(leaf: Expr) -> str | None:
            text = self._storage.residual(leaf, tears)
            return text if text and text.startswith("y") else point(leaf)

        body, lanes = self._open(lambda n: self._storage.residual(n, tears), place)
        values = [*(a.value for a in form.assignments), *(row.residual for row in form.residuals)]
        coefficients = [d for e in values for d, _ in self.gradients(e)]
        chain = needed_assignments(form.assignments, map(leaves, coefficients))
        body.plan([*(a.value for a in chain), *coefficients])
        for a in chain:
            body.let(a.unknown, a.value)
        lanes.given("y", "yp", "r")
        lanes.steps({a: {a.unknown} for a in form.assignments})
        for k, row in enumerate(form.residuals):
            lanes.note(row)
            lanes.write(f"r[{k}]", self.gradients(row.residual))
        lanes.finish()
        return function(RESIDUAL, body)

    def _roots(self) -> str:
        body, lanes = self._open(self._storage.point)
        guards = [sub(r.left, r.right) for r in self._p.relations]
        self._plan(body, guards)
        lanes.given("g")
        for k, guard in enumerate(guards):
            lanes.write(f"g[{k}]", self.gradients(guard))
        lanes.finish()
        return function(ROOTS, body)
