"""How closely the guards of state events have to be looked at inside a step.

A guard that is affine in states, time and inputs does what the step's polynomial does. One that follows sin or cos of
something crosses again and again while the states themselves hardly bend (a Hall sensor on a coasting rotor, a source
of 50 Hz): the arguments of sin and cos are its phases, and the looks are taken by them. Any other guard is curved:
nothing tells how fast it may come and go.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from lacuna.codegen import flat
from lacuna.codegen.dae.relations import Relation
from lacuna.codegen.structure.causal import (  # fmt: skip
    Assignment,
    Division,
    LinearBlock,
    NonlinearBlock,
    Step,
    expressions_of,
    unknowns_of,
)
from lacuna.codegen.symbolic.expr import ZERO, Expr, add, is_const, node, sub, walk
from lacuna.codegen.symbolic.leaves import leaves

FIXED, SMOOTH, CURVED = range(3)  # between events: constant, as smooth as the states, or anything
PERIODIC = ("sin", "cos", "tan")


@dataclass(frozen=True)
class GuardShapes:
    """`phases`: expressions at a complete point, each once, up to what is constant in it (rad)."""

    phases: list[Expr]
    curved: bool


def guard_shapes(steps: Sequence[Step], relations: Iterable[Relation], model: flat.FlatModel) -> GuardShapes:
    """Of the guards that are switched by roots."""
    guards = [sub(r.left, r.right) for r in relations if r.slope is None]
    shapes = _Shapes(model)
    for step in steps:
        shapes.add(step)
    phases: dict[Expr, None] = {}
    for e in (*guards, *_upstream(steps, guards)):
        for n in walk(e):
            if n.op == "call" and n.value in PERIODIC and shapes.of(n.args[0]) != FIXED:
                phases[shapes.varying_part(n.args[0])] = None
    return GuardShapes(list(phases), any(shapes.of(g) == CURVED for g in guards))


def _upstream(steps: Sequence[Step], guards: Iterable[Expr]) -> Iterator[Expr]:
    """Everything computed on the way from the states to the guards."""
    wanted = {n for g in guards for n in leaves(g)}
    for step in reversed(steps):
        if wanted.isdisjoint(unknowns_of(step)):
            continue
        for e in expressions_of(step):
            wanted |= leaves(e)
            yield e


class _Shapes:
    def __init__(self, model: flat.FlatModel):
        self._variables = model.variables
        self._memo: dict[Expr, int] = {}

    def add(self, step: Step) -> None:
        """The unknowns of the next step of the explicit form."""
        match step:
            case Assignment():
                self._memo[step.unknown] = self.of(step.value)
                return
            case Division():
                self._memo[step.unknown] = self.of(node("/", (step.numerator, step.denominator)))
                return
            case LinearBlock():
                fixed = all(self.of(a) == FIXED for line in step.matrix for a in line)
                shape = max((self.of(b) for b in step.right), default=FIXED) if fixed else CURVED
            case NonlinearBlock():
                own = set(unknowns_of(step))
                given = {n for row in step.residuals for n in row.leaves} | {
                    n for a in step.assignments for n in leaves(a.value)
                }
                shape = FIXED if all(self.of(n) == FIXED for n in given - own) else CURVED
        self._memo.update(dict.fromkeys(step.tears, shape))
        for a in step.assignments:
            self._memo[a.unknown] = self.of(a.value)

    def of(self, e: Expr) -> int:
        if e not in self._memo:
            self._memo[e] = self._of(e)
        return self._memo[e]

    def _of(self, e: Expr) -> int:
        match e.op:
            case "var":
                v = self._variables[str(e.value)]
                return SMOOTH if v.type == "Real" and v.variability == flat.CONTINUOUS else FIXED
            case "time" | "der":
                return SMOOTH
            case "noEvent" | "smooth":
                return self.of(e.args[-1])
        shapes = [self.of(a) for a in e.args] or [FIXED]
        bends = {
            "*": shapes.count(FIXED) == 0,
            "/": shapes[-1] != FIXED,
            "^": not is_const(e.args[-1], 1) if e.args else False,
            "if": shapes[0] != FIXED,
            "call": e.value not in PERIODIC or CURVED in shapes,
        }.get(e.op, e.op not in ("+", "-", "neg"))
        return CURVED if bends and max(shapes) != FIXED else max(shapes)

    def varying_part(self, e: Expr) -> Expr:
        """`e` without the terms that are constant between events: phases a constant apart are one."""
        if self.of(e) == FIXED:
            return ZERO
        if e.op == "neg":
            return self.varying_part(e.args[0])  # backwards is as far as forwards
        if e.op == "+":
            return add(*map(self.varying_part, e.args))
        if e.op == "-":
            a, b = map(self.varying_part, e.args)
            return b if is_const(a, 0) else sub(a, b)
        return e
