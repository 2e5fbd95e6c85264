"""Discrete equations, when clauses and event algorithms in an order in which each reads what is already new."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.sorting.blocks import strong_components
from lacuna.codegen.symbolic.expr import REAL, Expr, var
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import Rewriter, assigned, expressions


@dataclass
class DiscreteEquation:
    """target = value at every event."""

    target: str
    value: Expr
    source: flat.Equation


EventStep = DiscreteEquation | flat.When | flat.Algorithm


def split(model: flat.FlatModel) -> tuple[list[flat.Equation], list[DiscreteEquation]]:
    """(continuous equations, discrete equations) of a frozen model."""
    continuous, discrete = [], []
    taken = {n for w in model.whens for n in assigned([w])}.union(*(a.targets for a in model.algorithms))
    for eq in model.equations:
        if _is_continuous(eq, model):
            continuous.append(eq)
        else:
            discrete.append(_directed(eq, model, taken))
            taken.add(discrete[-1].target)
    return continuous, discrete


def _is_continuous(eq: flat.Equation, model: flat.FlatModel) -> bool:
    """Real, and not between discrete variables only."""
    if eq.lhs.type != REAL and eq.rhs.type != REAL:
        return False
    used = leaves(eq.lhs) | leaves(eq.rhs)
    unknowns = [v for n in used if n.op == "var" and (v := model.variables[str(n.value)]).causality != "input"]
    continuous = any(v.variability == flat.CONTINUOUS and v.type == REAL for v in unknowns)
    return continuous or any(n.op == "der" for n in used) or not any(v.variability == flat.DISCRETE for v in unknowns)


def _directed(eq: flat.Equation, model: flat.FlatModel, taken: set[str]) -> DiscreteEquation:
    for unknown, value in ((eq.lhs, eq.rhs), (eq.rhs, eq.lhs)):
        if unknown.op == "var" and unknown not in leaves(value):
            v = model.variables[str(unknown.value)]
            if v.variability == flat.DISCRETE and v.causality != "input" and v.name not in taken:
                return DiscreteEquation(v.name, value, eq)
    raise Diagnostic(
        "S010", f"no discrete variable is left for which the equation `{eq.text or eq.lhs}` could be solved", eq.span,
        "write discrete equations as `variable = expression`, one for each variable that no when clause assigns",
    )  # fmt: skip


def settled(model: flat.FlatModel) -> flat.FlatModel:
    """The model with when-clauses that read, in place of a continuous variable, the expression that an equation gives
    it, where that follows what events set: it changes with them, in the same instant (8.3.5, 8.5).

    Raises S013 where a value would follow itself that way.
    """
    at_events = {n for w in model.whens for n in assigned([w])}.union(*(a.targets for a in model.algorithms))
    if not at_events:
        return model
    followed = _Followed(model, at_events)
    whens = [followed.in_clause(w) for w in model.whens]
    algorithms = [
        replace(a, statements=followed.rewriter(a.targets).statements(a.statements)) for a in model.algorithms
    ]
    return replace(model, whens=whens, algorithms=algorithms)


class _Followed:
    """What continuous variables follow at events, through equations `v = e`."""

    def __init__(self, model: flat.FlatModel, at_events: set[str]) -> None:
        self._at_events = at_events
        self._values: dict[str, Expr] = {}
        sides = [(a, b) for eq in model.equations for a, b in ((eq.lhs, eq.rhs), (eq.rhs, eq.lhs))]
        states = {n.args[0].value for a, _ in sides for n in leaves(a) if n.op == "der" and n.args[0].op == "var"}
        follow = {
            v.name for v in model.variables.values()
            if v.variability == flat.CONTINUOUS and v.causality != "input" and v.name not in states
        }  # fmt: skip
        for a, b in sides:
            if a.op == "var" and a.value in follow and a not in leaves(b):
                self._values.setdefault(str(a.value), b)
        self._follow = follow - at_events
        whole = [leaves(eq.lhs) | leaves(eq.rhs) for eq in model.equations if eq.lhs.op != "var" != eq.rhs.op]
        self._implicit = [e for e in whole if all(n.op != "der" for n in e)]  # with a derivative: that follows from it
        self._sources: dict[str, frozenset[str]] = {}

    def sources(self, name: str) -> frozenset[str]:
        """The variables set at events that `name` follows."""
        if name in self._at_events:
            return frozenset((name,))
        if name not in self._sources:
            self._sources[name] = frozenset()  # ends a circle
            value = self._values.get(name)
            names = [str(n.value) for n in leaves(value) if n.op == "var"] if value is not None else []
            self._sources[name] = frozenset().union(*map(self.sources, names))
        return self._sources[name]

    def rewriter(self, own: Collection[str] = ()) -> Rewriter:
        """For what reads these variables; those that follow one of `own` stay, as the statements before set it."""

        def rule(n: Expr) -> Expr | None:
            if n.op in ("der", "pre"):
                return n
            name = str(n.value) if n.op == "var" else ""
            found = self.sources(name) if name in self._values else frozenset()
            return within.expression(self._values[name]) if found and found.isdisjoint(own) else None

        within = Rewriter(rule)
        return within

    def in_clause(self, w: flat.When) -> flat.When:
        rewriter = self.rewriter()
        branches = [(c, rewriter.statements(body)) for c, body in w.branches]
        for _, body in branches:
            for s in (s for s in body if isinstance(s, flat.Assign)):
                self._refuse_circle(s)
        return replace(w, branches=branches)

    def _refuse_circle(self, s: flat.Assign) -> None:
        read = {n for n in leaves(s.value) if n.op == "var"}
        loose = [n for n in read if n.value in self._follow]
        through = any(n in e and var(s.target, n.type) in e for n in loose for e in self._implicit)
        if any(n.value == s.target for n in read) or through:
            hint = "solve it for the variable, or break the loop with pre(...)"
            raise Diagnostic("S013", f"the value that the when-clause gives {s.target} follows itself", s.span, hint)


def order(model: flat.FlatModel, discrete: list[DiscreteEquation], rewriter: Rewriter) -> list[EventStep]:
    """All steps of an event in sorted order; a loop without pre() is refused. `rewriter` was applied to `model`."""
    discrete = [replace(d, value=rewriter.expression(d.value)) for d in discrete]
    steps: list[EventStep] = [*discrete, *(_sorted_bodies(w) for w in model.whens), *model.algorithms]
    writer: dict[str, int] = {}
    for k, step in enumerate(steps):
        for name in targets(step):
            if name in writer:
                raise Diagnostic(
                    "S011", f"{name} is assigned twice", _span(step), "use elsewhen, or one algorithm section",
                    [(_span(steps[writer[name]]), "first here")],
                )  # fmt: skip
            writer[name] = k
    _check_assigned(model, writer)
    needs = [sorted({writer[n] for n in _reads(s) if n in writer} - {k}) for k, s in enumerate(steps)]
    ordered = []
    for component in strong_components(needs):
        if len(component) > 1 or _reads_itself(steps[component[0]]):
            _refuse_loop([steps[k] for k in sorted(component)])
        ordered.append(steps[component[0]])
    return ordered


def targets(step: EventStep) -> tuple[str, ...]:
    if isinstance(step, DiscreteEquation):
        return (step.target,)
    return tuple(assigned([step])) if isinstance(step, flat.When) else step.targets


def _reads(step: EventStep) -> set[str]:
    if isinstance(step, DiscreteEquation):
        used = [step.value]
    else:
        used = list(expressions([step] if isinstance(step, flat.When) else step.statements))
    return {str(n.value) for e in used for n in leaves(e) if n.op == "var"}


def _reads_itself(step: EventStep) -> bool:
    """An equation must not; in a when clause and an algorithm the value from before stands until assigned."""
    return isinstance(step, DiscreteEquation) and step.target in _reads(step)


def _span(step: EventStep) -> flat.Span:
    return step.source.span if isinstance(step, DiscreteEquation) else step.span


def _check_assigned(model: flat.FlatModel, writer: dict[str, int]) -> None:
    for v in model.variables.values():
        if v.variability == flat.DISCRETE and v.causality != "input" and v.name not in writer:
            raise Diagnostic(
                "S012", f"the discrete variable {v.name} has no equation", v.span,
                "give it an equation, assign it in a when clause, or declare it as a parameter",
            )  # fmt: skip


def _refuse_loop(steps: list[EventStep]) -> None:
    names = ", ".join(n for s in steps for n in targets(s))
    raise Diagnostic(
        "S013", f"discrete equations depend on each other in a loop: {names}", _span(steps[0]),
        "break the loop with pre(...) where the value from before the event is meant",
        [(_span(s), "and this equation") for s in steps[1:]],
    )  # fmt: skip


def _sorted_bodies(w: flat.When) -> flat.When:
    """Equations of a when clause in the order of their dependencies (they have none of their own)."""
    return replace(w, branches=[(c, sorted_body(b)) for c, b in w.branches])


def sorted_body(body: list[flat.Statement]) -> list[flat.Statement]:
    writer = {n: k for k, s in enumerate(body) for n in assigned([s])}
    needs = [
        sorted({writer[str(n.value)] for e in expressions([s]) for n in leaves(e) if n.op == "var"
                and n.value in writer} - {k})
        for k, s in enumerate(body)
    ]  # fmt: skip
    components = strong_components(needs)
    for component in components:
        if len(component) > 1:
            statements = [body[k] for k in sorted(component)]
            names = ", ".join(n for s in statements for n in assigned([s]))
            raise Diagnostic(
                "S013", f"equations of a when-clause depend on each other in a loop: {names}", statements[0].span,
                "break the loop with pre(...) where the value from before the event is meant",
                [(s.span, "and this equation") for s in statements[1:]],
            )  # fmt: skip
    return [body[k] for component in components for k in component]
