"""Calls of functions declared in a model: arguments bound, then inlined, or kept as a function of fixed sizes.

What runs straight (assignments, ifs, loops of known length) becomes an expression at the place of the call; the rest
becomes a `flat.Function`, one for each combination of array sizes, and for each result a call names.
"""

from __future__ import annotations

from collections.abc import Set
from dataclasses import replace

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.types import EXTERNAL
from lacuna.codegen.flatten.expressions.constants import AtRunTime
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.functions.annotated import with_derivatives
from lacuna.codegen.flatten.functions.declared_units import (
    check_body,
    is_looked_at,
    mere_numbers,
    note_units,
    with_declared_units,
)
from lacuna.codegen.flatten.functions.effort import MAX_INLINE_DEPTH, is_small
from lacuna.codegen.flatten.functions.fitting import SizeVaries, blank, counts_evaluated, evaluated, fit
from lacuna.codegen.flatten.functions.interpret import interpret
from lacuna.codegen.flatten.functions.kept.code import emitted_call
from lacuna.codegen.flatten.functions.library.external import call_external
from lacuna.codegen.flatten.functions.library.random_numbers import GENERATORS
from lacuna.codegen.flatten.functions.locals import Local, Signature, inputs_of, signature_of
from lacuna.codegen.flatten.names.scope import Scope, find_class
from lacuna.codegen.flatten.names.values import (
    Array,
    FunctionValue,
    Record,
    Value,
    expressions_of,
    is_open,
    scalars,
    shape_of,
    shape_text,
    stack,
)
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.symbolic.leaves import holds
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import references
from lacuna.suggest import did_you_mean

Written = dict[str, tuple[Value, Span]]  # arguments with their places, by the name of the input


def call_function(cls: ast.Class, e: ast.Call, scope: Scope, given: dict[str, Value] | None = None) -> list[Value]:
    """The results of a call, `given` being inputs bound before. Raises R050 and R062 for arguments that do not fit.

    Arguments with more dimensions than the inputs have are taken element by element (Modelica 3.6, 12.4.6).
    """
    if cls.partial:
        raise Diagnostic("R015", f"the function {cls.name} is partial", e.function.span, "call one that extends it")
    signature = signature_of(cls, scope.context)
    written = written_arguments(cls, signature.inputs, e, scope, given or {})
    return _call_rows(signature, written, e, scope)


def _call_rows(signature: Signature, written: Written, e: ast.Call, scope: Scope) -> list[Value]:
    """As `call_function`, of one row of arguments, which may have rows themselves."""
    shape = _vector_shape(signature, written, e.span)
    if not shape:
        return _call(signature, written, e, scope)
    if len(signature.outputs) != 1:
        message = f"{signature.cls.name} has {len(signature.outputs)} results and is called with arrays for scalars"
        raise Diagnostic("R062", message, e.span, "element by element works for functions of one result")
    scope.context.spend(shape[0], e.span)
    rows = [
        _call_rows(signature, {n: (_row(signature, n, v, k), s) for n, (v, s) in written.items()}, e, scope)
        for k in range(shape[0])
    ]
    return [stack([row[k] for row in rows], e.span) for k in range(len(signature.outputs))]


def _extra(signature: Signature, name: str, value: Value) -> int:
    """How many dimensions the argument has more than the input."""
    local = next(i for i in signature.inputs if i.name == name)
    declared = len(local.declaration.dimensions) + len(local.type.dimensions)
    return len(shape_of(value)) - declared if isinstance(value, Array) and local.type.primitive != EXTERNAL else 0


def _row(signature: Signature, name: str, value: Value, number: int) -> Value:
    return value.rows()[number] if _extra(signature, name, value) > 0 else value


def _vector_shape(signature: Signature, written: Written, span: Span) -> tuple[int, ...]:
    """The sizes over which the call is repeated, () where every argument fits as it is."""
    shapes = {}
    for name, (value, _) in written.items():
        extra = _extra(signature, name, value)
        if extra > 0:
            shapes[name] = shape_of(value)[:extra]
    if len(set(shapes.values())) > 1:
        found = ", ".join(f"{n} {shape_text(s)}" for n, s in shapes.items())
        raise Diagnostic("R062", f"arguments taken element by element differ in size: {found}", span, "make them alike")
    return next(iter(shapes.values()), ())


def _call(signature: Signature, written: Written, e: ast.Call, scope: Scope) -> list[Value]:
    arguments = bind_arguments(signature.cls, signature.inputs, written, e, scope, signature.sizing)

    def derivative(function: Signature, given: dict[str, Value]) -> list[Value]:
        inner = Scope(scope.context, function.cls, in_function=True, pure=not function.cls.impure)
        placed = {n: (v, e.span) for n, v in given.items()}
        return _results(function, bind_arguments(function.cls, function.inputs, placed, e, inner), e, inner)

    results = _results(signature, arguments, e, scope)
    return with_derivatives(signature, arguments, results, scope.context, derivative)


def _results(signature: Signature, arguments: dict[str, Value], e: ast.Call, scope: Scope) -> list[Value]:
    context, cls = scope.context, signature.cls
    if signature.external is not None and signature.external.external.function not in GENERATORS:
        return call_external(signature, arguments, e, scope)
    items = [a for v in arguments.values() for a in scalars(v)]
    known = not any(map(is_open, items))
    if is_looked_at(scope) and not (known and context.library.foreign_package(cls.span.file)):
        check_body(signature, arguments, context, e.span)
    makes_events = signature.makes_events
    _refuse_endless(cls, e, scope)
    if known or (len(context.calls) < MAX_INLINE_DEPTH and (makes_events or not _has_events(items))):
        context.calls.append((cls.path, scope.conditional))
        try:
            results = interpret(signature, mere_numbers(arguments), context, e.span)
            if known or makes_events or is_small(results, arguments):
                made = results if makes_events else list(map(_without_events, results))
                return with_declared_units(signature, arguments, made, context, e.span) if is_looked_at(scope) else made
        except AtRunTime:
            pass
        except SizeVaries:
            given = {n: evaluated(a, scope, e.span, n) for n, a in arguments.items()}
            if given == arguments:
                raise
            return _results(signature, given, e, scope)
        except Diagnostic as error:
            if error.code != "F035" or not scope.conditional or any(isinstance(a, str) for a in items):
                raise
        finally:
            context.calls.pop()
    try:
        with context.nothing_inlined():
            return emitted_call(signature, arguments, context, e.span)
    except Diagnostic as error:
        given = counts_evaluated(arguments, scope, e.span)
        if error.code != "F036" or scope.in_function or given == arguments:
            raise
        return _results(signature, given, e, scope)  # parameters that decide how far it goes become structural


def _refuse_endless(cls: ast.Class, e: ast.Call, scope: Scope) -> None:
    """Raises AtRunTime for a function that calls itself where that is not decided at translation: inlined, it has no
    end."""
    calls = scope.context.calls
    first = next((k for k, (path, _) in enumerate(calls) if path == cls.path), None)
    if first is not None and (scope.conditional or any(undecided for _, undecided in calls[first + 1 :])):
        raise AtRunTime("a recursion", e.span)


def written_arguments(
    cls: ast.Class, inputs: list[Local], e: ast.Call, scope: Scope, given: dict[str, Value]
) -> Written:
    """The arguments by name, by position or by name in the source, with their places."""
    names = [i.name for i in inputs if i.name not in given]
    if len(e.args) > len(names):
        hint = f"{cls.name}({', '.join(names)})"
        raise Diagnostic("R050", f"{cls.name} takes {len(names)} arguments, given {len(e.args)}", e.span, hint)
    sources = dict(zip(names, e.args, strict=False))
    for name, value in e.named.items():
        if name not in names:
            hint = did_you_mean(name, names, f"{cls.name}({', '.join(names)})")
            raise Diagnostic("R050", f"{cls.name} has no input {name}", value.span, hint)
        if name in sources:
            raise Diagnostic("R050", f"the input {name} is given twice", value.span, "keep one of them")
        sources[name] = value
    result: Written = {name: (value, e.span) for name, value in given.items()}
    for local in inputs:
        if local.name in sources:
            source = sources[local.name]
            value = function_value(source, scope) if _takes_function(local) else lower(source, scope)
            result[local.name] = (value, source.span)
    return result


def bind_arguments(
    cls: ast.Class, inputs: list[Local], written: Written, e: ast.Call, scope: Scope, sizing: Set[str] = frozenset()
) -> dict[str, Value]:
    """Values of the inputs by name: the arguments, or the declared defaults, which may use other inputs. Those of
    `sizing` become structural."""
    bound: dict[str, Value] = {}
    open_, waiting = list(inputs), True
    while open_ and waiting:
        waiting = False
        for local in list(open_):
            inner = replace(local.scope, locals=dict(bound))
            default = local.declaration.modification.value
            if local.name in written:
                value, span = written[local.name]
            elif default is not None:
                if _asks_for(default, open_, local):
                    continue
                meant = function_value if _takes_function(local) else lower
                value, span = meant(default, local.around_default(inner)), default.span
            else:
                value, span = _by_its_fields(cls, local, inner), local.declaration.span
            if value is None:
                hint = f"{cls.name}({', '.join(i.name for i in inputs)})"
                raise Diagnostic("R050", f"the input {local.name} of {cls.name} is not given", e.span, hint)
            bound[local.name] = _fitted(local, value, inner, span)
            if local.name in sizing and not scope.in_function:
                bound[local.name] = evaluated(bound[local.name], scope, e.span, local.name)
            note_units(local, bound[local.name], span, f"input {local.name} of {cls.name}", scope)
            open_.remove(local)
            waiting = True
    if open_:
        names = ", ".join(i.name for i in open_)
        raise Diagnostic("F022", f"the defaults of {names} depend on each other", e.span, "give one of them")
    return {i.name: bound[i.name] for i in inputs}


def _by_its_fields(cls: ast.Class, local: Local, scope: Scope) -> Value | None:
    """What a record that is a field of a record holds by the defaults of its own fields; None where one has none."""
    if cls.kind != "record" or local.type.cls is None or local.type.primitive is not None:
        return None
    value = blank(local, scope)
    return None if any(isinstance(s, Expr) and s.op == "unset" for s in scalars(value)) else value


def _asks_for(default: ast.Expression, open_: list[Local], local: Local) -> bool:
    """Does a default use inputs that have no value yet?"""
    names = {i.name for i in open_}
    return any(r.names[0] in names for r in references(default))


def _fitted(local: Local, value: Value, scope: Scope, span: Span) -> Value:
    if not _takes_function(local):
        return fit(local, value, scope, span)
    if not isinstance(value, FunctionValue):
        raise Diagnostic("R062", f"{local.name} is a function", span, f"give one such as {local.declaration.type}")
    return value


def _takes_function(local: Local) -> bool:
    return local.type.cls is not None and local.type.cls.kind == "function"


def function_value(e: ast.Expression, scope: Scope) -> FunctionValue:
    """A function as an argument: its name, or `function f(a = 1)` with inputs bound. Raises R062 for anything else."""
    ref = e.function if isinstance(e, ast.PartialFunction) else e
    if not isinstance(ref, ast.Ref):
        raise Diagnostic("R062", "a function is wanted here", e.span, "give the name of one")
    local = scope.locals.get(ref.names[0]) if len(ref.names) == 1 else None
    bound = dict(local.bound) if isinstance(local, FunctionValue) else {}
    cls = local.cls if isinstance(local, FunctionValue) else find_class(scope.context.library, scope.cls, ref)
    if cls is None or cls.kind != "function":
        raise Diagnostic("R062", f"{ref} is no function", e.span, "give the name of a function")
    inputs = {i.name: i for i in inputs_of(cls, scope.context)}
    for name, value in (e.named if isinstance(e, ast.PartialFunction) else {}).items():
        if name not in inputs or name in bound:
            hint = did_you_mean(name, list(inputs), f"{cls.name}({', '.join(inputs)})")
            raise Diagnostic("R050", f"{cls.name} has no free input {name}", value.span, hint)
        takes = _takes_function(inputs[name])
        bound[name] = function_value(value, scope) if takes else lower(value, scope)
    return FunctionValue(cls, bound)


def _has_events(arguments: list[Value]) -> bool:
    """Would inlining put event-generating arguments under the noEvent of the function's body?"""
    return any(holds(e, ex.is_eventful) for a in arguments for e in expressions_of(a))


def _without_events(value: Value) -> Value:
    """Relations in functions make no events."""

    def quiet(item: Expr | str | Record) -> Expr | str | Record:
        if isinstance(item, Record):
            return _without_events(item)
        if isinstance(item, Expr) and item.op not in ("const", "var") and holds(item, ex.is_eventful):
            if item.op == "if" and item.type == ex.INTEGER:  # noEvent of a whole one would be Integer(e) of a literal
                return ex.if_else(*map(quiet, item.args))
            return ex.special("noEvent", item, type=item.type)
        return item

    if isinstance(value, Array):
        return Array(value.shape, tuple(map(quiet, value.items)))
    if isinstance(value, Record):
        fields = {name: _without_events(field) for name, field in value.fields.items()}
        return Record(value.name, fields, value.cls)
    return quiet(value)
