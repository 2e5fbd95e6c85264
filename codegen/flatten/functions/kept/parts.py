"""Records in functions that run at run time: each field is a variable of its own, named by the record, a dot and it."""

from __future__ import annotations

from collections.abc import Iterator

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.types import Type
from lacuna.codegen.flatten.functions.locals import signature_of
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.elements import local_value
from lacuna.codegen.flatten.names.values import Array, Record, Value, holds_records, indices, shape_of, shape_text
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, REAL, Expr


def variables_of(name: str, kind: Type, value: Value, context: Context, span: Span) -> Value:
    """The variables of a function that hold what is declared as `kind`, in the sizes of `value`. Raises F036."""
    if isinstance(value, Record):
        fields = {
            local.name: variables_of(f"{name}.{local.name}", local.type, value.fields[local.name], context, span)
            for local in signature_of(kind.cls, context).locals
            if local.name in value.fields
        }
        return Record(name, fields, value.cls)
    if isinstance(value, Array) and holds_records(value):
        numbers = [",".join(map(str, i)) for i in indices(value.shape)]
        items = zip(numbers, value.items, strict=True)
        return Array(value.shape, tuple(variables_of(f"{name}[{n}]", kind, v, context, span) for n, v in items))
    if kind.primitive not in (REAL, INTEGER, BOOLEAN):
        hint = "decide by an enumeration or a Boolean; use scalars, arrays and records of them"
        raise Diagnostic("F036", f"{name} of a function that runs at run time is no number or Boolean", span, hint)
    return local_value(name, kind.primitive, shape_of(value))


def parts(name: str, value: Value) -> dict[str, Value]:
    """The scalars and arrays of numbers that `value` consists of, by the names of their variables."""
    if isinstance(value, Record):
        return {n: v for field, part in value.fields.items() for n, v in parts(f"{name}.{field}", part).items()}
    if isinstance(value, Array) and holds_records(value):
        numbers = [",".join(map(str, i)) for i in indices(value.shape)]
        pairs = zip(numbers, value.items, strict=True)
        return {n: v for number, item in pairs for n, v in parts(f"{name}[{number}]", item).items()}
    return {name: value}


def rebuilt(value: Value, new: Iterator[Value]) -> Value:
    """A value built as `value` is, of other parts."""
    if isinstance(value, Record):
        return Record(value.name, {n: rebuilt(v, new) for n, v in value.fields.items()}, value.cls)
    if isinstance(value, Array) and holds_records(value):
        return Array(value.shape, tuple(rebuilt(v, new) for v in value.items))
    return next(new)


def matched(variable: Value, value: Value, name: str, span: Span) -> list[tuple[Expr, Expr | str]]:
    """Each scalar of `variable` with that of `value`, fields by their names. Raises R042 where they do not fit."""
    if isinstance(variable, Record) and isinstance(value, Record) and variable.fields.keys() <= value.fields.keys():
        fields = variable.fields.items()
        return [p for n, v in fields for p in matched(v, value.fields[n], f"{name}.{n}", span)]
    plain = shape_of(variable) == shape_of(value) and holds_records(variable) == holds_records(value)
    if not plain or isinstance(variable, Record):
        message = f"{name}: {shape_text(shape_of(variable))} := {shape_text(shape_of(value))}"
        raise Diagnostic("R042", f"the sides differ in size: {message}", span, "both need the same size")
    if not isinstance(variable, Array):
        return [(variable, value)]
    if holds_records(variable):
        pairs = zip(variable.items, value.items, strict=True)
        return [p for a, b in pairs for p in matched(a, b, name, span)]
    return list(zip(variable.items, value.items, strict=True))
