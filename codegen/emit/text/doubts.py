"""Relations whose sides may have no value: a root of what is negative, 0/0, a sum of Integers that is not exact.

C compares such a side nonetheless, and a model would go on as if the relation did not hold. Relations that make events
are looked at as guards; all others note where that happened, in m->unsettled.
"""

from __future__ import annotations

from collections.abc import Callable

from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, REAL, RELATIONS, Expr, is_of_the_model
from lacuna.codegen.symbolic.leaves import LEAF_OPS

_PARTIAL = ("sqrt", "asin", "acos", "log", "log10", "mod", "rem", "div")  # built-ins that not all numbers have


class Doubts:
    """Which relations of one body of C are doubtful.

    `row`, for the message, is asked for where one is: of the equation that is being written, of a function in the table
    of asserts. Variables of a function may have no value either; those of a model are looked at themselves.
    """

    def __init__(self, row: Callable[[], int] | None = None, in_function: bool = False):
        self.row, self._in_function = row, in_function
        self._lacks: dict[Expr, bool] = {}
        self._notes: dict[Expr, bool] = {}

    @property
    def place(self) -> str:
        """Where, as m->unsettled holds it."""
        if self.row is None:
            return "MDL_SOMEWHERE"
        return str(-1 - self.row() if self._in_function else 1 + self.row())

    def of(self, e: Expr) -> bool:
        """Whether `e` is a relation of which a side may be no number."""
        return e.op in RELATIONS and any(self._may_lack_value(a) for a in e.args if a.type != BOOLEAN)

    def inside(self, e: Expr) -> bool:
        """Whether computing `e` may note something."""
        if e.op in LEAF_OPS:
            return False
        if e not in self._notes:
            self._notes[e] = is_of_the_model(e) or self.of(e) or any(map(self.inside, e.args))
        return self._notes[e]

    def _may_lack_value(self, e: Expr) -> bool:
        if e.op in LEAF_OPS:
            return self._in_function and e.op == "var" and e.type == REAL
        if e not in self._lacks:
            self._lacks[e] = _is_partial(e) or any(map(self._may_lack_value, e.args))
        return self._lacks[e]


class _Sure(Doubts):
    def of(self, e: Expr) -> bool:
        return False


SURE = _Sure()  # for what the model does not say: sizes of unknowns, which others stand in for where they are no number


def _is_partial(e: Expr) -> bool:
    """Whether what `e` does to its operands has a value for some of them only."""
    if e.op == "/":
        return e.args[1].op != "const"
    if e.op == "^":
        return e.args[1].op != "const" or e.args[1].value % 1 != 0
    return may_round(e) or is_of_the_model(e) or (e.op == "call" and e.value in _PARTIAL)


def may_round(e: Expr) -> bool:
    """Whether `e` is a sum or a product of Integers that may reach 2^53. One with a constant grows too slowly to get
    there but from near by, a product with one of at most 1 in size not at all."""
    if e.op not in ("+", "-", "*") or any(a.type != INTEGER for a in e.args):
        return False
    return not any(a.op == "const" and (e.op != "*" or abs(a.value) <= 1) for a in e.args)
