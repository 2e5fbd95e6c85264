"""Array elements inside functions that run at run time: reads of `name[i, j]` with indices known or not."""

from __future__ import annotations

from lacuna.codegen.flatten.names.values import Array, Record, Value, indices
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


def at_index(value: Value, index: Expr, inner: int = 0) -> Value | None:
    """`value` (the first row of an array) with its row number replaced by a run-time `index`; None where it is no
    array of element reads. `inner`: dimensions of what it is a part of, behind that of the rows."""
    if isinstance(value, Record):
        fields = {name: at_index(field, index, inner) for name, field in value.fields.items()}
        return None if None in fields.values() else Record(value.name, fields, value.cls)
    if isinstance(value, Array):
        items = tuple(at_index(item, index, inner + len(value.shape)) for item in value.items)
        return None if None in items else Array(value.shape, items)
    if not isinstance(value, Expr) or value.op != "call" or value.value != "[]":
        return None
    position = len(value.args) - 1 - inner
    if position < 1:  # the rows are records, each field of each a variable of its own
        return None
    return ex.node("call", value.args[:position] + (index,) + value.args[position + 1 :], "[]", value.type)
