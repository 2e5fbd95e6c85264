"""Discrete equations, when clauses and event algorithms in an order in which each reads what is already new."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.causal import Assignment, Step, expressions_of, following
from lacuna.codegen.structure.sorting.blocks import strong_components
from lacuna.codegen.symbolic.annotated import plain
from lacuna.codegen.symbolic.expr import REAL, Expr
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import Rewriter, all_statements, assigned, expressions


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
    """Real, and not between discrete variables only; or one that holds no unknown, too much wherever it is counted."""
    used = leaves(eq.lhs) | leaves(eq.rhs)
    unknowns = [v for n in used if n.op == "var" and (v := model.variables[str(n.value)]).causality != "input"]
    if all(v.variability not in (flat.CONTINUOUS, flat.DISCRETE) for v in unknowns):
        return True
    if eq.lhs.type != REAL and eq.rhs.type != REAL:
        return False
    continuous = any(v.variability == flat.CONTINUOUS and v.type == REAL for v in unknowns)
    return continuous or any(n.op == "der" for n in used) or not any(v.variability == flat.DISCRETE for v in unknowns)


def _directed(eq: flat.Equation, model: flat.FlatModel, taken: set[str]) -> DiscreteEquation:
    for unknown, value in ((eq.lhs, eq.rhs), (eq.rhs, eq.lhs)):
        if unknown.op == "var" and unknown not in leaves(value):
            v = model.variables[str(unknown.value)]
            if v.variability == flat.DISCRETE and v.causality != "input" and v.name not in taken:
                return DiscreteEquation(v.name, plain(value), eq)
    raise Diagnostic(
        "S010", f"no discrete variable is left for which the equation `{eq.text or eq.lhs}` could be solved", eq.span,
        "write discrete equations as `variable = expression`, one for each variable that no when clause assigns",
    )  # fmt: skip


def follow(steps: Sequence[EventStep], explicit: Sequence[Step]) -> bool:
    """Whether a step of an event reads what follows, through equations, from what events set: equations hold at every
    instant (8.5), so the runtime repeats such steps until they agree with the equations.

    Raises S013 where a when-clause gives a variable a value that follows it through equations `v = e`.
    """
    set_there = {n for step in steps for n in targets(step)}
    begun = {n for step in explicit for e in expressions_of(step) for n in leaves(e) if _is(n, set_there)}
    if not begun:
        return False
    _refuse_circles([s for step in steps if isinstance(step, flat.When) for s in _assignments(step)], explicit)
    found = following(explicit, begun)
    return any(not found.isdisjoint(leaves(e)) for step in steps for e in expressions_of_step(step))


def refuse_reinit(steps: Sequence[EventStep], states: Collection[str]) -> None:
    """Raises C002 for a reinit of what is no state (8.3.6)."""
    for s in all_statements([s for s in steps if isinstance(s, flat.When)]):
        if isinstance(s, flat.Reinit) and s.target not in states:
            hint = "reinit a state; the structure report lists them"
            raise Diagnostic("C002", f"reinit({s.target}, ...): {s.target} is not a state here", s.span, hint)


def reads_arrival(steps: Sequence[EventStep]) -> bool:
    """Whether a step reads pre(y) of a continuous variable: targets aside, what has a value before is discrete."""
    set_there = {n for step in steps for n in targets(step)}
    pres = (n for step in steps for e in expressions_of_step(step) for n in leaves(e) if n.op == "pre")
    return any(not _is(n.args[0], set_there) for n in pres)


def _is(n: Expr, names: Collection[str]) -> bool:
    return n.op == "var" and str(n.value) in names


def _assignments(w: flat.When) -> list[flat.Assign]:
    return [s for _, body in w.branches for s in body if isinstance(s, flat.Assign)]


def _refuse_circles(assignments: list[flat.Assign], explicit: Sequence[Step]) -> None:
    """Raises S013 for an assignment that stands in a circle with equations."""
    values = [(str(s.unknown.value), s.value) for s in explicit if isinstance(s, Assignment) and s.unknown.op == "var"]
    solved = len(values)
    values += [(s.target, s.value) for s in assignments]
    writer: dict[str, list[int]] = {}
    for k, (name, _) in enumerate(values):
        writer.setdefault(name, []).append(k)
    needs = [sorted({w for n in leaves(e) if n.op == "var" for w in writer.get(str(n.value), ())}) for _, e in values]
    for component in strong_components(needs):
        first = max(component)
        if min(component) < solved <= first:
            s = assignments[first - solved]
            hint = "solve it for the variable, or break the loop with pre(...)"
            raise Diagnostic("S013", f"the value that the when-clause gives {s.target} follows itself", s.span, hint)


def order(
    model: flat.FlatModel, discrete: list[DiscreteEquation], rewriter: Rewriter, algebraics: Collection[str]
) -> list[EventStep]:
    """All steps of an event in sorted order; a loop without pre() is refused. `rewriter` was applied to `model`."""

    def arrival(n: Expr) -> Expr | None:
        """pre(y) of what is left of a continuous variable: a parameter or a state is what it was."""
        if n.op != "pre":
            return None
        v = model.variables.get(str(n.args[0].value)) if n.args[0].op == "var" else None
        kept = v is not None and (v.variability == flat.DISCRETE or v.name in algebraics)
        return n if kept else n.args[0]

    arrived = Rewriter(arrival)
    discrete = [replace(d, value=rewriter.expression(d.value)) for d in discrete]
    whens = (_sorted_bodies(arrived.statements([w])[0]) for w in model.whens)
    algorithms = (replace(a, statements=arrived.statements(a.statements)) for a in model.algorithms)
    steps: list[EventStep] = [*discrete, *whens, *algorithms]
    writer: dict[str, int] = {}
    for k, step in enumerate(steps):
        for name in targets(step):
            if name in writer:
                raise Diagnostic(
                    "S011", f"{name} is assigned twice", _span(step), "use elsewhen, or one algorithm section",
                    [(_span(steps[writer[name]]), "first here")],
                )  # fmt: skip
            writer[name] = k
    _refuse_two_reinits([s for s in steps if isinstance(s, flat.When)])
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


def expressions_of_step(step: EventStep) -> list[Expr]:
    if isinstance(step, DiscreteEquation):
        return [step.value]
    return list(expressions([step] if isinstance(step, flat.When) else step.statements))


def _reads(step: EventStep) -> set[str]:
    return {str(n.value) for e in expressions_of_step(step) for n in leaves(e) if n.op == "var"}


def _reads_itself(step: EventStep) -> bool:
    """An equation must not; in a when clause and an algorithm the value from before stands until assigned."""
    return isinstance(step, DiscreteEquation) and step.target in _reads(step)


def _span(step: EventStep) -> flat.Span:
    return step.source.span if isinstance(step, DiscreteEquation) else step.span


def _refuse_two_reinits(whens: list[flat.When]) -> None:
    """Raises S011 for a state that two when-clauses, or one twice, reinitialise: nothing says which holds (8.3.6)."""
    found: dict[str, tuple[flat.When, flat.Reinit]] = {}
    for w in whens:
        for _, body in w.branches:
            here: set[str] = set()
            for s in (s for s in body if isinstance(s, flat.Reinit)):
                when, first = found.setdefault(s.target, (w, s))
                if when is not w or s.target in here:
                    hint = "use elsewhen, or one when-clause that decides between them"
                    message = f"the state {s.target} is reinitialised twice"
                    raise Diagnostic("S011", message, s.span, hint, [(first.span, "first here")])
                here.add(s.target)


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


def _refuse_own_value(s: flat.Statement) -> None:
    """Raises S013 for an equation that gives a variable a value by itself: only pre(n) is what it was before."""
    own = set(assigned([s])) & {str(n.value) for e in expressions([s]) for n in leaves(e) if n.op == "var"}
    if own:
        name = min(own)
        hint = f"write pre({name}) for the value from before the event"
        raise Diagnostic("S013", f"the equation of {name} in a when-clause holds {name} itself", s.span, hint)


def _refuse_two_equations(body: list[flat.Statement]) -> None:
    """Raises S011 for a variable that two equations of one branch give a value: nothing says which holds (8.3.5)."""
    first: dict[str, flat.Statement] = {}
    for s in body:
        for name in assigned([s]):
            if name in first:
                hint = "leave one, or use if or elsewhen"
                raise Diagnostic("S011", f"{name} is assigned twice", s.span, hint, [(first[name].span, "first here")])
            first[name] = s


def sorted_body(body: list[flat.Statement]) -> list[flat.Statement]:
    """The equations of one branch in the order of their dependencies."""
    _refuse_two_equations(body)
    writer = {n: k for k, s in enumerate(body) for n in assigned([s])}
    needs = [
        sorted({writer[str(n.value)] for e in expressions([s]) for n in leaves(e) if n.op == "var"
                and n.value in writer} - {k})
        for k, s in enumerate(body)
    ]  # fmt: skip
    components = strong_components(needs)
    for component in components:
        if len(component) == 1:
            _refuse_own_value(body[component[0]])
        else:
            statements = [body[k] for k in sorted(component)]
            names = ", ".join(n for s in statements for n in assigned([s]))
            raise Diagnostic(
                "S013", f"equations of a when-clause depend on each other in a loop: {names}", statements[0].span,
                "break the loop with pre(...) where the value from before the event is meant",
                [(s.span, "and this equation") for s in statements[1:]],
            )  # fmt: skip
    return [body[k] for component in components for k in component]
