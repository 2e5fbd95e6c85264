"""Symbolic execution of an algorithm without `when`: what it assigns, as expressions in what stands outside of it."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import evaluate, is_known, variability
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import FALSE, TRUE, Expr

MAX_ROUNDS = 10_000


class SymbolicRun:
    """Values of the assigned variables as expressions in what stands outside the section."""

    def __init__(self, scope: Scope, targets: tuple[str, ...]) -> None:
        self.scope, self.targets = scope, frozenset(targets)
        self.values: dict[str, Expr] = {}
        self.types: dict[str, str] = {}
        self.where: dict[str, Span] = {}
        self.asserts: list[flat.Assert] = []

    def read(self, e: Expr) -> Expr:
        return _present(e, {ex.var(name, self.types[name]): value for name, value in self.values.items()})

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
        return _present(self.read(e), {ex.var(n, self.type_of(n)): self.unassigned(n) for n in names})

    def _while(self, s: flat.While, guard: Expr) -> None:
        for _ in range(MAX_ROUNDS):
            going = self._decided(self._now(s.condition), s.span)
            if going.op != "const":
                hint = "put the loop in a function and call it"
                message = f"how often the loop runs is not known at translation: {ex.to_text(going)}"
                raise Diagnostic("R059", message, s.span, hint)
            broken = self._decided(self.block(s.body, guard), s.span) if going.value else TRUE
            if broken is TRUE:
                return
            if broken is not FALSE:
                message = f"whether the loop goes on is not known at translation: {ex.to_text(broken)}"
                raise Diagnostic("R059", message, s.span, "put the loop in a function and call it")
        raise Diagnostic("F034", f"no end after {MAX_ROUNDS} rounds", s.span, "does the loop reach its end?")

    def _decided(self, condition: Expr, span: Span) -> Expr:
        """What decides how often a loop runs: its value, where parameters give it (they become structural)."""
        plain = _without_no_event(condition)
        if plain.op == "const" or not is_known(plain, self.scope.context):
            return plain
        return evaluate(plain, self.scope.context, span, "the condition of the loop")

    def type_of(self, name: str) -> str:
        if name not in self.types:
            self.types[name] = self.scope.context.scalars[name][0].primitive
        return self.types[name]

    def _assign(self, target: str, value: Expr, span: Span) -> None:
        self.type_of(target)
        self.values[target] = value
        self.where[target] = span

    def unassigned(self, name: str) -> Expr:
        """What a variable holds before it is assigned: a discrete one what it held before the event, a continuous one
        its start value (Modelica 3.6, 11.1.2)."""
        leaf, position = self.scope.context.scalars[name]
        variable = ex.var(name, self.type_of(name))
        if variability(variable, self.scope.context) == "discrete":
            return ex.pre(variable)
        start = leaf.element(leaf.attribute("start"), position)
        return ex.ZERO if start is None else start

    def result(self, target: str) -> Expr:
        """The value after the section; what still names a target means its value before the section."""

        value = self.values[target]
        names = {str(n.value) for n in ex.walk(value) if n.op == "var" and n.value in self.targets}
        return _present(value, {ex.var(n, self.type_of(n)): self.unassigned(n) for n in names})

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


def _present(e: Expr, values: dict[Expr, Expr]) -> Expr:
    """`e` with present values of variables; derivatives and values before the event are of the variables themselves."""
    return ex.transform(e, lambda n: n if n.op in ("der", "pre") else values.get(n), {})
