"""Array elements inside functions that run at run time: reads of `name[i, j]` with indices known or not."""

from __future__ import annotations

from lacuna.codegen.flatten.names.values import Array, Value, indices
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


def at_index(array: Array, index: Expr) -> Value | None:
    """The row of an array of element reads whose number is known at run time; None where it is no such array, or not
    the whole of one in its order."""
    moved = _moved(array.row(0), index)
    rows = (array.row(k) == _moved(array.row(0), ex.const(k + 1)) for k in range(array.shape[0]))
    return moved if moved is not None and all(rows) else None


def _moved(row: Value, index: Expr) -> Value | None:
    """A row of element reads with another number."""
    inner = len(row.shape) if isinstance(row, Array) else 0
    items = row.items if isinstance(row, Array) else (row,)
    if not all(isinstance(item, Expr) and item.op == "call" and item.value == "[]" for item in items):
        return None
    positions = [len(item.args) - 1 - inner for item in items]
    if any(p < 1 for p in positions):  # the rows are records, each field of each a variable of its own
        return None
    reads = tuple(
        ex.node("call", (*item.args[:p], index, *item.args[p + 1 :]), "[]", item.type)
        for item, p in zip(items, positions, strict=True)
    )
    return Array(row.shape, reads) if isinstance(row, Array) else reads[0]
