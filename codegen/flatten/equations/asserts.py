"""assert(condition, message, level), wherever it stands."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.equations.equations import origin_of
from lacuna.codegen.flatten.expressions.constants import known
from lacuna.codegen.flatten.expressions.enumerations import enumeration_of
from lacuna.codegen.flatten.expressions.lower import lower, lower_scalar
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import ChosenText
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, TRUE, Expr, walk
from lacuna.codegen.syntax import ast


def lower_assert(call: ast.Call, scope: Scope) -> flat.Assert:
    arguments = dict(zip(("condition", "message", "level"), call.args, strict=False)) | call.named
    if not {"condition", "message"} <= arguments.keys():
        hint = 'assert(x > 0, "what is wrong and what to do")'
        raise Diagnostic("R050", "assert needs a condition and a message", call.span, hint)
    condition = lower_scalar(arguments["condition"], scope, BOOLEAN)
    level = _level(arguments["level"], scope) if "level" in arguments else "error"
    message: str | None = ""
    varying: list[Expr] = []
    if condition is not TRUE or isinstance(arguments["message"], ast.Literal):  # else nobody reads it (8.3.7)
        message = lower_message(arguments["message"], scope, varying)
    if message is None:
        hint = 'assert(x > 0, "text", AssertionLevel.warning)'
        raise Diagnostic("R020", "the message of assert is not a String", call.span, hint)
    shown = [str(n.value) for e in varying for n in walk(e) if n.op == "var"]
    return flat.Assert(condition, message, call.span, level, origin_of(scope), tuple(dict.fromkeys(shown)))


def lower_message(written: ast.Expression, scope: Scope, varying: list[Expr]) -> str | None:
    """The text of an assert or a terminate: variables in it by their names, all texts that it may be. None where it is
    no String. What varies in it is added to `varying`."""
    message = lower(written, replace(scope, message=varying, conditional=True))
    if isinstance(message, ChosenText):
        return " or ".join(dict.fromkeys(text for _, text in message.alternatives))
    return message if isinstance(message, str) else None


def require_lasting(checks: Iterable[flat.Assert]) -> None:
    """Outside of when an assert is checked where an event is over, and never sees an instant. Raises R056."""
    for check in checks:
        asked = next((n for n in walk(check.condition) if n.op in ("edge", "change", "sample")), None)
        if asked is not None:
            message = f"an assert outside of when asks for an instant: {asked}"
            raise Diagnostic("R056", message, check.span, "write: when condition then assert(...); end when")


def _level(e: ast.Expression, scope: Scope) -> str:
    value = lower_scalar(e, scope, INTEGER)
    if enumeration_of(value, scope.context) != "AssertionLevel":
        hint = "AssertionLevel.warning or AssertionLevel.error"
        raise Diagnostic("R020", "the level of assert is no AssertionLevel", e.span, hint)
    return ("warning", "error")[int(known(value, scope, e.span, "the level of assert").value) - 1]
