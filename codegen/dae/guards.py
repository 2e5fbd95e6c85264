"""How closely the guards of state events have to be looked at inside a step.

A guard that is affine in states and time is a polynomial in time as they are, and `moving` says which: from the
polynomials of the states, by the same steps without what is constant between events. One that reads inputs is as smooth
as they are. One that follows sin or cos of something crosses again and again while the states themselves hardly bend
(a Hall sensor on a coasting rotor, a source of 50 Hz): the arguments of sin and cos are its phases, and the looks are
taken by them. Any other guard is curved: nothing tells how fast it may come and go.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

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
    upstream,
)
from lacuna.codegen.symbolic.differentiate import Differentiator
from lacuna.codegen.symbolic.expr import ZERO, Expr, add, is_const, node, sub, walk
from lacuna.codegen.symbolic.leaves import leaves

FIXED, AFFINE, SMOOTH, CURVED = range(4)  # between events: constant, affine, as smooth as the states, or anything
PERIODIC = ("sin", "cos", "tan")


@dataclass(frozen=True)
class GuardShapes:
    """`phases`: expressions at a complete point, each once, up to what is constant in it (rad). `moving`: by number of
    their relation, affine guards as far as they move, computed by `steps` from states and time that stand for rates."""

    phases: list[Expr]
    curved: bool
    moving: dict[int, Expr] = field(default_factory=dict)
    steps: list[Step] = field(default_factory=list)


def guard_shapes(
    steps: Sequence[Step], relations: Iterable[Relation], model: flat.FlatModel, states: Iterable[str]
) -> GuardShapes:
    """Of the guards that are switched by roots."""
    by_number = {k: sub(r.left, r.right) for k, r in enumerate(relations) if r.slope is None}
    guards = list(by_number.values())
    shapes = _Shapes(model, states)
    for step in steps:
        shapes.add(step)
    phases: dict[Expr, None] = {}
    for e in (
        *guards,
        *(e for step in upstream(steps, (n for g in guards for n in leaves(g))) for e in expressions_of(step)),
    ):
        for n in walk(e):
            if n.op == "call" and n.value in PERIODIC and shapes.of(n.args[0]) != FIXED:
                phases[shapes.varying_part(n.args[0])] = None
    moving = {k: shapes.moving(g) for k, g in by_number.items() if shapes.of(g) == AFFINE}
    return GuardShapes(
        list(phases), any(shapes.of(g) == CURVED for g in guards), moving, shapes.moving_steps(steps, moving.values())
    )


class _Shapes:
    def __init__(self, model: flat.FlatModel, states: Iterable[str]):
        self._variables, self._states = model.variables, set(states)
        self._memo: dict[Expr, int] = {}
        self.moving = Differentiator(lambda n: n if self.of(n) != FIXED else ZERO)

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
                if v.name in self._states:
                    return AFFINE
                return SMOOTH if v.type == "Real" and v.variability == flat.CONTINUOUS else FIXED
            case "time":
                return AFFINE
            case "der":
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
        if max(shapes) == FIXED:
            return FIXED
        return CURVED if bends else max(SMOOTH, *shapes) if e.op == "call" else max(shapes)

    def moving_steps(self, steps: Sequence[Step], guards: Iterable[Expr]) -> list[Step]:
        """What the moving parts of these guards need of the steps, with everything that does not move left out."""
        wanted, found = {n for g in guards for n in leaves(g)}, []
        for step in reversed(steps):
            if wanted.isdisjoint(u for u in unknowns_of(step) if self.of(u) != FIXED):
                continue
            found.append(self._moving_step(step, wanted))
            wanted |= {n for e in expressions_of(found[-1]) for n in leaves(e)}
        return found[::-1]

    def _moving_step(self, step: Step, wanted: set[Expr]) -> Step:
        match step:
            case Assignment():
                return replace(step, value=self.moving(step.value))
            case Division():
                return replace(step, numerator=self.moving(step.numerator))
        chain: list[Assignment] = []
        for a in reversed(step.assignments):
            if a.unknown in wanted and self.of(a.unknown) != FIXED:
                chain.append(self._moving_step(a, wanted))
                wanted |= leaves(chain[-1].value)
        return replace(step, right=[self.moving(b) for b in step.right], assignments=chain[::-1])

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
