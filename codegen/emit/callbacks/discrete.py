"""The callbacks for events: one sweep of the discrete equations, time relations, sample clocks, parameters."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from lacuna.codegen import flat
from lacuna.codegen.dae.discrete.events import DiscreteEquation, targets
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.dae.relations import Relation
from lacuna.codegen.dae.unassigned import told
from lacuna.codegen.emit.callbacks.asserts import assert_rows, is_told, of_parameters, write_assert
from lacuna.codegen.emit.callbacks.continuous import function
from lacuna.codegen.emit.callbacks.equations import EquationTable
from lacuna.codegen.emit.functions.endless import ROUNDS
from lacuna.codegen.emit.text.body import Body
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.emit.text.steps import comment, place
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.constants import dependency_order
from lacuna.codegen.symbolic.expr import relation, sub, var, walk
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import assigned

EVENT = "static int mdl_event(mdl_data *m, double t, double *x, const double *xdot, const double *v)"
TIME_RELATIONS = "static int mdl_time_relations(mdl_data *m, double t)"
NEXT_TIME_EVENT = "static double mdl_next_time_event(const mdl_data *m, double t)"
SAMPLES = "static int mdl_samples(const mdl_data *m, double *start, double *interval)"
PARAMETERS = "static int mdl_parameters(mdl_data *m)"


class Discrete:
    """Writes the callbacks for events of one model."""

    signature = EVENT

    def __init__(self, prepared: Prepared, names: Names, rows: dict[str, int], equations: EquationTable):
        self._p, self._names, self._rows, self._equations = prepared, names, rows, equations
        self._row_of = assert_rows(prepared)
        self._storage = prepared.storage
        self.messages: list[str] = []
        self.when_count = self.loop_count = 0

    # -- event ------------------------------------------------------------------------------------------------

    def event(self) -> str:
        body = Body(self._names, self._storage.point)
        self._body = body
        if self._has_moving_time_relations():
            body.preamble("(void)mdl_time_relations(m, t);")
        for step in self._p.events:
            match step:
                case DiscreteEquation():
                    body.line(comment(step.source))
                    body.doubts.row = partial(self._equations.index, step.source)
                    self._equation(step)
                    body.doubts.row = None
                case flat.When():
                    self._declare(step, step.span)
                    self._when(step)
                case flat.Algorithm():
                    self._declare(step, step.span)
                    self._statements(step.statements)
        for step in self._p.events:
            for name in targets(step):
                body.line(f"m->d[{self._storage.slot(name).index}] = {self._names.identifier(name)};")
        return function(self.signature, body)

    def _equation(self, step: DiscreteEquation) -> None:
        self._body.plan([step.value])
        self._body.let(var(step.target, self._type(step.target)), step.value)

    def _has_moving_time_relations(self) -> bool:
        """Whether the instant of a time relation depends on discrete variables: it follows them from pass to pass."""
        used = [leaves(sub(r.left, r.right)) for _, r in self._timed()]
        return any(n.op == "pre" or self._storage.is_discrete(n) for found in used for n in found)

    def _type(self, name: str) -> str:
        return self._p.model.variables[name].type

    def _declare(self, step: flat.When | flat.Algorithm, span: flat.Span) -> None:
        """Discrete targets keep their value from before the event until something assigns them."""
        self._body.line(f"/* {place(span)}  {type(step).__name__.lower()} */")
        for name in targets(step):
            slot = self._storage.slot(name)
            if slot is None or slot.array != "d":
                raise Diagnostic("C001", f"{name} is assigned at events but is not a discrete variable", span)
            leaf = var(name, self._type(name))
            test = " != 0.0" if leaf.type == "Boolean" else ""
            self._body.declare(leaf, f"m->pre_d[{slot.index}]{test}")

    def _statements(self, statements: Sequence[flat.Statement]) -> None:
        for s in statements:
            self._statement(s)

    def _statement(self, s: flat.Statement) -> None:
        body = self._body
        match s:
            case flat.Assign():
                body.assign(var(s.target, self._type(s.target)), s.value)
            case flat.Reinit():
                slot = self._storage.slot(s.target)
                body.line(f"x[{slot.index}] = {body.value(s.value)};")
                body.line("m->reinitialised = 1;")
            case flat.Terminate():
                self.messages.append(s.message)
                body.line(f"m->terminated = {len(self.messages)};")
            case flat.Assert():
                self._assert(s)
            case flat.If():
                self._branches([(body.value(c), b) for c, b in s.branches])
            case flat.When():
                self._when(s)
            case flat.While():
                self._while(s)
            case flat.Break():
                body.line("break;")
            case _:
                raise Diagnostic("C003", f"{type(s).__name__.lower()} is not supported in an event section", s.span)

    def _assert(self, s: flat.Assert) -> None:
        if is_told(s):
            write_assert(self._body, s, self._row_of(s))

    def _branches(self, branches: Sequence[tuple[str, Sequence[flat.Statement]]]) -> None:
        """if (c1) {...} else if (c2) {...} ..."""
        word = "if"
        for condition, statements in branches:
            header = "else" if condition == "1" and word != "if" else f"{word} ({condition})"
            with self._body.scope(header, ()):
                self._statements(statements)
            word = "else if"

    def _while(self, s: flat.While) -> None:
        """Expressions computed before the loop from what it assigns are not those of a later round."""
        body, rounds = self._body, f"rounds{self.loop_count}"
        self.loop_count += 1
        body.line(f"int {rounds} = 0;")
        with body.loop(var(name, self._type(name)) for name in assigned(s.body)):
            body.line(f"if (!({body.value(s.condition)})) break;")
            body.line(f"if (++{rounds} > {ROUNDS}) {{")
            body.line("  (void)mdl_fail(m, MDL_FAILURE_LOOP, -1, 0.0);")
            body.line("  return -1;")
            body.line("}")
            self._statements(s.body)

    def _when(self, w: flat.When) -> None:
        """A branch fires where its condition has become true; during initialisation only through initial()."""
        body, branches, flags = self._body, [], []
        for condition, statements in w.branches:
            elements = condition.args if condition.op == "array" else (condition,)
            fires = []
            for e in elements:
                k = self.when_count
                self.when_count += 1
                body.line(f"const int when{k} = {body.value(e)};")
                initially = any(n.op == "initial" for n in walk(e))
                fires.append(f"(when{k} && !m->when[{k}]{'' if initially else ' && !m->initial'})")
                flags.append(k)
            branches.append((" || ".join(fires) if len(fires) > 1 else fires[0][1:-1], statements))
        self._branches(branches)
        for k in flags:
            body.line(f"m->when[{k}] = (unsigned char)when{k};")

    # -- time and parameters ----------------------------------------------------------------------------------

    def time_relations(self) -> str:
        body = Body(self._names, self._storage.frozen)
        for k, r in self._timed():
            g, slope = body.value(sub(r.left, r.right)), body.value(r.slope)
            body.line(f"m->rel[{k}] = (unsigned char)mdl_time_relation(m, {g}, {slope}, t);")
        return function(TIME_RELATIONS, body)

    def next_time_event(self) -> str:
        body = Body(self._names, self._storage.frozen)
        body.line("double next = INFINITY;")
        for _, r in self._timed():
            g, slope = body.value(sub(r.left, r.right)), body.value(r.slope)
            body.line(f"next = mdl_next_switch({g}, {slope}, t, next);")
        return function(NEXT_TIME_EVENT, body).replace("\n  return 0;\n}", "\n  return next;\n}")

    def _timed(self) -> list[tuple[int, Relation]]:
        return [(k, r) for k, r in enumerate(self._p.relations) if r.slope is not None]

    def samples(self) -> str:
        body = Body(self._names, self._storage.frozen)
        for k, (start, interval) in enumerate(self._p.samples):
            body.line(f"start[{k}] = {body.value(start)};")
            body.line(f"interval[{k}] = {body.value(interval)};")
        return function(SAMPLES, body)

    def parameters(self) -> str:
        """Dependent parameters in order, then bounds and asserts."""
        body, model, storage = Body(self._names, self._storage.frozen), self._p.model, self._storage
        dependent = dependent_parameters(self._p)
        body.plan(equation.rhs for _, equation in dependent)
        for name, equation in dependent:
            body.line(comment(equation))
            body.doubts.row = partial(self._equations.index, equation)
            body.let(var(name, model.variables[name].type), equation.rhs)
            body.line(f"m->p[{storage.slot(name).index}] = {self._names.identifier(name)};")
        body.doubts.row = None
        for name in storage.parameters:
            self._bounds(body, model.variables[name])
        for row, a in of_parameters(self._p):
            body.line(f"/* {place(a.span)}  assert */")
            write_assert(body, a, row)
        return function(PARAMETERS, body)

    def _bounds(self, body: Body, v: flat.Variable) -> None:
        leaf = var(v.name, v.type)
        for limit, op in ((v.min, ">="), (v.max, "<=")):
            if limit is None or v.name not in self._rows:
                continue
            inside = relation(op, leaf, limit)
            if inside.op != "const":
                body.line(f"if (!({body.value(inside)})) {{")
                body.line(f"  m->failure = (mdl_failure){{MDL_FAILURE_BOUND, -1, {self._rows[v.name]}, "
                          f"{body.value(leaf)}, {body.value(limit)}}};")  # fmt: skip
                body.line("  return -1;")
                body.line("}")


def dependent_parameters(prepared: Prepared) -> list[tuple[str, flat.Equation]]:
    """Parameters that follow others, in the order in which they are computed, each with its equation."""
    variables = prepared.model.variables
    found = [v for n in dependency_order(prepared.model) if not is_settable(v := variables[n])]
    texts = [told(f"{v.name} = {v.binding}", v.binding) for v in found]
    return [(v.name, flat.Equation(var(v.name), v.binding, v.span, text=t)) for v, t in zip(found, texts, strict=True)]


def is_settable(v: flat.Variable) -> bool:
    """A parameter that may be given another value at run time."""
    literal = v.binding is None or v.binding.op == "const"
    return v.variability == flat.PARAMETER and literal and not v.final and not v.evaluated
