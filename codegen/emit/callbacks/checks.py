"""What the runtime needs to look after a run: which equation gives what, sizes of unknowns and guards, divisors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from lacuna.codegen import flat
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.emit.callbacks.continuous import c_function, function
from lacuna.codegen.emit.callbacks.discrete import dependent_parameters
from lacuna.codegen.emit.callbacks.equations import EquationTable
from lacuna.codegen.emit.text.body import Access, Body
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.emit.text.rolled import Rolled, assignment, in_parts
from lacuna.codegen.emit.text.steps import comment
from lacuna.codegen.structure.causal import Assignment, Division, Step
from lacuna.codegen.structure.nominal import difference
from lacuna.codegen.structure.sizes import told
from lacuna.codegen.symbolic.expr import BOOLEAN, REAL, ZERO, Expr, var
from lacuna.codegen.symbolic.leaves import leaves

NOMINALS = "static int mdl_nominals(mdl_data *m, double *nominal)"
_POINT = "mdl_data *m, double t, const double *x, const double *xdot, const double *v"
DIVISIONS = f"static int mdl_divisions({_POINT}, double *value)"
PHASES = f"static int mdl_phases({_POINT}, double *phase)"
DELAYS = f"static int mdl_delays({_POINT}, double *value)"
DELAY_TIMES = "static int mdl_delay_times(const mdl_data *m, double *seconds)"
TRANSPORTS = f"static int mdl_transports({_POINT}, double *value)"
TRANSPORT_INITIAL = "static int mdl_transport_initial(const mdl_data *m, double *value)"
SMALL = 50  # rows up to which each is a line of its own
MAX_SHOWN = 8  # variables whose values a message shows


@dataclass
class Checks:
    """Tables and callbacks of one model; `rows` are the indices of declared variables in the table."""

    prepared: Prepared
    equations: EquationTable
    names: Names
    rows: dict[str, int]

    def computed(self) -> list[str]:
        storage = self.prepared.storage
        parameters = [
            f"{{MDL_PARAMETER, {storage.slot(name).index}, {self.equations.index(equation)}}}"
            for name, equation in dependent_parameters(self.prepared)
        ]
        return parameters + [
            f"{{{self._place(unknown)}, {self.equations.index(source)}}}"
            for step in self.prepared.explicit
            for unknown, source in _sources(step)
        ]

    def _place(self, unknown: Expr) -> str:
        slot = self.prepared.storage.slot(str((unknown.args[0] if unknown.op == "der" else unknown).value))
        return f"{'MDL_DERIVATIVE' if unknown.op == 'der' else 'MDL_ALGEBRAIC'}, {slot.index}"

    def equation_variables(self) -> tuple[list[str], list[str]]:
        """(where those of each equation begin, rows of the variables)."""
        first, variables = [0], []
        for e in self.equations.entries:
            names = sorted({str(n.value) for n in leaves(e.lhs) | leaves(e.rhs) if n.op == "var"} & self.rows.keys())
            variables += [str(self.rows[n]) for n in names[:MAX_SHOWN]]
            first.append(len(variables))
        return [str(k) for k in first], variables

    def nominals(self) -> str:
        sizes, model = self.prepared.nominals, self.prepared.model
        unknowns = [*map(var, self.prepared.storage.states), *self.prepared.residual.tears]
        found = [sizes.get(u) for u in unknowns]
        found += [difference(r.left, r.right, sizes, model) for r in self.prepared.relations]
        found += [sizes.get(var(d.past)) for d in self.prepared.delays]
        rows = [(f"nominal[{k}]", told(size) if size else ZERO, "") for k, size in enumerate(found)]
        return self._write(NOMINALS, rows, self.prepared.storage.frozen)

    def divisions(self) -> str:
        rows = []
        for k, q in enumerate(self.prepared.divisions):
            rows.append((f"value[{2 * k}]", q.numerator, comment(q.source)))
            rows.append((f"value[{2 * k + 1}]", q.divisor, ""))
        return self._write(DIVISIONS, rows, self.prepared.storage.point)

    def phases(self) -> str:
        """Nothing where there are none."""
        rows = [(f"phase[{k}]", e, "") for k, e in enumerate(self.prepared.guards.phases)]
        return self._write(PHASES, rows, self.prepared.storage.point) if rows else ""

    def delays(self) -> list[str]:
        """What is delayed and by how long; nothing where nothing is."""
        if not self.prepared.delays:
            return []
        times = Body(self.names, self.prepared.storage.frozen)
        for k, d in enumerate(self.prepared.delays):
            times.line(f"seconds[{k}] = {times.value(d.seconds)};")
        rows = [(f"value[{k}]", var(d.past), "") for k, d in enumerate(self.prepared.delays)]
        return [function(DELAY_TIMES, times), self._write(DELAYS, rows, self.prepared.storage.point)]

    def delay_inputs(self) -> list[str]:
        return [str(self.prepared.storage.slot(d.input).index) for d in self.prepared.delays]

    def delay_equations(self) -> list[str]:
        return [str(self.equations.index(d.source)) for d in self.prepared.delays]

    def transports(self) -> list[str]:
        """What is carried, and with what it begins; nothing where nothing is."""
        carried = self.prepared.transports
        if not carried:
            return []
        start = Body(self.names, self.prepared.storage.frozen)
        for k, e in enumerate(e for t in carried for e in (*t.points, *t.values)):
            start.line(f"value[{k}] = {start.value(e)};")
        types = (REAL, REAL, REAL, BOOLEAN)
        rows = [(var(n, kind), "") for t in carried for n, kind in zip(t.now, types, strict=True)]
        now = [(f"value[{k}]", value, note) for k, (value, note) in enumerate(rows)]
        return [function(TRANSPORT_INITIAL, start), self._write(TRANSPORTS, now, self.prepared.storage.point)]

    def transport_inputs(self) -> list[str]:
        return [str(self.prepared.storage.slot(n).index) for t in self.prepared.transports for n in t.marks]

    def transport_points(self) -> list[str]:
        return [str(len(t.points)) for t in self.prepared.transports]

    def _write(self, signature: str, rows: list[tuple[str, Expr, str]], access: Access) -> str:
        """A callback that stores the value of each row (place, value, comment)."""
        if len(rows) > SMALL:
            rolled = Rolled(self.names, access)
            rolled.plan(value for _, value, _ in rows)
            for place, value, note in rows:
                rolled.add(assignment(place, value, comment=note))
            return in_parts(signature, rolled.parts(), rolled.shared, c_function)
        body = Body(self.names, access)
        body.plan(value for _, value, _ in rows)
        for place, value, note in rows:
            if note:
                body.line(note)
            body.line(f"{place} = {body.value(value)};")
        return function(signature, body)

    def division_equations(self) -> list[str]:
        return [str(self.equations.index(q.source)) for q in self.prepared.divisions]


def least_sizes(p: Prepared) -> list[str]:
    """1 for each state of which the model tells a least size alone; nothing where there is none."""
    sizes = [p.nominals.get(var(name)) for name in p.storage.states]
    rows = [str(int(size is not None and size.at_least)) for size in sizes]
    return rows if "1" in rows else []


def _sources(step: Step) -> Iterator[tuple[Expr, flat.Equation]]:
    """Each unknown of a step with its equation; a tear with a residual of its block."""
    if isinstance(step, Assignment | Division):
        yield step.unknown, step.row.source
        return
    for unknown, row in zip(step.tears, step.residuals, strict=True):
        yield unknown, row.source
    for a in step.assignments:
        yield a.unknown, a.row.source
