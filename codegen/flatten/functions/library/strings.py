"""Modelica.Utilities.Strings and the like on texts known at translation, in place of their external C."""

from __future__ import annotations

from collections.abc import Callable
import re

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.expressions.constants import known
from lacuna.codegen.flatten.functions.library.objects import ExternalCall, Handler
from lacuna.codegen.flatten.names.values import Value
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.expressions import LARGEST_INTEGER

_NUMBERS = {
    "real": re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"), "whole": re.compile(r"[+-]?\d+"),
    "unsigned real": re.compile(r"(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"), "unsigned whole": re.compile(r"\d+"),
}  # fmt: skip
_IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
_QUOTED = re.compile(r'"(?:[^"\\]|\\.)*"', re.DOTALL)


def _plain(values: list[Value], call: ExternalCall) -> list:
    """Arguments as Python's values."""
    result: list[object] = []
    for v in values:
        if isinstance(v, str):
            result.append(v)
        elif isinstance(v, Expr):
            result.append(known(v, call.scope, call.span, f"an argument of {call.cls.name}").value)
        else:
            raise Diagnostic("R062", f"{call.cls.name} takes scalars", call.span, "give texts and numbers")
    return result


def _on_texts(function: Callable[..., object]) -> Handler:
    def build(values: list[Value], call: ExternalCall) -> list[Value]:
        result = function(*_plain(values, call))
        results = result if isinstance(result, tuple) else (result,)
        return [r if isinstance(r, str) else ex.const(r) for r in results]

    return build


def _substring(text: str, first: int, last: int) -> str:
    return text[max(first, 1) - 1 : last]


def _skip(text: str, start: int) -> int:
    at = start
    while at <= len(text) and text[at - 1].isspace():
        at += 1
    return at


def _scan(pattern: re.Pattern[str], text: str, start: int) -> tuple[int, str]:
    """(index after what was found, or of the first character that is no space where nothing was; the text)"""
    at = _skip(text, start)
    found = pattern.match(text, at - 1)
    return (found.end() + 1, found[0]) if found else (start, "")


def _scan_real(text: str, start: int, unsigned: bool) -> tuple[int, float]:
    after, found = _scan(_NUMBERS["unsigned real" if unsigned else "real"], text, start)
    return (after, float(found)) if found else (start, 0.0)


def _scan_integer(text: str, start: int, unsigned: bool) -> tuple[int, int]:
    after, found = _scan(_NUMBERS["unsigned whole" if unsigned else "whole"], text, start)
    whole = found and (after > len(text) or text[after - 1] not in ".eE") and abs(int(found)) <= LARGEST_INTEGER
    return (after, int(found)) if whole else (start, 0)


def _scan_string(text: str, start: int) -> tuple[int, str]:
    after, found = _scan(_QUOTED, text, start)
    return after, found[1:-1]


def _compare(a: str, b: str, case: bool) -> int:
    """A literal of Modelica.Utilities.Types.Compare: Less, Equal, Greater."""
    first, second = (a, b) if case else (a.lower(), b.lower())
    return 1 if first < second else 2 if first == second else 3


def _compared(values: list[Value], call: ExternalCall) -> list[Value]:
    number = _compare(*_plain(values, call))
    ref = ast.Ref(call.span, ("Modelica", "Utilities", "Types", "Compare", ("Less", "Equal", "Greater")[number - 1]),
                  (None,) * 5)  # fmt: skip
    return [call.scope.context.lowering.nodes[ast.Ref](ref, call.scope)]


def hash_string(text: str) -> int:
    """A 32-bit signed number from a text: the AP hash of Arash Partow (General Purpose Hash Function Algorithms)."""
    value, mask = 0xAAAAAAAA, 0xFFFFFFFF
    for at, byte in enumerate(text.encode()):
        mixed = ~((value << 11) + (byte ^ (value >> 5))) if at & 1 else (value << 7) ^ byte * (value >> 3)
        value ^= mixed & mask
    return value - (1 << 32) if value >> 31 else value


def _seed(values: list[Value], call: ExternalCall) -> list[Value]:
    """A seed that is the same at every run of a model, so that runs can be repeated."""
    return [ex.const(hash_string(call.scope.context.model))]


STRINGS: dict[str, Handler] = {
    "ModelicaStrings_length": _on_texts(len), "ModelicaStrings_substring": _on_texts(_substring),
    "ModelicaStrings_skipWhiteSpace": _on_texts(_skip), "ModelicaStrings_compare": _compared,
    "ModelicaStrings_hashString": _on_texts(hash_string),
    "ModelicaStrings_scanReal": _on_texts(_scan_real), "ModelicaStrings_scanInteger": _on_texts(_scan_integer),
    "ModelicaStrings_scanString": _on_texts(_scan_string),
    "ModelicaStrings_scanIdentifier": _on_texts(lambda text, start: _scan(_IDENTIFIER, text, start)),
    "ModelicaRandom_automaticGlobalSeed": _seed,
    "ModelicaInternal_fullPathName": _on_texts(lambda name: name), "strlen": _on_texts(len),
}  # fmt: skip
