"""reinit where `initial()` is a condition: at the start it is an initial equation, x = e (Modelica 3.6, 8.6).

Under a further condition it is one, too, and x is its start value where that does not hold.
"""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.symbolic.expr import ZERO, Expr, if_else, var
from lacuna.codegen.symbolic.rewrite import all_statements


def reinits_at_start(model: flat.FlatModel) -> flat.FlatModel:
    """The model with these equations, which the initial system solves together with all others."""
    found = []
    for w in model.whens:
        body = _active(w)
        for target in _targets(body):
            x, start = var(target), model.variables[target].start or ZERO
            found.append(flat.Equation(x, _value(body, x, start), w.span, w.origin, f"reinit({target}, ...)"))
    return replace(model, initial_equations=[*model.initial_equations, *found]) if found else model


def _targets(body: list[flat.Statement]) -> list[str]:
    return list(dict.fromkeys(s.target for s in all_statements(body) if isinstance(s, flat.Reinit)))


def _value(body: list[flat.Statement], x: Expr, before: Expr) -> Expr:
    """What statements make of a state that has been `before`."""
    for s in body:
        if isinstance(s, flat.Reinit) and s.target == x.value:
            before = s.value
        elif isinstance(s, flat.If):
            chosen = before
            for condition, inner in reversed(s.branches):
                chosen = if_else(condition, _value(inner, x, before), chosen)
            before = chosen
    return before


def _active(w: flat.When) -> list[flat.Statement]:
    """Statements of the first branch that is active at the start."""
    return next((body for condition, body in w.branches if _is_initial(condition)), [])


def _is_initial(condition: Expr) -> bool:
    parts = condition.args if condition.op == "array" else (condition,)
    return any(part.op == "initial" for part in parts)
