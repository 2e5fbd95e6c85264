"""What fits the declared variables of a function: types, sizes, fields of records; and what they hold at first."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from math import prod

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.types import EXTERNAL, Type
from lacuna.codegen.flatten.expressions.constants import evaluate, is_known
from lacuna.codegen.flatten.expressions.enumerations import enumeration_of
from lacuna.codegen.flatten.expressions.evaluate import evaluate_dimensions
from lacuna.codegen.flatten.expressions.lower import lower, modifier_value
from lacuna.codegen.flatten.functions.locals import Local, signature_of
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier, from_tree, merge, narrow
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import (
    Array,
    ExternalValue,
    Record,
    Value,
    holds_records,
    indices,
    items_of,
    scalars,
    shape_of,
    shape_text,
    with_scalars,
)
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, REAL, Expr
from lacuna.codegen.symbolic.leaves import always_reads, holds
from lacuna.codegen.syntax import ast
from lacuna.suggest import did_you_mean


def fit(local: Local, value: Value, scope: Scope, span: Span) -> Value:
    """`value` for a declared variable: type and size checked, whole numbers made Real where that is declared."""
    if local.type.primitive == EXTERNAL:
        if not isinstance(value, ExternalValue) or value.cls is not local.type.cls:
            raise Diagnostic("R062", f"{local.name} is an external object", span, f"give a {local.declaration.type}")
        return value
    if local.type.primitive is None:
        return _fit_records(local, value, scope, span)
    sizes = declared_sizes(local, scope, value)
    if sizes != shape_of(value) or isinstance(value, Record):
        message = f"{local.name} has size {shape_text(sizes)}, given {shape_text(shape_of(value))}"
        each = f"for each element: {{f({local.name}) for {local.name} in array}}"
        raise Diagnostic("R062", message, span, "both need the same size" if sizes else each)
    items = [typed(item, local.type.primitive, local.name, span) for item in scalars(value)]
    _require_enumeration(local.name, local.type, scalars(value), scope.context, span)
    return Array(sizes, tuple(items)) if isinstance(value, Array) else items[0]


def _require_enumeration(name: str, kind: Type, items: Iterable[Expr | str], context: Context, span: Span) -> None:
    """Raises R025 for a value of one enumeration where a number or another is declared, or the reverse (4.9.5)."""
    wanted = (kind.cls.origin or kind.cls).path if kind.literals and kind.cls is not None else ""
    for item in items:
        found = enumeration_of(item, context) if isinstance(item, Expr) and item.type == INTEGER else ""
        if found is not None and found != wanted and not (isinstance(item, Expr) and item.op == "unset"):
            names = [told.rsplit(".", 1)[-1] or kind.primitive for told in (wanted, found)]
            hint = f"give a {names[0]}; Integer(e) is the number of a literal"
            raise Diagnostic("R025", f"{name} is {names[0]}, given {names[1]}", span, hint)


def conform(old: Value, value: Value, span: Span, name: str, kind: Type, context: Context) -> Value:
    """`value` for a variable of a type that held `old`: the same size, and a type that fits."""
    if shape_of(old) != shape_of(value) or holds_records(old) != holds_records(value):
        message = f"{name} has size {shape_text(shape_of(old))}, given {shape_text(shape_of(value))}"
        raise Diagnostic("R042", message, span, "both need the same size")
    if kind.primitive is None or holds_records(old):
        return value
    items = [typed(item, kind.primitive, name, span) for item in scalars(value)]
    _require_enumeration(name, kind, items, context, span)
    return Array(old.shape, tuple(items)) if isinstance(old, Array) else items[0]


def _fit_records(local: Local, value: Value, scope: Scope, span: Span) -> Value:
    """A record, or an array of records, with the fields that are declared; the result is of the declared class."""
    sizes = declared_sizes(local, scope, value)
    if sizes != shape_of(value) or not all(isinstance(i, Record) for i in items_of(value)):
        what = "a record" if not sizes else f"an array {shape_text(sizes)} of records"
        raise Diagnostic("R062", f"{local.name} is {what}", span, f"give a {local.declaration.type}")
    for item in items_of(value):
        _require_fields(local.type.cls, item, local.name, scope.context, span)
    return value


def _require_fields(cls: ast.Class, value: Record, name: str, context: Context, span: Span) -> None:
    """A record that stands for one of `cls` has its fields and no others, of their types and dimensions (6.7, 12.4.1).
    Raises R062."""
    own = value.cls
    if isinstance(own, ast.Class) and (own.origin or own) is (cls.origin or cls):
        return
    fields = signature_of(cls, context).locals
    known = {field.name for field in fields}
    if more := [field for field in value.fields if field not in known]:
        other = own.name if isinstance(own, ast.Class) else value.name
        message = f"{name} is a {cls.name}, given a {other} with {', '.join(more)} as well"
        raise Diagnostic("R062", message, span, f"make one of it: {cls.name}(...) takes the fields that it has")
    for field in fields:
        found = value.fields.get(field.name)
        what = f"{name}.{field.name}"
        if found is None:
            other = own.name if isinstance(own, ast.Class) else value.name
            message = f"{name} is a {cls.name}, given a {other} without {field.name}"
            raise Diagnostic("R062", message, span, f"give a {cls.name}")
        if len(shape_of(found)) != len(field.declaration.dimensions) + len(field.type.dimensions):
            message = f"{what} is given {shape_text(shape_of(found))}, which has other dimensions"
            raise Diagnostic("R062", message, span, f"give a {cls.name}")
        for item in items_of(found):
            if isinstance(item, Record) and field.type.primitive is None:
                _require_fields(field.type.cls, item, what, context, span)
            elif isinstance(item, Expr | str) and field.type.primitive in (REAL, INTEGER, BOOLEAN, "String"):
                typed(item, field.type.primitive, what, span)


def declared_sizes(local: Local, scope: Scope, value: Value | None) -> tuple[int, ...]:
    """The size of a declared variable; `:` takes that of `value`, which a size may ask for: `A[:, size(A, 1)]`."""
    sizes = []
    if value is not None and local.declaration.dimensions:
        scope = scope.with_locals(**{local.name: value})
    for position, dimension in enumerate(local.declaration.dimensions):
        if isinstance(dimension, ast.Colon):
            shape = shape_of(value) if value is not None else ()
            if position >= len(shape):
                message = f"{local.name} needs an array of {len(local.declaration.dimensions)} dimensions"
                raise Diagnostic("R062", message, dimension.span, "give a size, or an array")
            sizes.append(shape[position])
        else:
            sizes += evaluate_dimensions([dimension], scope, None, local.name)
    return (*sizes, *local.type.dimensions)


def typed(item: Expr | str, kind: str, name: str, span: Span) -> Expr | str:
    """`item` as a value of type `kind`. Raises R062."""
    found = "String" if isinstance(item, str) else item.type
    if found != kind and (kind, found) != (REAL, INTEGER):
        raise Diagnostic("R062", f"{name} is {kind}, given {found}", span, f"give a {kind}")
    if kind == REAL and not isinstance(item, str) and item.op == "const" and item.type == INTEGER:
        return ex.const(float(item.value))
    return item


def unset(kind: str, name: str) -> Expr:
    """Stands for a variable of that name that nothing was assigned to."""
    return ex.node("unset", (), name, kind)


def blank(local: Local, scope: Scope, outer: Modifier | None = None) -> Value:
    """What a variable holds before anything is assigned, in the sizes that it is declared with; of records also what
    its declaration says of their fields, and `outer` from outside."""
    shape = tuple(0 if local.is_flexible else n for n in declared_sizes(local, scope, local.nothing))
    if local.type.primitive:
        nothing = unset(local.type.primitive, local.name)
        return Array(shape, (nothing,) * prod(shape)) if shape else nothing
    said = merge(outer, from_tree(local.declaration.modification, scope))
    places = [tuple(zip(index, shape, strict=True)) for index in indices(shape)]
    records = tuple(_blank_record(local.type.cls, scope.context, narrow(said, place)) for place in places)
    return Array(shape, records) if shape else records[0]


def _blank_record(cls: ast.Class, context: Context, said: Modifier) -> Record:
    """A record whose fields hold what is said of them, or what its class does."""
    fields: dict[str, Value] = {}
    for part in signature_of(cls, context).locals:
        inner = replace(part.scope, locals=dict(fields))
        given, default = said.children.get(part.name), part.declaration.modification.value
        if given is not None and given.value is not None:
            fields[part.name] = fit(part, modifier_value(given), inner, given.span)
        elif default is None:
            fields[part.name] = blank(part, inner, given)
        elif given is not None and given.children and part.type.primitive is None:
            message = f"parts of {part.name} are modified, which has a value as a whole"
            raise Diagnostic("R030", message, given.span, f"give {part.name} another value")
        else:
            fields[part.name] = fit(part, lower(default, part.around_default(inner)), inner, default.span)
    return Record(cls.path, fields, cls)


class SizeVaries(Diagnostic):
    """A condition that is not known decides the size of an array (12.4.5)."""

    def __init__(self, name: str, span: Span) -> None:
        hint = "give the function arguments that are parameters or constants"
        super().__init__("R042", f"what varies decides the size of {name}", span, hint)


def evaluated(value: Value, scope: Scope, span: Span, name: str) -> Value:
    """The value of an argument that decides sizes: parameters in it become structural."""
    if not isinstance(value, Expr | Array) or not all(isinstance(s, Expr) for s in scalars(value)):
        return value
    if not all(is_known(s, scope.context) for s in scalars(value)):
        return value
    items = tuple(evaluate(s, scope.context, span, f"the argument {name}") for s in scalars(value))
    return Array(value.shape, items) if isinstance(value, Array) else items[0]


def unknown_target(target: ast.Ref, names: dict[str, Value]) -> Diagnostic:
    hint = did_you_mean(target.names[0], names, "declare it under 'protected'")
    return Diagnostic("R002", f"there is no variable {target.names[0]}", target.span, hint)


def counts_evaluated(arguments: dict[str, Value], scope: Scope, span: Span) -> dict[str, Value]:
    """Arguments with the values of parameters in the place of whole numbers."""

    def whole(value: Value) -> bool:
        return all(isinstance(s, Expr) and s.type == INTEGER for s in scalars(value))

    return {n: evaluated(a, scope, span, n) if whole(a) else a for n, a in arguments.items()}


def _is_unset(n: Expr) -> bool:
    return n.op == "unset"


def _no_value(n: Expr, local: Local, cls: ast.Class, context: Context) -> Expr:
    """What a run has in the place of `n`, which nothing was assigned to: a variable, or a field of the output."""
    if n.type != REAL:
        return ex.nothing(n.type)
    variables = {d.name for d in signature_of(cls, context).locals}
    return ex.unassigned(f"{n.value if n.value in variables else f'{local.name}.{n.value}'} of {cls.name}")


def result_of(local: Local, value: Value, cls: ast.Class, context: Context) -> Value:
    """The value of an output. What some case alone leaves unassigned is no value: a run that meets the case ends, and a
    warning says so (12.4.4). Raises F033 for what no case assigns."""
    span = local.declaration.span

    def assigned(s: Expr | str) -> Expr | str:
        missing = [n for n in ex.walk(s) if _is_unset(n)] if isinstance(s, Expr) and holds(s, _is_unset) else []
        if missing and (always_reads(s, missing) or any(n.type == BOOLEAN for n in missing)):
            message = f"the output {local.name} of {cls.name} is not assigned in every case"
            others = {d.name for d in signature_of(cls, context).locals} - {local.name}
            if early := next((n.value for n in missing if n.value in others), None):
                message = f"{early} of {cls.name} is read before it has a value"
            raise Diagnostic("F033", message, span, "assign it, or give it a value first")
        if missing and all(w.span != span for w in context.warnings):
            message = f"the output {local.name} of {cls.name} is not assigned where no condition holds"
            hint = "where that is met, and something reads it, the run ends: give it a value first, or write else"
            context.warnings.append(Diagnostic("W011", message, span, hint, severity="warning"))
        found = ex.substitute(s, {n: _no_value(n, local, cls, context) for n in missing}) if missing else s
        return ex.as_real(found) if local.type.primitive == REAL and isinstance(found, Expr) else found

    return with_scalars(value, map(assigned, scalars(value)))
