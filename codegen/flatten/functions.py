"""Calls of functions declared in a model: arguments bound, then inlined, or kept as a function of fixed sizes.

What runs straight (assignments, ifs, loops of known length) becomes an expression at the place of the call; the rest
becomes a `flat.Function`, one for each combination of array sizes, and for each result a call names.
"""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.constants import AtRunTime
from lacuna.codegen.flatten.context import Context
from lacuna.codegen.flatten.external import call_external
from lacuna.codegen.flatten.function_code import Sources, emitted_call
from lacuna.codegen.flatten.function_locals import Local, fit, signature_of
from lacuna.codegen.flatten.interpret import interpret
from lacuna.codegen.flatten.lower import lower
from lacuna.codegen.flatten.scope import Scope
from lacuna.codegen.flatten.values import Array, Record, Value, scalars
from lacuna.codegen.suggest import did_you_mean
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast

MAX_INLINE_NODES = 250
MAX_INLINE_DEPTH = 12
_EVENTFUL = ("abs", "sign", "floor", "ceil", "integer", "mod", "rem", "div")


def call_function(cls: ast.Class, e: ast.Call, scope: Scope) -> list[Value]:
    """The results of a call. Raises R050 and R062 for arguments that do not fit."""
    context = scope.context
    if cls.partial:
        raise Diagnostic("R015", f"the function {cls.name} is partial", e.function.span, "call one that extends it")
    signature = signature_of(cls, context)
    arguments = bind_arguments(cls, signature.inputs, e, scope)
    if cls.external is not None:
        return call_external(cls, arguments, e, context)
    known = all(isinstance(a, str) or a.op == "const" for v in arguments.values() for a in scalars(v))
    if known or (context.call_depth < MAX_INLINE_DEPTH and not _has_events(arguments)):
        context.call_depth += 1
        try:
            results = interpret(signature, arguments, context, e.span)
            if known or _is_small(results, arguments):
                results = [_without_events(r) for r in results]
                for local, value in zip(signature.outputs, results, strict=True):
                    note_units(local, value, e.span, f"output {local.name} of {cls.name}", scope)
                return results
        except AtRunTime:
            pass
        finally:
            context.call_depth -= 1
    return emitted_call(signature, arguments, context, e.span)


def bind_arguments(cls: ast.Class, inputs: list[Local], e: ast.Call, scope: Scope) -> dict[str, Value]:
    """Values of the inputs by name: given by position, by name, or the declared default."""
    names = [i.name for i in inputs]
    if len(e.args) > len(inputs):
        hint = f"{cls.name}({', '.join(names)})"
        raise Diagnostic("R050", f"{cls.name} takes {len(inputs)} arguments, given {len(e.args)}", e.span, hint)
    written = dict(zip(names, e.args, strict=False))
    for name, value in e.named.items():
        if name not in names:
            hint = did_you_mean(name, names, f"{cls.name}({', '.join(names)})")
            raise Diagnostic("R050", f"{cls.name} has no input {name}", value.span, hint)
        if name in written:
            raise Diagnostic("R050", f"the input {name} is given twice", value.span, "keep one of them")
        written[name] = value
    bound: dict[str, Value] = {}
    for local in inputs:
        inner = replace(local.scope, locals=dict(bound))
        default = local.declaration.modification.value
        if local.name in written:
            value, span = lower(written[local.name], scope), written[local.name].span
        elif default is not None:
            value, span = lower(default, inner), default.span
        else:
            hint = f"{cls.name}({', '.join(names)})"
            raise Diagnostic("R050", f"the input {local.name} of {cls.name} is not given", e.span, hint)
        bound[local.name] = fit(local, value, inner, span)
        note_units(local, bound[local.name], span, f"input {local.name} of {cls.name}", scope)
    return bound


def note_units(local: Local, value: Value, span: Span, what: str, scope: Scope) -> None:
    """Have the unit check compare `value` with the unit that `local` declares."""
    if local.unit and not isinstance(value, Record) and not scope.in_function:
        for item in scalars(value):
            scope.context.argument_units.append((item, local.unit, what, span))


def _eventful(n: Expr) -> bool:
    return n.op in ex.RELATIONS or n.op in ("min", "max") or (n.op == "call" and n.value in _EVENTFUL)


def _has_events(arguments: dict[str, Value]) -> bool:
    """Would inlining put event-generating arguments under the noEvent of the function's body?"""
    return any(_eventful(n) for v in arguments.values() for a in scalars(v) if isinstance(a, Expr) for n in ex.walk(a))


def _without_events(value: Value) -> Value:
    """Relations in functions make no events."""

    def quiet(item: Expr | str) -> Expr | str:
        if isinstance(item, Expr) and item.op not in ("const", "var") and any(map(_eventful, ex.walk(item))):
            return ex.special("noEvent", item, type=item.type)
        return item

    if isinstance(value, Array):
        return Array(value.shape, tuple(map(quiet, value.items)))
    if isinstance(value, Record):
        return Record(value.name, {name: _without_events(field) for name, field in value.fields.items()})
    return quiet(value)


def _is_small(results: list[Value], arguments: dict[str, Value]) -> bool:
    given = {a for v in arguments.values() for a in scalars(v)}
    seen: set[Expr] = set()
    stack = [s for r in results for s in scalars(r) if isinstance(s, Expr)]
    while stack:
        n = stack.pop()
        if n not in seen and n not in given:
            seen.add(n)
            stack.extend(n.args)
        if len(seen) > MAX_INLINE_NODES:
            return False
    return True


def construct_record(cls: ast.Class, e: ast.Call, scope: Scope) -> Record:
    """Record(a, field = b): fields by position and name, the rest by their defaults."""
    declared = signature_of(cls, scope.context).locals
    fields = [
        replace(f, scope=replace(f.scope, in_function=scope.in_function))
        for f in declared
        if f.declaration.variability != "constant"
    ]
    return Record(cls.path, bind_arguments(cls, fields, e, scope))


def run(name: str, arguments: list[Expr], context: Context, span: Span) -> Expr:
    """A kept function on constant arguments: its (first) result as a constant."""
    source = context.table(Sources)[name]
    bound: dict[str, Value] = {}
    for local, value in zip(source.inputs, arguments, strict=True):
        bound[local] = Array(source.shapes[local], value.args) if value.op == "array" else value
    try:
        results = interpret(source.signature, bound, context, span)
    except AtRunTime as reason:
        message = f"{name} cannot be evaluated at translation: {reason.args[0]}"
        raise Diagnostic("F021", message, span, "give it constants and parameters only") from None
    return scalars(results[source.output])[source.element]
