"""delay(e, T): e as it was T seconds ago (Modelica 3.6, 3.7.4.1).

Up to `split` it is an expression, so that every pass knows what is in it. Then each becomes an input that the runtime
writes, from what it has kept of the past of e:

    past = e            a variable, kept
    delayed = input     which is e itself in the initial system: up to the start all was as it is there
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.structure.constants import is_parametric
from lacuna.codegen.symbolic.expr import Expr, relation, to_text, var, walk
from lacuna.codegen.symbolic.leaves import holds
from lacuna.codegen.symbolic.rewrite import Rewriter


@dataclass(frozen=True)
class Delay:
    """`input` is what the variable `past` was `seconds` ago."""

    input: str
    past: str
    seconds: Expr
    source: flat.Equation  # where it stands


def split(model: flat.FlatModel) -> tuple[flat.FlatModel, list[Delay]]:
    """The model with inputs in the place of delays."""
    splitter = _Splitter(model, _places(model))
    rewriter = Rewriter(splitter.replacement)
    splitter.inner = rewriter.expression
    rewritten = rewriter.model(model)
    if not splitter.delays:
        return rewritten, []
    starts = [e.start and tuple(map(rewriter.expression, e.start)) for e in model.equations]
    equations = [replace(e, start=s) for e, s in zip(rewritten.equations, starts, strict=True)]
    return replace(
        rewritten,
        variables={**rewritten.variables, **splitter.variables},
        equations=equations + splitter.equations,
        asserts=rewritten.asserts + splitter.asserts,
    ), splitter.delays


def _places(model: flat.FlatModel) -> dict[Expr, Span]:
    """Of each delay the first equation that has it."""
    sides = [(e, side) for e in reversed(model.equations) for side in (e.lhs, e.rhs)]
    return {n: e.span for e, side in sides if holds(side, _is_delay) for n in walk(side) if n.op == "delay"}


def _is_delay(e: Expr) -> bool:
    return e.op == "delay"


class _Splitter:
    def __init__(self, model: flat.FlatModel, places: dict[Expr, Span]) -> None:
        self._model, self._places = model, places
        self.inner = lambda e: e
        self.delays: list[Delay] = []
        self.asserts: list[flat.Assert] = []
        self.variables: dict[str, flat.Variable] = {}
        self.equations: list[flat.Equation] = []

    def replacement(self, n: Expr) -> Expr | None:
        if n.op != "delay":
            return None
        value, seconds, longest = n.args
        if is_parametric(value, self._model.variables):
            return self.inner(value)
        if not is_parametric(seconds, self._model.variables):
            hint = "give delayTime as a parameter"
            raise Diagnostic(
                "R091", f"{to_text(n)}: a time that varies is outside the subset", self._places.get(n), hint
            )
        value, text = self.inner(value), f"delay({to_text(value)}, {to_text(seconds)})"
        while f"past of {text}" in self.variables:  # a text that was cut, or another delayMax
            text += "'"
        past, source, delayed = (f"{what} of {text}" for what in ("past", "source", "value"))
        span = self._places.get(n, self._model.span)
        self.variables |= {
            past: flat.Variable(past, span), delayed: flat.Variable(delayed, span),
            source: flat.Variable(source, span, causality="input"),
        }  # fmt: skip
        if longest is not seconds:
            message = f"{text}: delayTime is longer than delayMax"
            self.asserts.append(flat.Assert(relation("<=", seconds, longest), message, span))
        at_start = (var(delayed), var(past))
        found = flat.Equation(var(delayed), var(source), span, "", f"{delayed} = {text}", at_start)
        self.equations += [flat.Equation(var(past), value, span, "", f"{past} = {to_text(value)}"), found]
        self.delays.append(Delay(source, past, seconds, found))
        return var(delayed)
