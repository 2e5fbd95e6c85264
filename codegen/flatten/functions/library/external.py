"""External functions: those of the library by our own implementations; any other is refused."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.functions.library import objects, strings
from lacuna.codegen.flatten.functions.library.data_files import CSV_COLUMN, column_of_file
from lacuna.codegen.flatten.functions.library.objects import ExternalCall, Handler
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Value
from lacuna.codegen.syntax import ast

HANDLERS: dict[str, Handler] = {**objects.TABLES, **strings.STRINGS}


def call_external(cls: ast.Class, arguments: dict[str, Value], e: ast.Call, scope: Scope) -> list[Value]:
    """The results of an external function. Raises R094 for one that is not known here."""
    external = cls.external
    inner = Scope(scope.context, cls, None, dict(arguments), in_function=True)
    if external.language == "builtin" and cls.name == CSV_COLUMN:
        return column_of_file(list(arguments.values()), scope.context, e.span)
    if external.language == "builtin" and external.function in scope.context.lowering.functions:
        call = ast.Call(e.span, ast.Ref(e.span, (external.function,), (None,)), external.args)
        return [lower(call, inner)]
    handler = HANDLERS.get(external.function or cls.name)
    if handler is None:
        hint = f"write it as a function of the language; data comes in by {CSV_COLUMN}(fileName, column)"
        raise Diagnostic("R094", f"the external function {cls.name} is outside the subset", e.span, hint)
    values = [lower(a, inner) for a in external.args] if external.function else list(arguments.values())
    return handler(values, ExternalCall(cls, replace(scope, in_function=scope.in_function), e.span))
