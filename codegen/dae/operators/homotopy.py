"""homotopy(actual, simplified): the actual expression in the run; at the start a path from one to the other.

Modelica 3.6, 3.7.4.4. Where the initial equations cannot be solved from the start values, the runtime solves them with
the simplified expressions and follows the solution while

    path * actual + (1 - path) * simplified

goes from path = 0 to 1. Up to `split` it is a choice, `if homotopy() then actual else simplified`, so that every pass
knows what to do with it. Only the initial system holds that sum; everything else holds the actual expression alone, so
that a run costs the same with homotopy as without.
"""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.structure.system import Row, System
from lacuna.codegen.symbolic.annotated import plain
from lacuna.codegen.symbolic.expr import ONE, Expr, add, mul, node, sub, transform
from lacuna.codegen.symbolic.rewrite import Rewriter

PATH = node("path")


def split(model: flat.FlatModel) -> flat.FlatModel:
    """The actual expressions everywhere; equations at the start with the path, those that have one."""
    actual = Rewriter(lambda n: actual.expression(n.args[1]) if _is_homotopy(n) else None)
    run = actual.model(model)
    initial = [replace(e, lhs=_on_path(e.lhs), rhs=_on_path(e.rhs)) for e in model.initial_equations]
    equations = [_with_start(before, e) for before, e in zip(model.equations, run.equations, strict=True)]
    return replace(run, equations=equations, initial_equations=initial)


def rows_at_start(system: System) -> list[Row]:
    """The rows of the system as the initial system solves them."""
    renamed = system.renamed.expression
    return [
        row if row.source.start is None or row.integral is not None
        else Row(*map(renamed, row.source.start), row.source)
        for row in system.rows
    ]  # fmt: skip


def _is_homotopy(n: Expr) -> bool:
    return n.op == "if" and n.args[0].op == "homotopy"


def _with_start(written: flat.Equation, actual: flat.Equation) -> flat.Equation:
    start = _on_path(written.lhs), _on_path(written.rhs)
    same = start[0] is written.lhs and start[1] is written.rhs
    return actual if same else replace(actual, start=tuple(map(plain, start)))


def _on_path(e: Expr) -> Expr:
    def rule(n: Expr) -> Expr | None:
        if not _is_homotopy(n):
            return None
        actual, simplified = map(_on_path, n.args[1:])
        return add(mul(PATH, actual), mul(sub(ONE, PATH), simplified))

    return transform(e, rule, {})
