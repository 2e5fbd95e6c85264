"""External functions: those of the library by our own implementations; any other is refused."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.functions.kept.code import emitted_call
from lacuna.codegen.flatten.functions.library import impure, objects, spectrum, streams, strings
from lacuna.codegen.flatten.functions.library.data_files import CSV_COLUMN, column_of_file
from lacuna.codegen.flatten.functions.library.foreign import check_foreign
from lacuna.codegen.flatten.functions.library.linear_algebra import equations, singular_values
from lacuna.codegen.flatten.functions.library.objects import ExternalCall, Handler
from lacuna.codegen.flatten.functions.locals import Signature
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Value
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import references

HANDLERS: dict[str, Handler] = {
    **objects.TABLES, **strings.STRINGS, **streams.STREAMS,
    **spectrum.SPECTRA, **impure.IMPURE, **equations.LINEAR_EQUATIONS, **singular_values.SINGULAR_VALUES,
}  # fmt: skip


def call_external(signature: Signature, arguments: dict[str, Value], e: ast.Call, scope: Scope) -> list[Value]:
    """The results of an external function. Raises R094 for one that is not known here."""
    cls = signature.external
    external = cls.external
    inner = Scope(scope.context, cls, None, dict(arguments), in_function=True)
    if external.language == "builtin" and cls.name == CSV_COLUMN:
        return column_of_file(list(arguments.values()), scope.context, e.span)
    if external.language == "builtin" and external.function in scope.context.lowering.functions:
        call = ast.Call(e.span, ast.Ref(e.span, (external.function,), (None,)), external.args)
        return [scope.context.lowering.functions[external.function](call, inner)]
    handler = HANDLERS.get(external.function or cls.name)
    if handler is None:
        check_foreign(signature, scope, e.span)
        return emitted_call(signature, arguments, scope.context, e.span)
    own = {local.name for local in signature.locals} - set(arguments)  # results, and what only the C works with
    given = [a for a in external.args if not any(r.names[0] in own for r in references(a))]
    by_name = not external.function or external.language != "C"  # of LAPACK all is handed over in places to work in
    values = list(arguments.values()) if by_name else [lower(a, inner) for a in given]
    try:
        results = handler(values, ExternalCall(cls, scope, e.span))
    except Diagnostic as error:
        if scope.instance is not None and scope.instance.name:
            error.notes.append((scope.instance.span, f"of {scope.instance.name}, which is declared here"))
        raise
    outputs = [local.name for local in signature.outputs]
    places = [str(a) for a in (external.result, *external.args) if a is not None and str(a) in outputs] or outputs
    if len(places) != len(results):
        hint = f"declare {len(results)} outputs, as the Modelica Standard Library does"
        raise Diagnostic("R094", f"{cls.name} has {len(places)} results of {len(results)}", e.span, hint)
    found = dict(zip(places, results, strict=True))
    return [found[name] for name in outputs]
