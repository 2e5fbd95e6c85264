"""Discrete equations, when clauses and event algorithms in an order in which each reads what is already new."""

from __future__ import annotations

from dataclasses import dataclass, replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.sorting.blocks import strong_components
from lacuna.codegen.symbolic.expr import REAL, Expr
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
    return [body[k] for component in strong_components(needs) for k in sorted(component)]
