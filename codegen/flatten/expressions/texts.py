"""String(x, ...): numbers, Booleans and literals as text (Modelica 3.6, 3.7.1)."""

from __future__ import annotations

import re

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.chosen_texts import Text, choose
from lacuna.codegen.flatten.expressions.constants import is_known, known
from lacuna.codegen.flatten.expressions.enumerations import enumeration_of
from lacuna.codegen.flatten.expressions.lower import lower, lower_scalar
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.index_types import literals_of
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import ChosenText, Record, Value
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, FALSE, INTEGER, REAL, TRUE, Expr
from lacuna.codegen.syntax import ast

_FORMAT = re.compile(r"([-+ #0]*)(\d*)(?:\.(\d+))?([diuoxXceEfgG])$")
_WHOLE = "diuoxXc"  # conversions of Integers
_OPTIONS = {"minimumLength": INTEGER, "leftJustified": BOOLEAN, "significantDigits": INTEGER}


def text_of(e: ast.Call, scope: Scope) -> Value:
    """The text of a value known at translation. In the message of an assert, what varies is shown as its source."""
    if not e.args:
        raise Diagnostic("R050", "String needs a value", e.span, "write String(x)")
    value = lower(e.args[0], scope)
    if isinstance(value, str | ChosenText):
        return value
    if isinstance(value, Record):
        text = scope.context.lowering.text(value, e, scope)
        if text is not None:
            return text
    if not isinstance(value, Expr):
        raise Diagnostic("R020", "String of what is no scalar", e.span, "use one element of it")
    if scope.message is not None and value.op != "const":
        scope.message.append(value)
        _options(e, value, scope)
        return str(value)
    kind = enumeration_of(value, scope.context)
    value = settled(value, scope.context)
    if value.op != "const" and not is_known(value, scope.context) and (kind or value.type == BOOLEAN):
        return _chosen(value, kind, _options(e, value, scope), scope, e.span)
    constant = known(value, scope, e.span, "the value of a String")
    return _written(constant, _options(e, constant, scope), kind, scope, e.span)


def settled(e: Expr, context: Context) -> Expr:
    """`e` with the values of the variables in it that a declaration equation sets to a constant."""

    def value_of(n: Expr) -> Expr | None:
        leaf, position = context.scalars.get(str(n.value), (None, 0)) if n.op == "var" else (None, 0)
        if leaf is None or leaf.is_structural:
            return None
        value = leaf.element(leaf.binding(), position)
        value = settled(value, context) if isinstance(value, Expr) else None
        return value if value is not None and value.op == "const" else None

    return ex.transform(e, value_of, {})


def _chosen(value: Expr, kind: str, options: dict[str, object], scope: Scope, span: Span) -> Value:
    """The text of a Boolean or of a value of an enumeration that varies: chosen among those of all values."""
    if "format" in options:
        raise Diagnostic("R050", "a format of what is no number", span, "leave the format out")
    every = [TRUE, FALSE] if not kind else [ex.const(n + 1) for n in range(len(literals_of(kind, scope)))]
    texts = [_written(each, options, kind, scope, span) for each in every]
    conditions = [value] if not kind else [ex.relation("==", value, each) for each in every]
    result: Text = texts[-1]
    for condition, text in reversed(list(zip(conditions, texts[:-1], strict=False))):
        result = choose(condition, text, result)
    return result


def _options(e: ast.Call, value: Expr, scope: Scope) -> dict[str, object]:
    """The named arguments; what stands in place of all others is `format` (3.7.1)."""
    if len(e.args) > 1:
        hint = "give it by its name: String(x, significantDigits = 4)"
        raise Diagnostic("R050", "String takes one value, and options by their names", e.args[1].span, hint)
    if "format" in e.named and len(e.named) > 1:
        hint = "the format says all: width, digits, kind"
        raise Diagnostic("R050", "format stands beside another option of String", e.named["format"].span, hint)
    options: dict[str, object] = {}
    for name, option in e.named.items():
        if name == "format":
            options[name] = lower(option, scope)
        elif name in _OPTIONS and not (name == "significantDigits" and value.type != REAL):
            number = lower_scalar(option, scope, _OPTIONS[name])
            options[name] = known(number, scope, option.span, name).value
        else:
            hint = "minimumLength, leftJustified, significantDigits (of a Real), format"
            raise Diagnostic("R050", f"String has no argument {name}", option.span, hint)
    return options


def _written(value: Expr, options: dict[str, object], kind: str, scope: Scope, span: Span) -> str:
    if "format" in options:
        return _formatted(value, str(options["format"]), span)
    if kind:
        text = literals_of(kind, scope)[value.value - 1]
    elif value.type == BOOLEAN:
        text = str(value.value).lower()
    else:
        text = f"{value.value:.{options.get('significantDigits', 6)}g}" if value.type == REAL else str(int(value.value))
    length = int(options.get("minimumLength", 0))
    return text.ljust(length) if options.get("leftJustified", True) else text.rjust(length)


def _formatted(value: Expr, form: str, span: Span) -> str:
    """C's printf with one conversion, written without its %; a Real is rounded for those of Integers."""
    match = _FORMAT.match(form)
    if match is None or value.type not in (INTEGER, REAL):
        raise Diagnostic("R050", f"{form!r} is no format of a {value.type}", span, 'such as "6.3f" or "5d"')
    return f"%{form}" % (round(value.value) if match[4] in _WHOLE else value.value)
