"""Partial derivatives of expressions with respect to everything in them that can move, each computed once."""

from __future__ import annotations

from lacuna.codegen.symbolic.differentiate import partial
from lacuna.codegen.symbolic.expr import REAL, Expr, is_const
from lacuna.codegen.symbolic.leaves import leaves

Terms = list[tuple[Expr, Expr]]  # (coefficient, leaf): a derivative as the sum of coefficient times tangent of leaf


class Gradients:
    """`gradients(e)` is the derivative of `e`; `used` collects the leaves that any derivative was taken for."""

    def __init__(self) -> None:
        self._memo: dict[Expr, Terms] = {}
        self.used: set[Expr] = set()

    def __call__(self, e: Expr) -> Terms:
        """The partial derivatives of `e` that are not zero, in a fixed order."""
        if e not in self._memo:
            moving = sorted(filter(_moves, leaves(e)), key=lambda n: (n.op, str(n)))
            found = ((partial(e, n), n) for n in moving)
            self._memo[e] = [(d, n) for d, n in found if not is_const(d, 0)]
            self.used.update(n for _, n in self._memo[e])
        return self._memo[e]

    def coefficients(self) -> list[Expr]:
        """Every coefficient there is."""
        return [d for terms in self._memo.values() for d, _ in terms]


def _moves(n: Expr) -> bool:
    return n.op in ("time", "der") or (n.op in ("var", "pre") and n.type == REAL)
