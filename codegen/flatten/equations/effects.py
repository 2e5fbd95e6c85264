"""Calls that stand alone: what is left of them is that they must not fail."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.equations.equations import origin_of
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.names.scope import Scope, find_class
from lacuna.codegen.flatten.names.values import scalars
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, Expr
from lacuna.codegen.syntax import ast

_PRINT = "ModelicaInternal_print"


def effect(item: ast.Procedure, scope: Scope) -> list[flat.Assert]:
    """The asserts that stand for a call; texts in its arguments are messages. Raises R056 for an operator."""
    call = item.call
    if str(call.function) in scope.context.lowering.functions or str(call.function) in ("reinit", "terminate"):
        hint = "assert, reinit, terminate and functions can stand alone; reinit and terminate under a when"
        raise Diagnostic("R056", f"a call of {call.function} is no statement here", item.span, hint)
    inner = replace(scope, message=[])
    cls = find_class(scope.context.library, scope.cls, call.function)
    if cls is not None and cls.external is not None and cls.external.function == _PRINT and call.args:
        message = str(lower(call.args[0], inner))
        return [flat.Assert(ex.FALSE, message, item.span, "warning", origin_of(scope))]
    try:
        results = scope.context.lowering.results(call, inner)
    except Diagnostic as error:
        if error.code != "F035":
            raise
        message = error.message.removeprefix("the function failed: ")
        return [flat.Assert(ex.FALSE, message, item.span, "error", origin_of(scope))]
    conditions = []
    for s in (s for result in results for s in scalars(result)):
        if isinstance(s, Expr) and any(n.op == "call" and n.value in scope.context.functions for n in ex.walk(s)):
            conditions.append(s if s.type == BOOLEAN else ex.relation(">=", ex.call("abs", s), ex.ZERO))  # no NaN
    return [flat.Assert(c, f"{call.function} fails", item.span, "error", origin_of(scope)) for c in conditions[:1]]
