"""If-equations to if-expressions; where branches differ in structure the condition is decided at translation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.equations.equations import Collected
from lacuna.codegen.flatten.expressions.constants import is_known, known, variability
from lacuna.codegen.flatten.expressions.lower import lower_scalar
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, TRUE, Expr
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.syntax import ast

Descend = Callable[[ast.Item, Scope, Collected], None]


def flatten_if(item: ast.If, scope: Scope, out: Collected, descend: Descend) -> None:
    """Add the equations of an if-equation, those of its branches by `descend`.

    Raises F030 where branches that change in time do not match.
    """
    conditions, inner = [], scope
    for written, _ in item.branches:
        conditions.append(TRUE if written is None else lower_scalar(written, inner, BOOLEAN))
        if conditions[-1].op != "const":
            inner = replace(scope, conditional=True)
    fixed = all(is_known(c, scope.context) for c in conditions)
    if fixed and (all(c.op == "const" for c in conditions) or _structural(item)):
        _decided(item, conditions, scope, out, descend)
        return
    try:
        parts = [_branch(body, replace(scope, conditional=True), descend) for _, body in item.branches]
        if fixed and not _same_structure([p.equations for p in parts], scope.context):
            _decided(item, conditions, scope, out, descend)
            return
        merged = _merge(item, conditions, parts)
    except Diagnostic:
        if not fixed:
            raise
        _decided(item, conditions, scope, out, descend)
        return
    out.equations += merged.equations
    out.asserts += merged.asserts


def _structural(item: ast.If) -> bool:
    """Does any branch hold what only the structure can switch?"""
    return any(_has_structure(body) for _, body in item.branches)


def _has_structure(body: list[ast.Item]) -> bool:
    for item in body:
        if isinstance(item, ast.Connect | ast.When):
            return True
        if isinstance(item, ast.Procedure) and str(item.call.function).startswith("Connections."):
            return True
        if isinstance(item, ast.For) and _has_structure(item.body):
            return True
        if isinstance(item, ast.If) and any(_has_structure(b) for _, b in item.branches):
            return True
    return False


def _decided(item: ast.If, conditions: list[Expr], scope: Scope, out: Collected, descend: Descend) -> None:
    for condition, (_, body) in zip(conditions, item.branches, strict=True):
        if known(condition, scope, item.span, "the condition of an if-equation").value:
            for inner in body:
                descend(inner, scope, out)
            return


def _branch(body: list[ast.Item], scope: Scope, descend: Descend) -> Collected:
    part = Collected()
    for item in body:
        descend(item, scope, part)
    return part


def _merge(item: ast.If, conditions: list[Expr], parts: list[Collected]) -> Collected:
    for part, (_, body) in zip(parts, item.branches, strict=True):
        if part.whens or part.connections or part.branches:
            span = body[0].span if body else item.span
            what = "when" if part.whens else "connect" if part.connections else str(part.branches[0].call.function)
            hint = "its condition must depend on parameters only"
            raise Diagnostic("F031", f"'{what}' under a condition that changes in time", span, hint)
    if conditions[-1] is not TRUE:
        conditions, parts = [*conditions, TRUE], [*parts, Collected()]
    counts = [len(p.equations) for p in parts]
    if len(set(counts)) > 1:
        found = ", ".join(map(str, counts))
        hint = "every branch, 'else' included, has equally many equations"
        raise Diagnostic("F030", f"the branches have {found} equations", item.span, hint)
    result = Collected()
    result.equations = _merge_equations(conditions, [p.equations for p in parts])
    guard = TRUE
    for condition, part in zip(conditions, parts, strict=True):
        active = ex.logical_and(guard, condition)
        for a in part.asserts:
            held = ex.logical_or(ex.logical_not(active), a.condition)
            result.asserts.append(replace(a, condition=held))
        guard = ex.logical_and(guard, ex.logical_not(condition))
    return result


def _same_unknowns(branches: list[list[flat.Equation]]) -> bool:
    """Do all branches have the same left sides, each once?"""
    sides = {e.lhs for e in branches[0]}
    return all(len(b) == len(sides) and {e.lhs for e in b} == sides for b in branches)


def _same_structure(branches: list[list[flat.Equation]], context: Context) -> bool:
    """Have all branches the same left sides, and equations of the same unknowns for each? Where they have not, an
    equation that gives a variable in one branch may have lost it in another."""
    if not _same_unknowns(branches):
        return False
    unknowns = [{e.lhs: _unknowns(e, context) for e in b} for b in branches]
    return all(found == unknowns[0] for found in unknowns)


def _unknowns(e: flat.Equation, context: Context) -> set[Expr]:
    return {n for n in leaves(e.lhs) | leaves(e.rhs)
            if n.op == "der" or (n.op == "var" and variability(n, context) == "continuous")}  # fmt: skip


def _merge_equations(conditions: list[Expr], branches: list[list[flat.Equation]]) -> list[flat.Equation]:
    """Equations of the same left side go together, where every branch has the same left sides; else by position."""
    if _same_unknowns(branches):
        sides = [e.lhs for e in branches[0]]
        by_side = [{e.lhs: e for e in b} for b in branches]
        branches = [[b[s] for s in sides] for b in by_side]
    result = []
    for row in zip(*branches, strict=True):
        lhs, rhs = (choose(conditions, [getattr(e, side) for e in row], row[0].span) for side in ("lhs", "rhs"))
        text = " | ".join(dict.fromkeys(e.text for e in row))
        branches = tuple(zip(conditions, row, strict=True))
        result.append(flat.Equation(lhs, rhs, row[0].span, row[0].origin, text, branches=branches))
    return result


def choose(conditions: list[Expr], values: list[Expr], span: Span) -> Expr:
    """if c1 then v1 elseif c2 then v2 ... else vn; the last condition is true."""
    result = values[-1]
    for condition, value in zip(reversed(conditions[:-1]), reversed(values[:-1]), strict=True):
        if (value.type == BOOLEAN) != (result.type == BOOLEAN):
            message = f"one branch is {value.type}, the other {result.type}"
            raise Diagnostic("R024", message, span, "make them alike")
        result = ex.if_else(condition, value, result)
    return result
