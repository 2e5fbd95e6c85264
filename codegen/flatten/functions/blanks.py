"""What the variables of a function hold before anything is assigned to them."""

from __future__ import annotations

from dataclasses import replace
from math import prod

from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.functions.locals import Local, declared_sizes, fit, signature_of
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Record, Value
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr


def unset(kind: str) -> Expr:
    """Stands for a variable that nothing was assigned to."""
    return ex.node("unset", (), None, kind)


def blank(local: Local, scope: Scope) -> Value:
    """What a variable holds before anything is assigned, in the sizes that it is declared with."""
    shape = tuple(0 if local.is_flexible else n for n in declared_sizes(local, scope, local.nothing))
    nothing = unset(local.type.primitive) if local.type.primitive else _blank_record(local, scope)
    return Array(shape, (nothing,) * prod(shape)) if shape else nothing


def _blank_record(local: Local, scope: Scope) -> Record:
    """A record whose fields hold what its declaration, or that of its class, gives them."""
    given = {a.name: a.modification.value for a in local.declaration.modification.arguments}
    fields: dict[str, Value] = {}
    for part in signature_of(local.type.cls, scope.context).locals:
        inner = replace(part.scope, locals=dict(fields))
        value, where = given.get(part.name), scope
        if value is None:
            value, where = part.declaration.modification.value, part.around_default(inner)
        fields[part.name] = blank(part, inner) if value is None else fit(part, lower(value, where), inner, value.span)
    return Record(local.name, fields, local.type.cls)
