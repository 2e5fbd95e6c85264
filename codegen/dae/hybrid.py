"""Hybrid analysis: every relation that can switch a continuous equation becomes a frozen Boolean with a root.

    a > b               rel[k], root g = a - b; a < b, a >= b, a <= b share it by exchange and negation
    abs sign min max    if-expressions over such relations, so that a fixed-order method never steps over a corner
    floor ceil integer  a discrete Integer that moves by whole numbers at its two guard relations,
    mod rem div         and from it the others
    sample              tick[k]
    edge change         and / <> with pre

Left as they are (no root): what stands in noEvent or smooth, relations between discrete variables and
parameters only, bodies of when clauses and functions, and what stands under a root (ends.py). New leaves: op "rel"
and "tick" with value k.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from lacuna.codegen import flat
from lacuna.codegen.dae.ends import arguments, ends, is_call, keep_promises, without_corner
from lacuna.codegen.dae.relations import Relation, canonical, complement, within
from lacuna.codegen.symbolic.affine import affine
from lacuna.codegen.symbolic.annotated import plain
from lacuna.codegen.symbolic.expr import (  # fmt: skip
    BOOLEAN,
    INTEGER,
    REAL,
    RELATIONS,
    TIME,
    ZERO,
    Expr,
    add,
    call,
    const,
    div,
    if_else,
    logical_and,
    logical_not,
    maximum,
    minimum,
    mul,
    neg,
    node,
    pre,
    rebuild,
    relation,
    special,
    sub,
    transform,
    var,
)
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import Rewriter


@dataclass
class Hybrid:
    """A flat model whose expressions hold frozen relations, and what they stand for."""

    model: flat.FlatModel
    relations: list[Relation] = field(default_factory=list)
    samples: list[tuple[Expr, Expr]] = field(default_factory=list)


def analyse(model: flat.FlatModel) -> Hybrid:
    """Freeze relations and lower the event-generating operators of `model`."""
    freezer = _Freezer(model)
    equations = [freezer.equation(e) for e in keep_promises(model.equations)]
    whens = [freezer.when(w) for w in model.whens]
    algorithms = [freezer.algorithm(a) for a in model.algorithms]
    freezer.generating = False
    whens = [_bodies(freezer.bodies, w) for w in whens]
    algorithms = [replace(a, statements=freezer.statements(a)) for a in algorithms]
    frozen = replace(
        model,
        variables=freezer.variables,
        equations=equations + freezer.new_equations,
        initial_equations=[freezer.starts.equation(e) for e in model.initial_equations],
        whens=whens,
        algorithms=algorithms,
        asserts=[replace(a, condition=freezer.bare(a.condition)) for a in model.asserts],
    )
    return Hybrid(frozen, freezer.relations, freezer.samples)


def _bodies(rewriter: Rewriter, w: flat.When) -> flat.When:
    return replace(w, branches=[(c, rewriter.statements(b)) for c, b in w.branches])


_OF_EVENTS = ("edge", "change", "sample", "pre")  # what means the same wherever it stands


class _Freezer:
    def __init__(self, model: flat.FlatModel):
        self.variables = dict(model.variables)
        used = (n for e in model.equations for n in leaves(e.lhs) | leaves(e.rhs))
        self._differentiated = {str(n.args[0].value) for n in used if n.op == "der" and n.args[0].op == "var"}
        self._arguments = {v for v in arguments(model.equations) if self._is_algebraic(v)}
        self.relations: list[Relation] = []
        self.samples: list[tuple[Expr, Expr]] = []
        self.new_equations: list[flat.Equation] = []
        self.generating = True  # False: relations known already are frozen, others are evaluated where they stand
        self._source = flat.Equation(ZERO, ZERO, model.span)
        self._memo: dict[Expr, Expr] = {}
        self._memo_under_root: dict[Expr, Expr] = {}  # a root in a root in a root is looked at once,
        self._memo_bare: dict[Expr, Expr] = {}  # and so is a noEvent in a noEvent
        self._numbers: dict[tuple[Expr, Expr], int] = {}
        self._ticks: dict[Expr, int] = {}
        self._floors: dict[Expr, Expr] = {}
        self._written = ZERO  # the call that is being lowered
        self.bodies = Rewriter(self._statement_rule)
        self.starts = Rewriter(self._body_rule)

    # -- where expressions stand ------------------------------------------------------------------------------

    def equation(self, e: flat.Equation) -> flat.Equation:
        self._source = e
        start = (self.freeze(e.start[0]), self.freeze(e.start[1])) if e.start else None
        named = e.lhs in self._arguments or e.rhs in self._arguments  # a name for what stands under a root
        lhs, rhs = map(self._without_corners if named else self.freeze, (e.lhs, e.rhs))
        return replace(e, lhs=lhs, rhs=rhs, start=start)

    def _condition(self, e: Expr, span: flat.Span, origin: str) -> Expr:
        self._source = flat.Equation(ZERO, ZERO, span, origin, f"when {e}")
        return self.freeze(e)

    def when(self, w: flat.When, origin: str | None = None) -> flat.When:
        origin = w.origin if origin is None else origin
        return replace(w, branches=[(self._condition(c, w.span, origin), b) for c, b in w.branches])

    def algorithm(self, a: flat.Algorithm) -> flat.Algorithm:
        """Conditions of when clauses and everything outside them generate events."""
        outside = Rewriter(self._rule)
        self._source = flat.Equation(ZERO, ZERO, a.span, a.origin, "algorithm")
        steps = [self.when(s, a.origin) if isinstance(s, flat.When) else outside.statement(s) for s in a.statements]
        return replace(a, statements=steps)

    def statements(self, a: flat.Algorithm) -> list[flat.Statement]:
        """Those of an algorithm: what compares its own variables in a when-clause does so in their order."""
        rewriter = Rewriter(lambda n: self._statement_rule(n, frozenset(a.targets)))
        return [_bodies(rewriter, s) if isinstance(s, flat.When) else s for s in a.statements]

    def _statement_rule(self, n: Expr, assigned: frozenset[str] = frozenset()) -> Expr | None:
        if n.op in RELATIONS and any(leaf.op == "var" and leaf.value in assigned for leaf in leaves(n)):
            return None
        if n.op == "pre" and self._is_algebraic(n.args[0]):
            return n  # its value on arrival, which equations may change while what they follow is found
        return self._body_rule(n)

    def _body_rule(self, n: Expr) -> Expr | None:
        if n.op in RELATIONS and self._continuous(n):
            left, right, positive = canonical(n)
            number = self._numbers.get((self.freeze(left), self.freeze(right)))
            if number is not None:
                return self._frozen(number, positive)
            return None
        if n.op in ("noEvent", "smooth"):
            return self.bare(n)
        return self._rule(n) if n.op in _OF_EVENTS else None

    # -- rewriting --------------------------------------------------------------------------------------------

    def freeze(self, e: Expr) -> Expr:
        return transform(e, self._rule, self._memo)

    def bare(self, e: Expr) -> Expr:
        """`e` without noEvent and smooth: its relations are evaluated where they stand."""
        return transform(e, self._bare_rule, self._memo_bare)

    def _bare_rule(self, n: Expr) -> Expr | None:
        if n.op in ("noEvent", "smooth"):
            return self.bare(n.args[-1])
        return self._rule(n) if n.op in _OF_EVENTS else None

    def _continuous(self, e: Expr) -> bool:
        return any(self._is_continuous(n) for n in leaves(e))

    def _is_continuous(self, n: Expr) -> bool:
        if n.op == "var":
            v = self.variables[str(n.value)]
            return v.type == REAL and v.variability == flat.CONTINUOUS
        return n.op in ("der", "time")

    def _is_algebraic(self, n: Expr) -> bool:
        """A continuous variable that no equation has the derivative of: the integrator does not carry it."""
        return n.op == "var" and self._is_continuous(n) and str(n.value) not in self._differentiated

    def _rule(self, n: Expr) -> Expr | None:
        if n.op in ("noEvent", "smooth"):
            return self.bare(n)
        if n.op == "edge":
            return logical_and(n.args[0], logical_not(pre(n.args[0])))
        if n.op == "change":
            return relation("<>", n.args[0], pre(n.args[0]))
        if n.op == "sample":
            return self._tick(n)
        if n.op == "pre":  # of a continuous variable: its value on arrival at the event
            return n.args[0] if self._is_continuous(n.args[0]) else None
        if n.op in RELATIONS and n.op not in ("==", "<>") and self._continuous(n):
            left, right, positive = canonical(n)
            left, right = self.freeze(left), self.freeze(right)
            return self._relation(left, right, positive, str(n) if positive else str(complement(n)))
        if ends(n):
            return rebuild(n, tuple(map(self._without_corners, n.args)))
        if n.op in ("*", "/") and (law := without_corner(n, self._is_algebraic)) is not None:
            return self.freeze(law)
        if n.op in ("min", "max") and self._continuous(n):
            a, b = map(self.freeze, n.args)
            left, right = (b, a) if n.op == "max" else (a, b)
            return if_else(self._relation(left, right, False, within(n, left, right)), a, b)
        if n.op == "call" and n.value in _LOWER and self._continuous(n):
            arguments = list(map(self.freeze, n.args))
            self._written = n
            return _LOWER[str(n.value)](self, *arguments)
        return None

    def _without_corners(self, e: Expr) -> Expr:
        return transform(e, self._under_root, self._memo_under_root)

    def _under_root(self, n: Expr) -> Expr | None:
        return None if n.op in ("min", "max") or is_call(n, "abs") else self._rule(n)

    def _relation(self, left: Expr, right: Expr, positive: bool, text: str = "") -> Expr:
        if left.op == right.op == "const":
            return const((left.value > right.value) == positive)
        number = self._numbers.get((left, right))
        if number is None:
            if not self.generating:
                holds = relation(">", left, right)
                return holds if positive else logical_not(holds)
            number = self._numbers[left, right] = len(self.relations)
            text = text or within(self._written, left, right)
            slope = self._slope(left, right)
            self.relations.append(Relation(plain(left), plain(right), self._source, slope, text))
        return self._frozen(number, positive)

    def _frozen(self, number: int, positive: bool) -> Expr:
        frozen = node("rel", (), number, BOOLEAN)
        return frozen if positive else logical_not(frozen)

    def _slope(self, left: Expr, right: Expr) -> Expr | None:
        difference = sub(left, right)
        if any(self._is_continuous(n) and n is not TIME for n in leaves(difference)):
            return None
        parts = affine(difference, TIME)
        return parts[0] if parts else None

    def _tick(self, n: Expr) -> Expr:
        if n not in self._ticks:
            self._ticks[n] = len(self.samples)
            self.samples.append((n.args[0], n.args[1]))
        return node("tick", (), self._ticks[n], BOOLEAN)

    # -- operators that jump ----------------------------------------------------------------------------------

    def floor(self, x: Expr) -> Expr:
        if x in self._floors:
            return self._floors[x]
        if not self.generating:
            return call("floor", x)
        name = f"$floor{len(self._floors) + 1}"
        n = var(name, INTEGER)
        self.variables[name] = flat.Variable(
            name, self._source.span, INTEGER, flat.DISCRETE, description="whole part kept between events"
        )
        above = self._relation(add(pre(n), const(1)), x, False, f"{self._written} has not risen")
        below = self._relation(pre(n), x, True, f"{self._written} has fallen")
        whole = call("integer", x)
        value = if_else(below, minimum(sub(pre(n), const(1)), whole), pre(n))
        value = if_else(above, maximum(add(pre(n), const(1)), whole), value)
        value = if_else(special("initial"), whole, value)
        self.new_equations.append(replace(self._source, lhs=n, rhs=value))
        self._floors[x] = n
        return n

    def ceil(self, x: Expr) -> Expr:
        return neg(self.floor(neg(x)))

    def mod(self, x: Expr, y: Expr) -> Expr:
        return sub(x, mul(self.floor(div(x, y)), y))

    def quotient(self, x: Expr, y: Expr) -> Expr:
        ratio = div(x, y)
        return if_else(self._relation(ZERO, ratio, False), self.floor(ratio), self.ceil(ratio))

    def remainder(self, x: Expr, y: Expr) -> Expr:
        return sub(x, mul(self.quotient(x, y), y))

    def abs(self, x: Expr) -> Expr:
        return if_else(self._relation(ZERO, x, False), x, neg(x))

    def sign(self, x: Expr) -> Expr:
        negative = if_else(self._relation(ZERO, x, True), const(-1), const(0))
        return if_else(self._relation(x, ZERO, True), const(1), negative)


_LOWER = {
    "floor": _Freezer.floor, "integer": _Freezer.floor, "ceil": _Freezer.ceil, "mod": _Freezer.mod,
    "rem": _Freezer.remainder, "div": _Freezer.quotient, "abs": _Freezer.abs, "sign": _Freezer.sign,
}  # fmt: skip
