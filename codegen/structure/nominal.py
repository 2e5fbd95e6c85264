"""Nominal values: the size that each variable has by what the model says, so that no tolerance has a scale of its own.

In this order, for each continuous variable:

1. its declared `nominal`, else the size of its start value where that is not zero;
2. the balance of an equation: the largest of its terms whose size is known is as large as the terms in which one
   thing is unknown, so that V = R i + k w gives i = V/R and w = V/k, and a relation x > limit gives x = limit.
   Parameters have the size of their values, sin and cos 1, and first of all what stands in them has. Of several
   balances the smallest counts. What is found serves in the next round. Where a round finds nothing, sums inside
   products are looked at, then numbers that stand as terms (a threshold of 1e-6 says less than a parameter, but more
   than nothing: the size at least, which a run may show to be larger). A relation with a limit makes a size smaller
   than the equations alone do, never larger. A limit in min and max, or in a branch that its condition compares with,
   counts only beside other limits;
3. then the length of the experiment links a variable and its derivative;
4. an angle (unit rad) without a declared nominal has size 1, at which it acts, however many turns it makes and however
   small a play is that it is compared with;
5. else none: the runtime takes the size at the start of the run, and 1 in the variable's unit where that is zero.

All of it is products, quotients and powers of what the model gives: in other units the nominal value is the same
quantity. It is an expression in the parameters, computed for the values of each run.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import reduce

from lacuna.codegen import flat
from lacuna.codegen.dae.operators.delays import Delay
from lacuna.codegen.structure.sizes import Size, combined, largest, named, raised, sized
from lacuna.codegen.structure.system import DeclaredValues, System
from lacuna.codegen.symbolic.expr import BOOLEAN, ONE, ZERO, Expr, add, call, const, der, is_const, var, walk
from lacuna.codegen.symbolic.leaves import leaves, parts

BOUNDED = frozenset(("sin", "cos", "tanh", "sign", "asin", "acos", "atan", "atan2"))
ANGLES = frozenset(("sin", "cos", "tan", "tanh", "exp"))  # their argument is of size 1 where they bend
_SUMS = ("+", "-")


def infer(
    system: System, relations: Sequence[tuple[Expr, Expr, str]], delays: Sequence[Delay] = ()
) -> dict[Expr, Size]:  # fmt: skip
    """Sizes by variable and derivative. `relations`: (left, right, where), each compares two quantities of one size.
    `delays`: what was is as large as what is.

    A limit may lie far beyond what a quantity ever reaches (one that is switched off, 1e60): what the equations alone
    make of a size, or 1 where they make nothing, limits make smaller, never larger. What is compared with another
    variable is no limit: the potential of an open leg with that of a rail."""
    sizes = _balanced(system, relations, delays, False)
    for e, size in _balanced(system, relations, delays, True).items() if relations else ():
        if size.smaller(sizes[e]) if e in sizes else size.value < 1:
            sizes[e] = size
    return {e: _angle(size, e, system.model) for e, size in sizes.items()}


def _balanced(
    system: System, relations: Sequence[tuple[Expr, Expr, str]], delays: Sequence[Delay], count: bool
) -> dict[Expr, Size]:  # fmt: skip
    """`count`: limits are balances, too."""
    balances = [(row.lhs, row.rhs, f"line {row.source.span.line}") for row in system.rows]
    balances += [(var(d.input), var(d.past), d.input) for d in delays]
    for left, right, where in relations:
        if count or (_varies(left, system.model) and _varies(right, system.model)):
            balances.append((left, right, where) if count else (_quantities(left), _quantities(right), where))
    inference = _Inference(system.model, [b for b in balances if BOOLEAN not in (b[0].type, b[1].type)], relations)
    inference.seed(system)
    span = abs(system.model.experiment.stop_time - system.model.experiment.start_time) or 1.0
    while inference.balance() or inference.link(system.states, span):
        pass
    return inference.sizes


def _varies(e: Expr, model: flat.FlatModel) -> bool:
    return any(n.op == "var" and model.variables[str(n.value)].variability == flat.CONTINUOUS for n in leaves(e))


def _quantities(e: Expr) -> Expr:
    """Without numbers that stand as terms: a threshold of a microvolt beside a rail's potential is no size."""
    return reduce(add, (t for t in _terms(e) if t.op != "const"))


def difference(left: Expr, right: Expr, sizes: dict[Expr, Size], model: flat.FlatModel) -> Size | None:
    """The size of a guard, left - right. One of angles has size 1 rad: what it compares are often differences of angles
    of many turns, whose rounding does not know how small a play between them is."""
    compared = [
        n for n in leaves(left) | leaves(right) if n.op == "var" and model.variables[str(n.value)].type == "Real"
    ]
    if compared and all(_is_angle(n, model) for n in compared):
        return Size(ONE, 1.0, "an angle")
    inference = _Inference(model, [], [])
    inference.sizes = sizes
    return largest([s for s in (inference.size(left), inference.size(right)) if s])


def _angle(size: Size, e: Expr, model: flat.FlatModel) -> Size:
    """An angle acts at 1 rad, however many turns it makes and however small a play is that it is compared with."""
    told = _is_angle(e, model) and size.reason != "declared"
    return Size(ONE, 1.0, "an angle") if told else size


def _is_angle(e: Expr, model: flat.FlatModel) -> bool:
    return e.op == "var" and model.variables[str(e.value)].unit == "rad"


class _Inference:
    def __init__(
        self,
        model: flat.FlatModel,
        balances: Sequence[tuple[Expr, Expr, str]],
        relations: Sequence[tuple[Expr, Expr, str]],
    ):
        self.sizes: dict[Expr, Size] = {}
        self._model, self._balances, self._relations = model, balances, relations
        self._values = DeclaredValues(model)
        self._memo: dict[Expr, Size | None] = {}
        self._found: dict[Expr, Size] = {}
        self._numbers = False  # whether a number that stands as a term has a size
        self._modest = False  # whether one has: what is found then is found by it
        sums = ((self._whole, False), (self._inside, False), (self._whole, True), (self._inside, True))
        self._looks = ((self._angles, False), *sums)  # each with whether numbers count
        self._pending = [dict.fromkeys(range(len(balances))) for _ in self._looks]  # balances that may tell more
        self._users: dict[Expr, list[int]] = {}
        for k, (left, right, _) in enumerate(balances):
            for n in leaves(left) | leaves(right):
                self._users.setdefault(n, []).append(k)

    def seed(self, system: System) -> None:
        for name in (*system.states, *system.algebraics):
            v = self._model.variables[name]
            for given, reason in ((v.nominal, "declared"), (v.start, "start value")):
                size = self._parametric(given, reason) if given is not None else None
                if size is not None:
                    self.sizes[var(name)] = size
                    break

    def _parametric(self, e: Expr, reason: str = "") -> Size | None:
        value = self._values.parametric(e)
        return sized(call("abs", e), abs(value), reason) if value is not None else None

    # -- the size of an expression ----------------------------------------------------------------------------

    def size(self, e: Expr) -> Size | None:
        """None where it is not known."""
        if e not in self._memo:
            self._memo[e] = self._size(e)
        return self._memo[e]

    def _size(self, e: Expr) -> Size | None:
        known = self.sizes.get(e)
        if known is not None or e.op in ("var", "der", "pre", "const", "time"):
            return known or (self._leaf(e))
        if e.op in _SUMS:
            return largest([s for a in e.args if (s := self.size(a))])
        if e.op in ("min", "max", "if"):
            return self._choice(e)
        if e.op == "call" and e.value in BOUNDED:
            return Size(ONE, 1.0)
        if e.op == "neg" or (e.op == "call" and e.value == "abs"):
            return self.size(e.args[0])
        if e.op == "call" and e.value == "sqrt":
            return raised(self.size(e.args[0]), const(0.5))
        if e.op == "^" and is_const(e.args[1]):
            return raised(self.size(e.args[0]), e.args[1])
        if e.op in ("*", "/"):
            return combined(e.op, self.size(e.args[0]), self.size(e.args[1]))
        return None

    def _choice(self, e: Expr) -> Size | None:
        """The largest of what may be chosen, but for limits: numbers that what else may be chosen is compared with."""
        values = [a for a in (e.args[1:] if e.op == "if" else e.args) if a != ZERO]
        compared = set(leaves(e.args[0])) if e.op == "if" else set()
        for n in [n for n in compared if n.op == "rel" and int(n.value) < len(self._relations)]:
            compared.update(*(walk(side) for side in self._relations[int(n.value)][:2]))
        limits = [
            a
            for a in values
            if self._values.parametric(a) is not None
            and (e.op != "if" or a in compared or (leaves(a) and leaves(a) <= compared))
        ]
        counted = limits if len(limits) == len(values) else [a for a in values if a not in limits]
        return largest([s for a in counted if (s := self.size(a))])

    def _leaf(self, e: Expr) -> Size | None:
        if e.op == "time":
            end = max(abs(self._model.experiment.stop_time), abs(self._model.experiment.start_time))
            return sized(const(end), end)
        if e.op == "pre":
            e = e.args[0]
        if e.op == "var" and self._model.variables[str(e.value)].type != "Real":
            return None
        return self._parametric(e) if e.op in ("var", "const") else None

    # -- balances ---------------------------------------------------------------------------------------------

    def balance(self) -> bool:
        """One round of balances, of the first kind that finds anything; whether one did."""
        for (look, numbers), pending in zip(self._looks, self._pending, strict=True):
            self._numbers = numbers
            self._memo, self._found = {}, {}
            for k in sorted(pending):
                look(*self._balances[k])
            pending.clear()
            if self._found:
                self._accept(self._found)
                self._modest |= numbers
                return True
        return False

    def _accept(self, found: dict[Expr, Size]) -> None:
        self.sizes.update(found)
        for e in found:
            for pending in self._pending:
                pending.update(dict.fromkeys(self._users.get(e, ())))

    def _whole(self, left: Expr, right: Expr, where: str) -> None:
        self._sum([*_terms(left), *_terms(right)], where)

    def _angles(self, left: Expr, right: Expr, where: str) -> None:
        for n in (*walk(left), *walk(right)):
            if n.op == "call" and n.value in ANGLES and self.size(n.args[0]) is None:
                self._assign(n.args[0], Size(ONE, 1.0, where))

    def _inside(self, left: Expr, right: Expr, where: str) -> None:
        for n in (*walk(left), *walk(right)):
            if n.op in _SUMS:
                self._sum(list(_terms(n)), where)

    def _sum(self, terms: Sequence[Expr], where: str) -> None:
        counted = [t for t in terms if self._numbers or t.op != "const"]
        most = largest([s for t in counted if (s := self.size(t))])
        for t in terms if most else ():
            if self.size(t) is None:
                self._assign(t, named(most, where))

    def _assign(self, e: Expr, size: Size | None) -> None:
        """What is unknown in `e` is such that `e` has this size."""
        if size is None:
            return
        if e.op in ("var", "der"):
            best, size = self._found.get(e), replace(size, at_least=self._numbers or self._modest)
            if e not in self.sizes and self._is_continuous(e) and (best is None or size.smaller(best)):
                self._found[e] = size
        elif e.op == "neg" or (e.op == "call" and e.value == "abs"):
            self._assign(e.args[0], size)
        elif e.op == "if":
            for a in e.args[1:]:
                if self.size(a) is None:
                    self._assign(a, size)
        elif e.op in ("*", "/"):
            self._factor(e, size)
        elif e.op == "^" and is_const(e.args[1]) and e.args[1].value != 0:
            self._assign(e.args[0], named(raised(size, const(1 / e.args[1].value)), size.reason))
        elif e.op in _SUMS:
            for t in _terms(e):
                if self.size(t) is None:
                    self._assign(t, size)

    def _factor(self, e: Expr, size: Size) -> None:
        a, b = e.args
        known_a, known_b = self.size(a), self.size(b)
        if known_b is not None and known_a is None:
            self._assign(a, named(combined("/" if e.op == "*" else "*", size, known_b), size.reason))
        elif known_a is not None and known_b is None:
            pair = (size, known_a) if e.op == "*" else (known_a, size)
            self._assign(b, named(combined("/", *pair), size.reason))

    def _is_continuous(self, e: Expr) -> bool:
        v = self._model.variables[str((e.args[0] if e.op == "der" else e).value)]
        return v.type == "Real" and v.variability == flat.CONTINUOUS

    def link(self, states: Iterable[str], span: float) -> bool:
        """States of which only the value or only the derivative has a size get the other one; an angle has one."""
        found = {}
        for x in map(var, states):
            rate = der(x)
            if x not in self.sizes and rate not in self.sizes and _is_angle(x, self._model):
                found[x] = Size(ONE, 1.0, "an angle")
            if (x in self.sizes) != (rate in self.sizes):
                known, unknown = (x, rate) if x in self.sizes else (rate, x)
                size = combined("*" if unknown is x else "/", self.sizes[known], Size(const(span), span))
                if size is not None:
                    found[unknown] = named(size, "length of the experiment")
        self._accept(found)
        return bool(found)


def _terms(e: Expr) -> list[Expr]:
    return [t for t in parts(e, (*_SUMS, "neg")) if t.op != "const" or t.value != 0]
