"""spatialDistribution(in0, in1, x, positiveVelocity, points, values): what a pipe carries (Modelica 3.6, 3.7.4.2).

Up to `split` each of its two results is an expression. Then the runtime keeps what is in the pipe, and

    out0 = if positiveVelocity then in0 else carried(k, 0, x)
    out1 = if positiveVelocity then carried(k, 1, x) else in1

`carried` asks the runtime for what is at an end when the position is x. Two inputs tell the positions at which the next
jump or bend of the contents comes to an end; passing one is an event.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from lacuna.codegen import flat
from lacuna.codegen.symbolic.expr import (
    BOOLEAN,
    ONE,
    REAL,
    ZERO,
    Expr,
    const,
    if_else,
    logical_or,
    relation,
    special,
    to_text,
    var,
)
from lacuna.codegen.symbolic.rewrite import Rewriter

OPERATOR = "spatialDistribution"
BEFORE = 5  # arguments before the initial points: which result, in0, in1, x, positiveVelocity


@dataclass(frozen=True)
class Transport:
    """Variables for in0, in1, x and the direction, the inputs for the next events above and below, and the start."""

    now: tuple[str, str, str, str]
    marks: tuple[str, str]
    points: tuple[Expr, ...]
    values: tuple[Expr, ...]


def split(model: flat.FlatModel) -> tuple[flat.FlatModel, list[Transport]]:
    """The model with what the runtime carries in the place of the operator."""
    splitter = _Splitter(model)
    rewriter = Rewriter(splitter.replacement)
    splitter.inner = rewriter.expression
    rewritten = rewriter.model(model)
    return replace(
        rewritten, variables={**rewritten.variables, **splitter.variables},
        equations=rewritten.equations + splitter.equations,
    ), splitter.transports  # fmt: skip


class _Splitter:
    def __init__(self, model: flat.FlatModel):
        self._model = model
        self.inner = lambda e: e
        self.transports: list[Transport] = []
        self.variables: dict[str, flat.Variable] = {}
        self.equations: list[flat.Equation] = []
        self._results: dict[tuple[Expr, ...], tuple[Expr, Expr]] = {}

    def replacement(self, n: Expr) -> Expr | None:
        if n.op != OPERATOR:
            return None
        which, *arguments = n.args
        key = tuple(arguments)
        if key not in self._results:
            self._results[key] = self._carried(key)
        return self._results[key][int(which.value)]

    def _carried(self, arguments: tuple[Expr, ...]) -> tuple[Expr, Expr]:
        k, count = len(self.transports), (len(arguments) - BEFORE + 1) // 2
        moved, given = [self.inner(a) for a in arguments[: BEFORE - 1]], arguments[BEFORE - 1 :]
        points, values = given[:count], given[count:]
        text = f"{OPERATOR} number {k + 1}"
        in0, in1, x, forward = (
            self._variable(f"{what} of {text}", value)
            for what, value in zip(("in0", "in1", "x", "positiveVelocity"), moved, strict=True)
        )
        above, below = (self._input(f"next {way} of {text}") for way in ("above", "below"))
        self._variable(f"arrival of {text}", logical_or(relation(">=", x, above), relation("<=", x, below)))
        out = []
        for end, given_there, held, is_in in ((ZERO, in0, values[0], True), (ONE, in1, values[-1], False)):
            carried = special("carried", const(k), end, x, ZERO, type=REAL)
            pair = [(given_there, c) if is_in else (c, given_there) for c in (carried, held)]
            now, at_start = (if_else(forward, *p) for p in pair)
            out.append(self._variable(f"out{end} of {text}", now, at_start))
        names = tuple(str(v.value) for v in (in0, in1, x, forward))
        self.transports.append(Transport(names, (str(above.value), str(below.value)), points, values))
        return out[0], out[1]

    def _variable(self, name: str, value: Expr, at_start: Expr | None = None) -> Expr:
        kind = (BOOLEAN, flat.DISCRETE) if value.type == BOOLEAN else (REAL, flat.CONTINUOUS)
        self.variables[name] = flat.Variable(name, self._model.span, *kind)
        v = var(name, kind[0])
        start = (v, at_start) if at_start is not None else None
        self.equations.append(flat.Equation(v, value, self._model.span, "", f"{name} = {to_text(value)}", start))
        return v

    def _input(self, name: str) -> Expr:
        self.variables[name] = flat.Variable(name, self._model.span, causality="input")
        return var(name)
