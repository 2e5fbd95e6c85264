"""Values of functions whose derivative in time the model gives itself: `annotation(derivative = df)` (12.7.1).

    annotated(value, argument, ...)     value: the key of the rules

is its value to every pass; the arguments are those of the call, scalar by scalar, for the rules alone. From
differentiation on, `plain` leaves the value. Up to the check of units, values may also say what that is to look at.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from lacuna.codegen.symbolic.expr import (
    REAL,
    Expr,
    add,
    const,
    div,
    is_const,
    mul,
    neg,
    node,
    power,
    sub,
    substitute,
    table,
    transform,
)

OP = "annotated"


@dataclass(frozen=True)
class DerivativeRule:
    """The derivative of one scalar result, in terms of what stands for the arguments and for their derivatives.

    It holds where the arguments at the positions `still` do not move (zeroDerivative), and where of each pair in
    `chain` the second is the derivative of the first (order > 1). `rates` has None where no derivative is asked for.
    """

    parameters: tuple[Expr, ...]
    rates: tuple[Expr | None, ...]
    still: tuple[int, ...]
    chain: tuple[tuple[int, int], ...]
    value: Expr | Exception  # why there is none: it is raised where it is asked for

    @property
    def unheard(self) -> frozenset[int]:
        """Positions of the arguments whose derivatives it leaves out though they may move (noDerivative)."""
        pairs = enumerate(zip(self.parameters, self.rates, strict=True))
        return frozenset(k for k, (p, r) in pairs if r is None and p.type == REAL and k not in self.still)


Rules = Mapping[str, Sequence[DerivativeRule]]


def annotated(value: Expr, arguments: Sequence[Expr], key: str) -> Expr:
    return value if is_const(value) else node(OP, (value, *arguments), key, value.type)


def by_rule(e: Expr, rules: Rules, derivative: Callable[[Expr], Expr]) -> Expr | None:
    """The derivative of the annotated `e` by the first rule that holds; None where none does."""
    arguments = e.args[1:]
    for rule in () if tells_units(e) else rules.get(str(e.value), ()):
        if any(derivative(arguments[a]) is not arguments[b] for a, b in rule.chain):
            continue
        if any(not is_const(derivative(arguments[k]), 0) for k in rule.still):
            continue
        if isinstance(rule.value, Exception):
            raise rule.value
        rates = {r: derivative(a) for r, a in zip(rule.rates, arguments, strict=True) if r is not None}
        return substitute(rule.value, dict(zip(rule.parameters, arguments, strict=True)) | rates)
    return None


def in_units(value: Expr, meant: Expr) -> Expr:
    """`value`, of which the check of units looks at `meant`: the same over names that have units, known to it alone."""
    return value if is_const(value) else node(OP, (value,), meant, value.type)


class Measured(float):
    """A number that a function gave which declares its unit, or that was computed from such: a constant to every pass.
    The check of units looks at `meant`, the same over names that have units."""

    meant: Expr

    def __add__(self, other: float) -> float:
        return _computed(add, float(self) + float(other), self, other)

    def __radd__(self, other: float) -> float:
        return _computed(add, float(other) + float(self), other, self)

    def __sub__(self, other: float) -> float:
        return _computed(sub, float(self) - float(other), self, other)

    def __rsub__(self, other: float) -> float:
        return _computed(sub, float(other) - float(self), other, self)

    def __mul__(self, other: float) -> float:
        return _computed(mul, float(self) * float(other), self, other)

    def __rmul__(self, other: float) -> float:
        return _computed(mul, float(other) * float(self), other, self)

    def __truediv__(self, other: float) -> float:
        return _computed(div, float(self) / float(other), self, other)

    def __rtruediv__(self, other: float) -> float:
        return _computed(div, float(other) / float(self), other, self)

    def __pow__(self, other: float) -> float:
        value = float(self) ** float(other)
        return value if isinstance(value, complex) else _computed(power, value, self, other)

    def __neg__(self) -> float:
        return _measured(neg(self.meant))(-float(self))


def _computed(build: Callable[[Expr, Expr], Expr], value: float, a: float, b: float) -> float:
    return _measured(build(*(x.meant if isinstance(x, Measured) else const(x) for x in (a, b))))(value)


def _measured(meant: Expr) -> type[Measured]:
    """A class for each meaning: it keeps their constants apart in the table of expressions."""
    kinds = table().measured
    if meant not in kinds:
        kinds[meant] = type("Measured", (Measured,), {"meant": meant})
    return kinds[meant]


def measured(value: Expr, meant: Expr) -> Expr:
    """A constant Real of which the check of units looks at `meant`."""
    return const(_measured(meant)(value.value))


def meant_by(e: Expr) -> Expr | None:
    """What a constant with a unit stands for; None for a mere number."""
    return e.value.meant if e.op == "const" and isinstance(e.value, Measured) else None


def number(e: Expr) -> Expr:
    """A constant as a mere number; any other expression as it is."""
    return const(float(e.value)) if meant_by(e) is not None else e


def tells_units(e: Expr) -> bool:
    return e.op == OP and isinstance(e.value, Expr)


def unmarked(e: Expr) -> Expr:
    """`e` without what tells the units of numbers."""

    def without(n: Expr) -> Expr | None:
        return unmarked(n.args[0]) if tells_units(n) else number(n) if meant_by(n) is not None else None

    return transform(e, without, {})


def plain(e: Expr, memo: dict[Expr, Expr] | None = None) -> Expr:
    """`e` with values alone in the place of annotated ones."""
    memo = table().plain if memo is None else memo

    def value(n: Expr) -> Expr | None:
        return plain(n.args[0], memo) if n.op == OP else number(n) if meant_by(n) is not None else None

    return transform(e, value, memo)
