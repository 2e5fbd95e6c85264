"""Numbers given to variables of a function that declare a unit, its inputs first: they have it, though the call may
become an expression in mere numbers.

The value of such a call is marked with the same expression over names that have the units; the unit check looks at
that one, and nothing is left of it afterwards.
"""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import AtRunTime
from lacuna.codegen.flatten.functions.interpret import interpret
from lacuna.codegen.flatten.functions.locals import Local, Signature
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.values import Value, scalars, with_scalars
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.annotated import in_units
from lacuna.codegen.symbolic.expr import REAL, Expr


def with_literal_units(
    signature: Signature, arguments: dict[str, Value], results: list[Value], context: Context, span: Span
) -> list[Value]:
    """`results`, which the function gives of `arguments`, marked where a number among these has a unit."""
    named = {local.name: _named(local, arguments[local.name], signature, context) for local in signature.inputs}
    own = any(local.unit for local in signature.locals if local.declaration.causality != "input")
    given = any(named[n] is not v for n, v in arguments.items())
    if not (given or own) or all(map(_is_number, _scalars(results))):
        return results

    def inside(local: Local, value: Value) -> Value:
        return _named(local, value, signature, context)

    try:
        meant = iter(_scalars(interpret(signature, named, context, span, inside)))
    except (AtRunTime, Diagnostic):  # the course depends on the number: what it is made of has no unit then
        return results
    return [with_scalars(r, iter([_marked(s, next(meant)) for s in scalars(r)])) for r in results]


def _scalars(values: list[Value]) -> list[Expr | str]:
    return [s for v in values for s in scalars(v)]


def _is_number(s: Expr | str) -> bool:
    return isinstance(s, Expr) and s.op == "const" and s.type == REAL


def _named(local: Local, value: Value, signature: Signature, context: Context) -> Value:
    items = scalars(value)
    if not local.unit or not any(map(_is_number, items)):
        return value

    def name(s: Expr | str) -> Expr | str:
        if not _is_number(s):
            return s
        text = f"{ex.to_text(s)} for {local.name} of {signature.cls.path}"
        context.literal_units[text] = local.unit
        return ex.var(text)

    return with_scalars(value, map(name, items))


def _marked(s: Expr | str, meant: Expr | str) -> Expr | str:
    real = isinstance(s, Expr) and isinstance(meant, Expr) and s.type == REAL
    return in_units(s, meant) if real and s is not meant else s
