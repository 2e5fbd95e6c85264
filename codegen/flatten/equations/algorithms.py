"""Algorithm sections of models: with `when` they stay statements; without, symbolic execution makes equations."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.equations.equations import Collected, check_target, check_types, origin_of, unroll
from lacuna.codegen.flatten.equations.when import procedure, when_conditions
from lacuna.codegen.flatten.expressions.constants import variability
from lacuna.codegen.flatten.expressions.lower import lower, lower_results, lower_scalar
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import scalars, shape_of, shape_text
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, FALSE, TRUE, Expr
from lacuna.codegen.symbolic.rewrite import assigned
from lacuna.codegen.syntax import ast

MAX_ROUNDS = 10_000


def flatten_algorithm(section: ast.Section, scope: Scope, out: Collected) -> None:
    """Add what an algorithm section computes, as an Algorithm or as equations."""
    statements = _statements(section.items, scope, in_when=False)
    targets = tuple(assigned(statements))
    if any(isinstance(s, flat.When) for s in _nested(statements)):
        out.algorithms.append(flat.Algorithm(statements, targets, section.span, origin_of(scope)))
        return
    run = _SymbolicRun(scope, targets)
    if run.block(statements, TRUE) is not FALSE:
        raise Diagnostic("R059", "'break' outside of a loop", section.span, "it ends the loop around it")
    for target in targets:
        if target in run.values:  # else in a loop of no rounds only
            variable, value = ex.var(target, run.types[target]), run.result(target)
            out.equations.append(
                flat.Equation(variable, value, run.where[target], origin_of(scope), f"{target} := ...")
            )
    out.asserts += run.asserts


def _nested(statements: list[flat.Statement]) -> list[flat.Statement]:
    found = list(statements)
    for s in statements:
        if isinstance(s, flat.If):
            found += [n for _, body in s.branches for n in _nested(body)]
        elif isinstance(s, flat.While):
            found += _nested(s.body)
    return found


def _statements(items: list[ast.Item], scope: Scope, in_when: bool) -> list[flat.Statement]:
    result: list[flat.Statement] = []
    for item in items:
        if isinstance(item, ast.Assignment):
            result += assignment(item, scope)
        elif isinstance(item, ast.If):
            result += _if(item, scope, in_when)
        elif isinstance(item, ast.For):
            passes = [_statements(item.body, inner, in_when) for inner in unroll(item, scope)]
            if any(isinstance(s, flat.Break) for body in passes for s in _nested(body)):
                once = [s for body in passes for s in body]
                result.append(flat.While(TRUE, [*once, flat.Break(item.span)], item.span))
            else:
                result += [s for body in passes for s in body]
        elif isinstance(item, ast.While) and not in_when:
            condition = lower_scalar(item.condition, scope, BOOLEAN)
            result.append(flat.While(condition, _statements(item.body, scope, in_when), item.span))
        elif isinstance(item, ast.Break) and not in_when:
            result.append(flat.Break(item.span))
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
        if condition is TRUE:
            branches.append((condition, _statements(body, scope, in_when)))
            break
        scope = replace(scope, conditional=True)
        if condition is not FALSE:
            branches.append((condition, _statements(body, scope, in_when)))
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
            for chosen, new in _chosen(t, v):
                check_target(chosen, item.span, scope)
                check_types(chosen, v, item.span, scope)
                result.append(flat.Assign(str(chosen.value), new, item.span))
    if len(result) > 1:
        result = _simultaneous(result)
    return result


def _chosen(target: Expr | str, value: Expr | str) -> list[tuple[Expr | str, Expr | str]]:
    """An element by a subscript that varies is a choice among all of them: the one chosen is set, the others stay; a
    subscript of none of them leaves no number."""
    if not isinstance(target, Expr) or target.op != "if" or not isinstance(value, Expr):
        return [(target, value)]
    elements: list[tuple[Expr, Expr]] = []
    none_before = TRUE
    while isinstance(target, Expr) and target.op == "if":
        condition, element, target = target.args
        elements.append((element, ex.logical_and(none_before, condition)))
        none_before = ex.logical_and(none_before, ex.logical_not(condition))
    if target.op == "var":
        elements.append((target, none_before))
        return [(element, ex.if_else(chosen, value, element)) for element, chosen in elements]
    return [(e, ex.if_else(chosen, value, ex.if_else(none_before, target, e))) for e, chosen in elements]


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

    def __init__(self, scope: Scope, targets: tuple[str, ...]) -> None:
        self.scope, self.targets = scope, frozenset(targets)
        self.values: dict[str, Expr] = {}
        self.types: dict[str, str] = {}
        self.where: dict[str, Span] = {}
        self.asserts: list[flat.Assert] = []

    def read(self, e: Expr) -> Expr:
        mapping = {ex.var(name, self.types[name]): value for name, value in self.values.items()}
        return ex.substitute(e, mapping)

    def block(self, statements: list[flat.Statement], guard: Expr) -> Expr:
        """Run statements; the condition under which a `break` ended them. What follows it runs where it did not."""
        for k, s in enumerate(statements):
            if isinstance(s, flat.Assign):
                self._assign(s.target, self.read(s.value), s.span)
            elif isinstance(s, flat.Assert):
                held = ex.logical_or(ex.logical_not(guard), self._now(s.condition))
                self.asserts.append(replace(s, condition=held))
            elif isinstance(s, flat.Break):
                return TRUE
            elif isinstance(s, flat.While):
                self._while(s, guard)
            elif isinstance(s, flat.If):
                broken = self._if(s, guard)
                if broken is not FALSE:
                    return self._after_break(broken, statements[k + 1 :], guard)
        return FALSE

    def _after_break(self, broken: Expr, rest: list[flat.Statement], guard: Expr) -> Expr:
        if broken is TRUE:
            return TRUE
        before = dict(self.values)
        later = self.block(rest, ex.logical_and(guard, ex.logical_not(broken)))
        self._merge([(broken, before), (TRUE, self.values)])
        return ex.logical_or(broken, later)

    def _now(self, e: Expr) -> Expr:
        """The value of a condition, with the values that variables have before the first assignment."""
        names = {
            str(n.value) for n in ex.walk(e) if n.op == "var" and n.value in self.targets and n.value not in self.values
        }
        if not names:
            return self.read(e)
        return ex.substitute(self.read(e), {ex.var(n, self._type(n)): self.unassigned(n) for n in names})

    def _while(self, s: flat.While, guard: Expr) -> None:
        for _ in range(MAX_ROUNDS):
            going = _without_no_event(self._now(s.condition))
            if going.op != "const":
                hint = "put the loop in a function and call it"
                message = f"how often the loop runs is not known at translation: {ex.to_text(going)}"
                raise Diagnostic("R059", message, s.span, hint)
            broken = self.block(s.body, guard) if going.value else TRUE
            if broken is TRUE:
                return
            if broken is not FALSE:
                message = f"whether the loop goes on is not known at translation: {ex.to_text(broken)}"
                raise Diagnostic("R059", message, s.span, "put the loop in a function and call it")
        raise Diagnostic("F034", f"no end after {MAX_ROUNDS} rounds", s.span, "does the loop reach its end?")

    def _type(self, name: str) -> str:
        if name not in self.types:
            self.types[name] = self.scope.context.scalars[name][0].primitive
        return self.types[name]

    def _assign(self, target: str, value: Expr, span: Span) -> None:
        self._type(target)
        self.values[target] = value
        self.where[target] = span

    def unassigned(self, name: str) -> Expr:
        """What a variable holds before it is assigned: a discrete one what it held before the event, a continuous one
        its start value (Modelica 3.6, 11.1.2)."""
        leaf, position = self.scope.context.scalars[name]
        variable = ex.var(name, self._type(name))
        if variability(variable, self.scope.context) == "discrete":
            return ex.pre(variable)
        start = leaf.element(leaf.attribute("start"), position)
        return ex.ZERO if start is None else start

    def result(self, target: str) -> Expr:
        """The value after the section; what still names a target means its value before the section."""

        def before(n: Expr) -> Expr | None:
            if n.op == "var" and n.value in self.targets:
                return self.unassigned(str(n.value))
            return n if n.op in ("der", "pre") else None

        return ex.transform(self.values[target], before, {})

    def _if(self, s: flat.If, guard: Expr) -> Expr:
        before = dict(self.values)
        outcomes: list[tuple[Expr, dict[str, Expr]]] = []
        rest, broken = TRUE, FALSE
        for condition, body in s.branches:
            self.values = dict(before)
            known = _without_no_event(self._now(condition))
            if known is FALSE:
                continue
            if known is TRUE and not outcomes:
                return self.block(body, guard)
            active = ex.logical_and(rest, known)
            ended = self.block(body, ex.logical_and(guard, active))
            broken = ex.logical_or(broken, ex.logical_and(active, ended))
            rest = ex.logical_and(rest, ex.logical_not(known))
            outcomes.append((known, self.values))
        if not outcomes or outcomes[-1][0] is not TRUE:
            outcomes.append((TRUE, before))
        self._merge(outcomes)
        return broken

    def _merge(self, outcomes: list[tuple[Expr, dict[str, Expr]]]) -> None:
        names = dict.fromkeys(n for _, values in outcomes for n in values)
        self.values = {name: self._merged(name, outcomes) for name in names}

    def _merged(self, name: str, outcomes: list[tuple[Expr, dict[str, Expr]]]) -> Expr:
        last = outcomes[-1][1]
        result = last[name] if name in last else self.unassigned(name)
        for condition, values in reversed(outcomes[:-1]):
            value = values[name] if name in values else self.unassigned(name)
            result = ex.if_else(condition, value, result)
        return result


def _without_no_event(e: Expr) -> Expr:
    """A condition decided at translation makes no event, marked or not."""
    return e.args[0] if e.op == "noEvent" and e.args[0].op == "const" else e
