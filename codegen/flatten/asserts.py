"""assert(condition, message, level), wherever it stands."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.equations import origin_of
from lacuna.codegen.flatten.lower import lower, lower_scalar
from lacuna.codegen.flatten.scope import Scope
from lacuna.codegen.symbolic.expr import BOOLEAN, TRUE
from lacuna.codegen.syntax import ast


def lower_assert(call: ast.Call, scope: Scope) -> flat.Assert:
    arguments = dict(zip(("condition", "message", "level"), call.args, strict=False)) | call.named
    if not {"condition", "message"} <= arguments.keys():
        hint = 'assert(x > 0, "what is wrong and what to do")'
        raise Diagnostic("R050", "assert needs a condition and a message", call.span, hint)
    condition = lower_scalar(arguments["condition"], scope, BOOLEAN)
    level = lower(arguments["level"], scope) if "level" in arguments else "error"
    message = ""
    if condition is not TRUE:  # else nobody reads it (8.3.7)
        message = lower(arguments["message"], replace(scope, message=True, conditional=True))
    if not isinstance(message, str) or level not in ("error", "warning"):
        hint = 'assert(x > 0, "text", AssertionLevel.warning)'
        raise Diagnostic("R020", "the message of assert is not a String", call.span, hint)
    return flat.Assert(condition, message, call.span, level, origin_of(scope))
