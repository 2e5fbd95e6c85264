"""Calls of built-in operators and functions: der, pre, noEvent, sample, delay, homotopy, scalar functions."""

from __future__ import annotations

from collections.abc import Callable

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.arrays import map_call, size_of_array
from lacuna.codegen.flatten.expressions.constants import is_parameter, is_zero, known, variability
from lacuna.codegen.flatten.expressions.derivative import time_derivative
from lacuna.codegen.flatten.expressions.enumerations import as_integer
from lacuna.codegen.flatten.expressions.lower import Handler, lower, lower_scalar
from lacuna.codegen.flatten.expressions.texts import text_of
from lacuna.codegen.flatten.expressions.transport import OPERATOR
from lacuna.codegen.flatten.names.index_types import enumeration
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Value, elementwise, scalars, shape_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, REAL, Expr
from lacuna.codegen.syntax import ast


def _take(e: ast.Call, count: int) -> list[ast.Expression]:
    if e.named or len(e.args) != count:
        message = f"{e.function} takes {count} argument{'s' * (count != 1)}, given {len(e.args) + len(e.named)}"
        raise Diagnostic("R050", message, e.span, "arguments of built-in functions are given by position")
    return e.args


def _der(e: ast.Call, scope: Scope) -> Value:
    (written,) = _take(e, 1)
    value = lower(written, scope)
    kept = ("delay", OPERATOR)
    found = next((n.op for x in scalars(value) if isinstance(x, Expr) for n in ex.walk(x) if n.op in kept), "")
    if found:
        hint = "delay the derivative: delay(der(x), T)"
        raise Diagnostic("R054", f"the derivative of a {found}", e.span, hint)
    return elementwise(lambda x: time_derivative(x, scope, e.span), [value], e.span, "der")


def _pre(e: ast.Call, scope: Scope) -> Value:
    (written,) = _take(e, 1)

    def build(x: Expr) -> Expr:
        if x.op == "const" or (x.op == "var" and variability(x, scope.context) in ("parameter", "constant")):
            return x
        if x.op == "if" and isinstance(written, ast.Ref):  # an element by a subscript that varies
            return ex.if_else(x.args[0], *map(build, x.args[1:]))
        if x.op != "var":
            raise Diagnostic("R052", "pre is of a variable", written.span, "give the expression a variable of its own")
        return ex.pre(x)

    return elementwise(build, [lower(written, scope)], e.span, "pre")


def _edge(e: ast.Call, scope: Scope) -> Value:
    (written,) = _take(e, 1)

    def build(x: Expr) -> Expr:
        if x.type != BOOLEAN:
            hint = "change(x) is of any variable"
            raise Diagnostic("R020", f"this is {x.type}, Boolean is needed", written.span, hint)
        if x.op != "var":
            hint = "give the expression a Boolean variable of its own"
            raise Diagnostic("R052", "edge is of a Boolean variable", written.span, hint)
        return ex.special("edge", x)

    return elementwise(build, [lower(written, scope)], e.span, "edge")


def _change(e: ast.Call, scope: Scope) -> Value:
    (written,) = _take(e, 1)

    def build(x: Expr) -> Expr:
        if x.op != "var":
            hint = "give the expression a variable of its own"
            raise Diagnostic("R052", "change is of a discrete variable", written.span, hint)
        return ex.special("change", x)

    return elementwise(build, [lower(written, scope)], e.span, "change")


def _no_event(e: ast.Call, scope: Scope) -> Value:
    (written,) = _take(e, 1)
    value = lower(written, scope)
    return elementwise(lambda x: x if x.op == "const" else _wrap("noEvent", x), [value], e.span, "noEvent")


def _wrap(op: str, x: Expr) -> Expr:
    return ex.special(op, x, type=x.type)


def _smooth(e: ast.Call, scope: Scope) -> Value:
    order, written = _take(e, 2)
    degree = lower_scalar(order, scope, INTEGER)
    degree = known(degree, scope, order.span, "the order of smooth")
    if degree.value < 0:
        raise Diagnostic("R053", f"smooth of order {degree.value}", order.span, "the order is 0 or above (3.7.4)")
    value = lower(written, scope)
    for item in scalars(value):
        if not isinstance(item, Expr) or item.type not in (REAL, INTEGER):
            found = item.type if isinstance(item, Expr) else "String"
            raise Diagnostic("R021", f"smooth is applied to a {found}; it needs Real", written.span, "leave it out")
    return elementwise(lambda x: ex.special("smooth", degree, x, type=REAL), [value], e.span, "smooth")


def _by_name(e: ast.Call, names: tuple[str, ...]) -> list[ast.Expression]:
    """The arguments of a built-in operator whose inputs have names, in that order."""
    written = dict(zip(names, e.args, strict=False)) | e.named
    if len(e.args) + len(e.named) != len(names) or set(written) != set(names):
        message = f"{e.function} takes {', '.join(names)}"
        raise Diagnostic("R050", message, e.span, f"{e.function}({', '.join(names)})")
    return [written[name] for name in names]


def _homotopy(e: ast.Call, scope: Scope) -> Value:
    """A choice that `dae.operators.homotopy` takes apart; the simplified expression must fit the actual one."""
    actual, simplified = (lower(a, scope) for a in _by_name(e, ("actual", "simplified")))
    if shape_of(actual) != shape_of(simplified):
        raise Diagnostic("R042", "homotopy of two sizes", e.span, "both expressions need the same size")
    if scope.instance is None:  # in a function
        return actual

    def build(actual: Expr, simplified: Expr) -> Expr:
        varies = actual.type == REAL and not is_parameter(actual, scope.context)
        return ex.if_else(ex.special("homotopy"), actual, simplified) if varies else actual

    return elementwise(build, [actual, simplified], e.span, "homotopy")


def _semi_linear(e: ast.Call, scope: Scope) -> Value:
    """smooth(0, if x >= 0 then k1*x else k2*x) (Modelica 3.6, 3.7.4.5)."""
    x, above, below = (lower(a, scope) for a in _by_name(e, ("x", "positiveSlope", "negativeSlope")))

    def build(x: Expr, above: Expr, below: Expr) -> Expr:
        chosen = ex.if_else(ex.relation(">=", x, ex.const(0)), ex.mul(above, x), ex.mul(below, x))
        return ex.as_real(chosen) if chosen.op == "const" else ex.special("smooth", ex.const(0), chosen, type=REAL)

    return elementwise(build, [x, above, below], e.span, "semiLinear")


def _instance_name(e: ast.Call, scope: Scope) -> Value:
    """getInstanceName(): the name of the model without its package, then the path of the component (3.7.4)."""
    _take(e, 0)
    if scope.instance is None:
        raise Diagnostic("R054", "getInstanceName in a function", e.span, "hand the name over as an argument")
    top = scope.context.model.rpartition(".")[2]
    return f"{top}.{scope.instance.name}" if scope.instance.name else top


def _delay(e: ast.Call, scope: Scope) -> Value:
    """What an expression was some time ago; where no time passes, it itself (3.7.4.1)."""
    if scope.in_function:
        raise Diagnostic("R054", "delay in a function", e.span, "give what is delayed as an argument")
    if e.named or len(e.args) not in (2, 3):
        raise Diagnostic("R050", "delay takes an expression, a time and the longest time", e.span, "delay(e, T, Tmax)")
    seconds, *longest = (lower_scalar(a, scope, REAL) for a in e.args[1:])
    longest = longest or [seconds]
    if not is_parameter(seconds, scope.context):
        hint = "give delayTime as a parameter"
        raise Diagnostic("R091", "a delay by a time that varies is outside the subset", e.args[1].span, hint)

    if seconds.op == "const" and seconds.value < 0:
        raise Diagnostic("R053", f"a delay of {ex.to_text(seconds)} s", e.args[1].span, "a model knows what has passed")
    if seconds.op == longest[0].op == "const" and seconds.value > longest[0].value:
        message = f"a delay of {ex.to_text(seconds)} s where the longest is {ex.to_text(longest[0])} s"
        raise Diagnostic("R053", message, e.args[1].span, "delayMax is not below delayTime (3.7.4.1)")

    at_once = is_zero(seconds, scope.context, e.args[1].span)
    if not at_once:
        message = "the time of delay is positive; for one of 0 give its parameter annotation(Evaluate = true)"
        _require(">", seconds, message, e.args[1].span, scope)

    def build(x: Expr) -> Expr:
        passes = x.op == "const" or is_parameter(x, scope.context) or at_once
        return x if passes else ex.special("delay", x, seconds, *longest, type=REAL)

    return elementwise(build, [lower(e.args[0], scope)], e.span, "delay")


def _sample(e: ast.Call, scope: Scope) -> Value:
    parts = [lower_scalar(a, scope, REAL) for a in _take(e, 2)]
    for value, written in zip(parts, e.args, strict=True):
        if not is_parameter(value, scope.context):
            hint = "start and interval are parameters or constants"
            raise Diagnostic("R053", "sample at times that vary", written.span, hint)
    if parts[1].op == "const" and not parts[1].value > 0:
        raise Diagnostic("R053", f"sample each {ex.to_text(parts[1])} s", e.args[1].span, "an interval is positive")
    _require(">", parts[1], "the interval of sample is positive", e.args[1].span, scope)
    return ex.special("sample", *parts)


class Required(list[flat.Assert]):
    """What operators ask of parameters, whose values a run gives."""


def _require(op: str, value: Expr, message: str, span: Span, scope: Scope) -> None:
    condition = ex.relation(op, value, ex.ZERO)
    known = scope.context.table(Required)
    if condition.op != "const" and all(condition is not k.condition for k in known):
        known.append(flat.Assert(condition, message, span, "error"))


def _phase(op: str) -> Callable[[ast.Call, Scope], Value]:
    def build(e: ast.Call, scope: Scope) -> Value:
        _take(e, 0)
        return ex.special(op)

    return build


def _integer_of(e: ast.Call, scope: Scope) -> Value:
    """Integer(e): the number of an enumeration literal, from 1."""
    (written,) = _take(e, 1)
    return as_integer(lower_scalar(written, scope, INTEGER))


def _size_of_enumeration(e: ast.Call, scope: Scope) -> Value | None:
    if e.args and isinstance(e.args[0], ast.Ref):
        cls = enumeration(e.args[0], scope)
        if cls is not None:
            return ex.const(len(cls.literals))
    return None


def _size(e: ast.Call, scope: Scope) -> Value:
    return _size_of_enumeration(e, scope) or size_of_array(e, scope)


def _scalar_function(count: int) -> Callable[[ast.Call, Scope], Value]:
    return lambda e, scope: map_call(e, scope, count)


SCALAR_FUNCTIONS: dict[str, Handler] = {name: _scalar_function(count) for name, count in ex.BUILTINS.items()}
OPERATORS: dict[str, Handler] = {
    "der": _der, "pre": _pre, "edge": _edge, "change": _change, "noEvent": _no_event, "smooth": _smooth,
    "sample": _sample, "initial": _phase("initial"), "terminal": _phase("terminal"), "String": text_of,
    "Integer": _integer_of, "size": _size, "homotopy": _homotopy, "semiLinear": _semi_linear,
    "getInstanceName": _instance_name, "delay": _delay,
}  # fmt: skip
