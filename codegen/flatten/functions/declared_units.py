"""A function is a boundary of units: its results have those that they declare, whatever it is called with.

Arguments are checked where they are written, and the body once, on names that have the units of the inputs. A result
that declares no unit has that of what the body makes of the arguments, numbers among which have those of their inputs.
The value of a call is marked with what the unit check looks at in its place; nothing is left of it afterwards.
"""

from __future__ import annotations

from dataclasses import dataclass

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import AtRunTime
from lacuna.codegen.flatten.functions.interpret import interpret
from lacuna.codegen.flatten.functions.locals import Local, Signature
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Value, scalars, with_scalars
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.annotated import in_units, measured, number
from lacuna.codegen.symbolic.expr import REAL, Expr
from lacuna.codegen.units.check import Body


def note_units(local: Local, value: Value, span: Span, what: str, scope: Scope) -> None:
    """Have the unit check compare `value` with the unit that `local` declares."""
    body = scope.context.body
    if local.unit and isinstance(value, Expr | Array) and is_looked_at(scope):
        noted = scope.context.argument_units if body is None else body.values
        noted += [(item, local.unit, what, span) for item in scalars(value)]


def is_looked_at(scope: Scope) -> bool:
    """Whether the unit check sees what stands in `scope`: a body only while it is run for that."""
    return not scope.in_function or scope.context.body is not None


class _Checked(set[int]):
    """Functions whose bodies are checked, by id of their signatures."""


@dataclass
class _Reader:
    """What stands for the values of a function's variables while its body is run for the unit check."""

    signature: Signature
    body: Body

    def argument(self, local: Local, value: Value) -> Value:
        """Names of an input's elements. What is no Real, and a number for an input without unit, stays what it is."""
        items = scalars(value)
        if (
            not isinstance(value, Expr | Array)
            or local.type.primitive != REAL
            or any(isinstance(s, str) for s in items)
        ):
            return value
        return with_scalars(value, (self._element(local, s, k, len(items)) for k, s in enumerate(items)))

    def _element(self, local: Local, s: Expr, number: int, count: int) -> Expr:
        if not local.unit and s.op == "const":
            return s
        name = local.name if count == 1 else f"{local.name}[{number + 1}]"
        self.body.units[name] = local.unit
        return ex.var(name)

    def assigned(self, local: Local, value: Value, span: Span) -> Value:
        """Names for what is assigned to a variable with a unit, which the value is to have."""
        what = f"{local.declaration.causality or 'variable'} {local.name} of {self.signature.cls.name}"
        units = self.body.units
        new = (s for s in scalars(value) if isinstance(s, Expr) and s.op != "const")
        new = (s for s in new if s.op != "var" or units.get(str(s.value)) != local.unit)
        self.body.values += [(s, local.unit, what, span) for s in new]
        return self.argument(local, value)


def check_body(signature: Signature, arguments: dict[str, Value], context: Context, span: Span) -> None:
    """Have the unit check look at the body, once, as far as it runs on names in place of the arguments."""
    checked = context.table(_Checked)
    if id(signature) in checked or signature.external is not None:
        return
    checked.add(id(signature))
    reader = _Reader(signature, Body())
    context.bodies.append(reader.body)
    outer, context.body = context.body, reader.body
    try:
        named = {local.name: reader.argument(local, arguments[local.name]) for local in signature.inputs}
        interpret(signature, named, context, span, reader.assigned, once=True)
    except (AtRunTime, Diagnostic):  # a size or an index depends on a value: what comes after it is not looked at
        pass
    finally:
        context.body = outer


def mere_numbers(arguments: dict[str, Value]) -> dict[str, Value]:
    """Arguments without the units of numbers: those of the inputs are declared, or those of whatever is given."""
    return {
        n: with_scalars(v, (number(s) if isinstance(s, Expr) else s for s in scalars(v))) for n, v in arguments.items()
    }


def with_declared_units(
    signature: Signature, arguments: dict[str, Value], results: list[Value], context: Context, span: Span
) -> list[Value]:
    """`results`, which the function gives of `arguments`, marked with the units that they declare, or with what the
    body makes of arguments where a number among these has a unit."""
    own = [_in_declared(local, r, signature, context) for local, r in zip(signature.outputs, results, strict=True)]
    if all(local.unit for local in signature.outputs) or all(map(_is_number, _scalars(results))):
        return own
    meant = _of_numbers(signature, arguments, results, context, span)
    return [o if local.unit else m for local, o, m in zip(signature.outputs, own, meant, strict=True)]


def _in_declared(local: Local, result: Value, signature: Signature, context: Context) -> Value:
    if not local.unit:
        return result
    name = f"{signature.cls.path}(...)" if len(signature.outputs) == 1 else f"{local.name} of {signature.cls.path}(...)"
    context.literal_units[name] = local.unit
    return with_scalars(result, (_declared(s, ex.var(name)) for s in scalars(result)))


def _of_numbers(
    signature: Signature, arguments: dict[str, Value], results: list[Value], context: Context, span: Span
) -> list[Value]:
    named = {local.name: _named(local, arguments[local.name], signature, context) for local in signature.inputs}
    own = any(local.unit for local in signature.locals if local.declaration.causality != "input")
    given = any(named[n] is not v for n, v in arguments.items())
    if not (given or own):
        return results

    def inside(local: Local, value: Value, _: Span) -> Value:
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


def _declared(s: Expr | str, name: Expr) -> Expr | str:
    return measured(s, name) if _is_number(s) and not ex.is_nothing(s) else _marked(s, name)


def _marked(s: Expr | str, meant: Expr | str) -> Expr | str:
    real = isinstance(s, Expr) and isinstance(meant, Expr) and s.type == REAL
    return in_units(s, meant) if real and s is not meant else s
