"""Values of functions whose derivative in time the model gives itself: `annotation(derivative = df)` (12.7.1).

    annotated(value, argument, ...)     value: the key of the rules

is its value to every pass; the arguments are those of the call, scalar by scalar, for the rules alone. From
differentiation on, `plain` leaves the value. Up to the check of units, values may also say what that is to look at.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from lacuna.codegen.symbolic.expr import REAL, Expr, const, is_const, node, substitute, table, transform

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
    """A number that a function gave which declares its unit: a constant to every pass, with a unit for their check."""

    unit, source = "", ""


@lru_cache(maxsize=1024)
def _measured(unit: str, source: str) -> type[Measured]:
    """A class for each unit: it keeps their constants apart in the table of expressions."""
    return type("Measured", (Measured,), {"unit": unit, "source": source})


def measured(value: Expr, unit: str, source: str) -> Expr:
    """A constant Real with its unit, and what gave it."""
    return const(_measured(unit, source)(value.value))


def unit_of_number(e: Expr) -> str:
    """The unit that a constant has, "" for a mere number."""
    return e.value.unit if e.op == "const" and isinstance(e.value, Measured) else ""


def number(e: Expr) -> Expr:
    """A constant as a mere number; any other expression as it is."""
    return const(float(e.value)) if unit_of_number(e) else e


def tells_units(e: Expr) -> bool:
    return e.op == OP and isinstance(e.value, Expr)


def unmarked(e: Expr) -> Expr:
    """`e` without what tells the units of numbers."""

    def without(n: Expr) -> Expr | None:
        return unmarked(n.args[0]) if tells_units(n) else number(n) if unit_of_number(n) else None

    return transform(e, without, {})


def plain(e: Expr, memo: dict[Expr, Expr] | None = None) -> Expr:
    """`e` with values alone in the place of annotated ones."""
    memo = table().plain if memo is None else memo

    def value(n: Expr) -> Expr | None:
        return plain(n.args[0], memo) if n.op == OP else number(n) if unit_of_number(n) else None

    return transform(e, value, memo)
