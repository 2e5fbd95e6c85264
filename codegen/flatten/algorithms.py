"""Algorithm sections of models: with `when` they stay statements; without, symbolic execution makes equations."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.constants import variability
from lacuna.codegen.flatten.equations import Collected, check_target, check_types, origin_of, unroll
from lacuna.codegen.flatten.lower import lower, lower_results, lower_scalar
from lacuna.codegen.flatten.scope import Scope
from lacuna.codegen.flatten.values import scalars, shape_of, shape_text
from lacuna.codegen.flatten.when import procedure, when_conditions
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, FALSE, TRUE, Expr
from lacuna.codegen.symbolic.rewrite import assigned
from lacuna.codegen.syntax import ast


def flatten_algorithm(section: ast.Section, scope: Scope, out: Collected) -> None:
    """Add what an algorithm section computes, as an Algorithm or as equations."""
    statements = _statements(section.items, scope, in_when=False)
    targets = tuple(assigned(statements))
    if any(isinstance(s, flat.When) for s in _nested(statements)):
        out.algorithms.append(flat.Algorithm(statements, targets, section.span, origin_of(scope)))
        return
    run = _SymbolicRun(scope)
    run.block(statements, TRUE)
    for target in targets:
        span, value = run.where[target], run.values[target]
        variable = ex.var(target, run.types[target])
        if any(n is variable for n in ex.walk(value)):
            message = f"{target} is read, or left alone in some branch, before it is assigned"
            raise Diagnostic("F032", message, span, "assign it first, in every case")
        out.equations.append(flat.Equation(variable, value, span, origin_of(scope), f"{target} := ..."))
    out.asserts += run.asserts


def _nested(statements: list[flat.Statement]) -> list[flat.Statement]:
    found = list(statements)
    for s in statements:
        if isinstance(s, flat.If):
            found += [n for _, body in s.branches for n in _nested(body)]
    return found


def _statements(items: list[ast.Item], scope: Scope, in_when: bool) -> list[flat.Statement]:
    result: list[flat.Statement] = []
    for item in items:
        if isinstance(item, ast.Assignment):
            result += assignment(item, scope)
        elif isinstance(item, ast.If):
            result += _if(item, scope, in_when)
        elif isinstance(item, ast.For):
            for inner in unroll(item, scope):
                result += _statements(item.body, inner, in_when)
        elif isinstance(item, ast.When):
            result.append(_when(item, scope, in_when))
        elif isinstance(item, ast.Procedure):
            result += _procedure(item, scope, in_when)
        else:
            what = type(item).__name__.lower()
            hint = "put the loop in a function and call it"
            raise Diagnostic("R059", f"'{what}' in the algorithm of a model", item.span, hint)
    return result


def _procedure(item: ast.Procedure, scope: Scope, in_when: bool) -> list[flat.Statement]:
    if not in_when and str(item.call.function) in ("reinit", "terminate"):
        hint = f"put it under a condition: when ... then {item.call.function}(...); end when;"
        raise Diagnostic("R056", f"{item.call.function} outside of when", item.span, hint)
    return procedure(item, scope)


def _when(item: ast.When, scope: Scope, in_when: bool) -> flat.When:
    if in_when:
        raise Diagnostic("R057", "'when' inside of when", item.span, "combine the conditions: when a and b then")
    branches = []
    for written, body in item.branches:
        statements = _statements(body, scope, in_when=True)
        branches += [(condition, statements) for condition in when_conditions(written, scope)]
    return flat.When(branches, item.span, origin_of(scope))


def _if(item: ast.If, scope: Scope, in_when: bool) -> list[flat.Statement]:
    branches = []
    for written, body in item.branches:
        condition = TRUE if written is None else lower_scalar(written, scope, BOOLEAN)
        if condition is not FALSE:
            branches.append((condition, _statements(body, scope, in_when)))
        if condition is TRUE:
            break
    if branches and branches[0][0] is TRUE:
        return branches[0][1]
    return [flat.If(branches, item.span)] if branches else []


def assignment(item: ast.Assignment, scope: Scope) -> list[flat.Statement]:
    """target := value, scalar by scalar; values are read before any is assigned."""
    if isinstance(item.target, ast.Tuple):
        values = lower_results(item.value, scope)
        pairs = [(lower(t, scope), v) for t, v in zip(item.target.items, values, strict=False) if t is not None]
    else:
        pairs = [(lower(item.target, scope), lower(item.value, scope))]
    result: list[flat.Statement] = []
    for target, value in pairs:
        if shape_of(target) != shape_of(value):
            message = f"{shape_text(shape_of(target))} := {shape_text(shape_of(value))}"
            raise Diagnostic("R042", f"the sides differ in size: {message}", item.span, "both need the same size")
        for t, v in zip(scalars(target), scalars(value), strict=True):
            check_target(t, item.span, scope)
            check_types(t, v, item.span, scope)
            result.append(flat.Assign(str(t.value), v, item.span))
    if len(result) > 1:
        result = _simultaneous(result)
    return result


def _simultaneous(result: list[flat.Statement]) -> list[flat.Statement]:
    """Elements assigned together must not read each other's new values."""
    done: set[str] = set()
    for s in result:
        if any(n.op == "var" and n.value in done for n in ex.walk(s.value)):
            hint = "assign to another array first, then copy"
            raise Diagnostic("R058", f"{s.target} reads an element assigned in the same statement", s.span, hint)
        done.add(s.target)
    return result


class _SymbolicRun:
    """Values of the assigned variables as expressions in what stands outside the section."""

    def __init__(self, scope: Scope) -> None:
        self.scope = scope
        self.values: dict[str, Expr] = {}
        self.types: dict[str, str] = {}
        self.where: dict[str, Span] = {}
        self.asserts: list[flat.Assert] = []

    def read(self, e: Expr) -> Expr:
        mapping = {ex.var(name, self.types[name]): value for name, value in self.values.items()}
        return ex.substitute(e, mapping)

    def block(self, statements: list[flat.Statement], guard: Expr) -> None:
        for s in statements:
            if isinstance(s, flat.Assign):
                self._assign(s.target, self.read(s.value), s.span)
            elif isinstance(s, flat.Assert):
                held = ex.logical_or(ex.logical_not(guard), self.read(s.condition))
                self.asserts.append(replace(s, condition=held))
            elif isinstance(s, flat.If):
                self._if(s, guard)

    def _assign(self, target: str, value: Expr, span: Span) -> None:
        if target not in self.types:
            leaf = self.scope.context.scalars[target][0]
            self.types[target] = leaf.primitive
        self.values[target] = value
        self.where[target] = span

    def _unassigned(self, name: str) -> Expr:
        """What a variable holds where no statement has assigned it: the value of before, if it is discrete."""
        variable = ex.var(name, self.types[name])
        return ex.pre(variable) if variability(variable, self.scope.context) == "discrete" else variable

    def _if(self, s: flat.If, guard: Expr) -> None:
        before = dict(self.values)
        outcomes: list[tuple[Expr, dict[str, Expr]]] = []
        rest = guard
        for condition, body in s.branches:
            self.values = dict(before)
            known = self.read(condition)
            self.block(body, ex.logical_and(rest, known))
            rest = ex.logical_and(rest, ex.logical_not(known))
            outcomes.append((known, self.values))
        if outcomes[-1][0] is not TRUE:
            outcomes.append((TRUE, before))
        names = dict.fromkeys(n for _, values in outcomes for n in values)
        merged = {}
        for name in names:
            last = outcomes[-1][1]
            result = last[name] if name in last else self._unassigned(name)
            for condition, values in reversed(outcomes[:-1]):
                value = values[name] if name in values else self._unassigned(name)
                result = ex.if_else(condition, value, result)
            merged[name] = result
        self.values = merged
