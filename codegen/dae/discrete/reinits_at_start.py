"""reinit where `initial()` is a condition: at the start it is an initial equation, x = e (Modelica 3.6, 8.6)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.symbolic.expr import Expr, var


def reinits_at_start(model: flat.FlatModel) -> flat.FlatModel:
    """The model with these equations, which the initial system solves together with all others."""
    found = [
        flat.Equation(var(s.target), s.value, s.span, w.origin, f"reinit({s.target}, {s.value})")
        for w in model.whens for s in _active(w) if isinstance(s, flat.Reinit)
    ]  # fmt: skip
    return replace(model, initial_equations=[*model.initial_equations, *found]) if found else model


def _active(w: flat.When) -> Iterator[flat.Statement]:
    """Statements of the first branch that is active at the start."""
    yield from next((body for condition, body in w.branches if _is_initial(condition)), [])


def _is_initial(condition: Expr) -> bool:
    parts = condition.args if condition.op == "array" else (condition,)
    return any(part.op == "initial" for part in parts)
