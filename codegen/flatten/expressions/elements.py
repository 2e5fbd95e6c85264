"""Array elements inside functions that run at run time: reads of `name[i, j]` with indices known or not."""

from __future__ import annotations

from lacuna.codegen.flatten.names.values import Array, Value, indices, scalars, shape_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr


def element(name: str, kind: str, index: tuple[Expr, ...]) -> Expr:
    """The read of an array element inside a function."""
    return ex.node("call", (ex.var(name, kind), *index), "[]", kind)


def local_value(name: str, kind: str, shape: tuple[int, ...]) -> Value:
    """A local variable as a value: a scalar, or an array of element reads."""
    if not shape:
        return ex.var(name, kind)
    return Array(shape, tuple(element(name, kind, tuple(map(ex.const, i))) for i in indices(shape)))


def at_index(value: Value, index: Expr) -> Value | None:
    """`value` (the first row of an array) with its row number replaced by a run-time `index`; None where it is no
    array of element reads."""

    def moved(item: Expr | str, dimensions: int) -> Expr | None:
        if not isinstance(item, Expr) or item.op != "call" or item.value != "[]":
            return None
        position = len(item.args) - 1 - dimensions
        args = item.args[:position] + (index,) + item.args[position + 1 :]
        return ex.node("call", args, "[]", item.type)

    dimensions = len(shape_of(value))
    items = [moved(item, dimensions) for item in scalars(value)]
    if None in items:
        return None
    return Array(value.shape, tuple(items)) if isinstance(value, Array) else items[0]
