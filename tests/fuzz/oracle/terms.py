"""Terms: a text of the language beside what it is worth, grown at random to a wanted type and shape."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
import math
import operator
import random

import numpy as np

from tests.fuzz.oracle import meaning as m

Shape = tuple[int, ...]
Scope = Mapping[str, m.Value]


@dataclass(frozen=True)
class Kind:
    """R, I, B or E (the enumeration), and the shape of an array of them."""

    base: str
    shape: Shape = ()


@dataclass(frozen=True)
class Term:
    text: str
    worth: Callable[[Scope], m.Value]


def literal(dice: random.Random, base: str) -> Term:
    if base == "B":
        value = dice.random() < 0.5
        return Term("true" if value else "false", lambda _: value)
    if base == "E":
        k = dice.randrange(3)
        return Term(f"E.{'abc'[k]}", lambda _: k + 1)
    if base == "I":
        n = dice.choice((0, 1, 2, 3, 4, 5, 7, -1, -2, -3, -7, 12))
        return Term(f"({n})" if n < 0 else str(n), lambda _: n)
    x = dice.choice((0.0, 0.5, 1.0, 1.5, 2.0, 0.1, 3.25, -1.0, -0.7, 1e-2, 10.0, -2.5))
    return Term(f"({x!r})" if x < 0 else repr(x), lambda _: x)


# text, meaning, kinds of the arguments; scalars. N stands for an Integer or a Real.
_SCALAR: dict[str, list[tuple[str, Callable, str]]] = {
    "R": [
        ("({} + {})", operator.add, "RN"), ("({} - {})", operator.sub, "NR"), ("({}*{})", operator.mul, "RN"),
        ("({}/{})", m.divide, "NN"), ("({}/(1.0 + {}^2))", lambda a, b: a / (1.0 + b**2), "RR"),
        ("(-{})", operator.neg, "R"),
        ("abs({})", abs, "R"), ("sin({})", m.real_function(math.sin), "N"), ("cos({})", m.real_function(math.cos), "N"),
        ("tanh({})", m.real_function(math.tanh), "R"), ("atan({})", m.real_function(math.atan), "R"),
        ("atan2({}, 2.0 + abs({}))", lambda a, b: math.atan2(a, 2.0 + abs(b)), "RR"),
        ("exp(-abs({}))", lambda a: math.exp(-abs(a)), "R"), ("sqrt({})", m.real_function(math.sqrt, 1e-3), "N"),
        ("log({})", m.real_function(math.log, 1e-3), "N"), ("log10({})", m.real_function(math.log10, 1e-3), "R"),
        ("asin({})", m.real_function(math.asin, -0.99, 0.99), "R"),
        ("sinh({})", m.real_function(math.sinh, -9, 9), "R"),
        ("({}^2)", lambda a: float(a) ** 2, "R"), ("({}^3)", lambda a: float(a) ** 3, "N"),
        ("({}^(-1))", lambda a: m.power(a, -1), "N"),
        ("({}^0.5)", lambda a: m.power(a, 0.5), "R"), ("({}^{})", m.power, "Ri"),
        ("min({}, {})", min, "RN"), ("max({}, {})", max, "NR"),
        ("mod({}, {})", m.of_quotient(math.floor, True), "RN"), ("rem({}, {})", m.of_quotient(math.trunc, True), "RN"),
        ("div({}, {})", m.of_quotient(math.trunc, False), "RN"), ("floor({})", m.rounded(math.floor), "R"),
        ("ceil({})", m.rounded(math.ceil), "R"), ("noEvent({})", lambda a: a, "R"), ("smooth(0, {})", lambda a: a, "R"),
        ("(if {} then {} else {})", lambda c, a, b: a if c else b, "BRN"),
        ("(if {} then {} elseif {} then {} else {})", lambda c, a, d, b, e: a if c else b if d else e, "BRBNR"),
    ],
    "I": [
        ("({} + {})", operator.add, "II"), ("({} - {})", operator.sub, "II"), ("({}*{})", operator.mul, "II"),
        ("(-{})", operator.neg, "I"), ("abs({})", abs, "I"), ("sign({})", m.sign, "N"),
        ("integer({})", m.to_integer, "R"),
        ("mod({}, {})", m.of_quotient(math.floor, True), "II"), ("rem({}, {})", m.of_quotient(math.trunc, True), "II"),
        ("div({}, {})", m.of_quotient(math.trunc, False), "II"), ("min({}, {})", min, "II"), ("max({}, {})", max, "II"),
        ("(if {} then {} else {})", lambda c, a, b: a if c else b, "BII"), ("Integer({})", int, "E"),
    ],
    "B": [
        ("({} > {})", m.relation(operator.gt), "NN"), ("({} < {})", m.relation(operator.lt), "NN"),
        ("({} >= {})", m.relation(operator.ge), "NN"), ("({} <= {})", m.relation(operator.le), "NN"),
        ("({} == {})", m.relation(operator.eq), "II"), ("({} <> {})", m.relation(operator.ne), "II"),
        ("({} == {})", operator.eq, "EE"), ("({} <> {})", operator.ne, "EE"), ("({} > {})", operator.gt, "EE"),
        ("({} <= {})", operator.le, "EE"), ("({} == {})", operator.eq, "BB"), ("({} <> {})", operator.ne, "BB"),
        ("({} and {})", lambda a, b: a and b, "BB"), ("({} or {})", lambda a, b: a or b, "BB"),
        ("(not {})", operator.not_, "B"),
        ("(if {} then {} else {})", lambda c, a, b: a if c else b, "BBB"),
    ],
    "E": [("(if {} then {} else {})", lambda c, a, b: a if c else b, "BEE")],
}  # fmt: skip


class Growth:
    """Grows terms over `names`, the kinds of what is in scope."""

    def __init__(self, dice: random.Random, names: Mapping[str, Kind]) -> None:
        self.dice, self.names = dice, dict(names)

    def grow(self, kind: Kind, depth: int = 0) -> Term:
        if kind.shape:
            from tests.fuzz.oracle.arrays import grow_array

            return grow_array(self, kind, depth)
        if depth > 3 or self.dice.random() < 0.1 + 0.1 * depth:
            return self.leaf(kind)
        if kind.base in "RI" and self.dice.random() < 0.2:
            from tests.fuzz.oracle.arrays import grow_reduction

            return grow_reduction(self, kind, depth)
        text, meaning, wants = self.dice.choice(_SCALAR[kind.base])
        parts = [self._argument(want, depth + 1) for want in wants]
        return apply(text, meaning, parts, kind.base)

    def _argument(self, want: str, depth: int) -> Term:
        if want == "i":  # a whole exponent
            n = self.dice.choice((0, 1, 2, 3, -1, -2))
            return Term(f"({n})" if n < 0 else str(n), lambda _: n)
        base = self.dice.choice("RRI") if want == "N" else want
        return self.grow(Kind(base), depth)

    def leaf(self, kind: Kind) -> Term:
        found = [n for n, k in self.names.items() if k == kind]
        if found and self.dice.random() < 0.75:
            name = self.dice.choice(found)
            return Term(name, lambda scope: scope[name])
        return literal(self.dice, kind.base)


def apply(text: str, meaning: Callable, parts: list[Term], base: str) -> Term:
    def worth(scope: Scope) -> m.Value:
        return m.checked(m.as_kind(meaning(*(p.worth(scope) for p in parts)), base))

    return Term(text.format(*(p.text for p in parts)), worth)


def value_of(term: Term, scope: Scope) -> tuple[m.Value, bool]:
    """What it is worth, and whether it was close to switching. Raises Unfit."""
    with m.watched() as watch, np.errstate(all="ignore"):
        try:
            return term.worth(scope), watch.close
        except (OverflowError, ZeroDivisionError, ValueError, RecursionError) as error:
            raise m.Unfit from error
