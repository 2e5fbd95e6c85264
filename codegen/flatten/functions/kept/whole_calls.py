"""Whether values are the results of one call: then the function has to run once, not once for each scalar."""

from __future__ import annotations

from lacuna.codegen import flat
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.values import Value, indices, scalars
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.annotated import plain
from lacuna.codegen.symbolic.expr import Expr


def element_name(base: str, output: str, index: tuple[int, ...]) -> str:
    """The function that gives one scalar of one result of the kept function `base`."""
    return f"{base}.{output}[{','.join(map(str, index))}]" if index else f"{base}.{output}"


def called(values: list[Value], context: Context) -> tuple[Expr, list[str]] | None:
    """The call whose results `values` are, each whole and in order, two scalars or more, with the results' types; None
    for anything else."""
    items = [plain(s) if isinstance(s, Expr) else s for value in values for s in scalars(value)]
    if len(items) < 2 or not all(isinstance(s, Expr) and s.op == "call" and s.args == items[0].args for s in items):
        return None
    base = _base(str(items[0].value), context)
    function = context.functions.get(base)
    if function is None or len(values) > len(function.outputs):
        return None
    outputs = function.outputs[: len(values)]
    expected = [element_name(base, n, i) for n in outputs for i in indices(function.shapes[n]) or [()]]
    if not function.shapes[outputs[0]]:
        expected[0] = base
    if [str(s.value) for s in items] != expected:
        return None
    return ex.call(base, *items[0].args), [function.types[n] for n in outputs]


def _base(name: str, context: Context) -> str:
    """The kept function that `name` gives a scalar of."""
    function = context.functions.get(name)
    first = function.body[0] if function is not None and function.body else None
    inner = str(first.value.value) if isinstance(first, flat.AssignCall) else ""
    return inner if name.startswith(f"{inner}.") and inner else name
