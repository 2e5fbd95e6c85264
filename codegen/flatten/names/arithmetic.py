"""Sums, products, quotients and powers of scalars and arrays (Modelica 3.6, 10.6)."""

from __future__ import annotations

from collections.abc import Callable

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.names.values import Array, Value, elementwise, fold, shape_of, shape_text, transpose
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import INTEGER, ZERO, Expr, add, mul


def multiply(a: Value, b: Value, span: Span) -> Value:
    """a*b of linear algebra: scalar with anything, vector with vector (a scalar), matrix with vector or matrix."""
    if not (isinstance(a, Array) and isinstance(b, Array)):
        return elementwise(mul, [a, b], span, "a product")
    if a.shape[-1] != b.shape[0] or max(len(a.shape), len(b.shape)) > 2:
        message = f"a product of sizes {shape_text(a.shape)} and {shape_text(b.shape)}"
        raise Diagnostic("R042", message, span, "inner sizes must agree; .* multiplies element by element")
    if len(a.shape) == 1 and len(b.shape) == 1:
        return dot(a.items, b.items)
    rows = a.rows() if len(a.shape) == 2 else [a]
    columns = transpose(b).rows() if len(b.shape) == 2 else [b]
    items = tuple(dot(r.items, c.items) for r in rows for c in columns)
    shape = tuple(n for n in (a.shape[:-1] + b.shape[1:]))
    return Array(shape, items)


def dot(a: tuple[Expr, ...], b: tuple[Expr, ...]) -> Expr:
    return fold(add, [mul(x, y) for x, y in zip(a, b, strict=True)]) if a else ZERO


def _same_size(function: Callable[[Expr, Expr], Expr], what: str) -> Callable[[Value, Value, Span], Value]:
    def build(a: Value, b: Value, span: Span) -> Value:
        if shape_of(a) != shape_of(b):
            elementwise_name = {"a sum": ".+", "a difference": ".-"}[what]
            if not (shape_of(a) and shape_of(b)):
                hint = f"{elementwise_name} works on every element"
                raise Diagnostic("R042", f"{what} of an array and a scalar", span, hint)
        return elementwise(function, [a, b], span, what)

    return build


def _each(function: Callable[[Expr, Expr], Expr], what: str) -> Callable[[Value, Value, Span], Value]:
    return lambda a, b, span: elementwise(function, [a, b], span, what)


def _divide(a: Value, b: Value, span: Span) -> Value:
    if isinstance(b, Array):
        raise Diagnostic("R042", "division by an array", span, "./ divides element by element")
    return _quotient(a, b, span)


def _quotient(a: Value, b: Value, span: Span) -> Value:
    if any(ex.is_const(d, 0) for d in (b.items if isinstance(b, Array) else (b,))):
        raise Diagnostic("R046", "division by zero", span, "the denominator is the constant 0")
    return elementwise(ex.div, [a, b], span, "a quotient")


def _power(a: Value, b: Value, span: Span) -> Value:
    if not (isinstance(a, Array) or isinstance(b, Array)):
        return ex.power(a, b)
    whole = isinstance(b, Expr) and b.op == "const" and b.type == INTEGER and b.value >= 0
    if not whole or len(shape_of(a)) != 2 or a.shape[0] != a.shape[1]:
        hint = "a square matrix has powers to whole numbers from 0 known at translation; .^ works on every element"
        raise Diagnostic("R042", "a power of an array", span, hint)
    size = range(a.shape[0])
    result: Value = Array(a.shape, tuple(ex.const(float(i == j)) for i in size for j in size))
    for digit in f"{int(b.value):b}":  # by squares: as many products as b has binary digits, twice at most
        result = multiply(result, result, span)
        result = multiply(result, a, span) if digit == "1" else result
    return result


ARITHMETIC: dict[str, Callable[[Value, Value, Span], Value]] = {
    "+": _same_size(ex.add, "a sum"), "-": _same_size(ex.sub, "a difference"), "*": multiply, "/": _divide,
    "^": _power, ".+": _each(ex.add, "a sum"), ".-": _each(ex.sub, "a difference"), ".*": _each(ex.mul, "a product"),
    "./": _quotient, ".^": _each(ex.power, "a power"),
}  # fmt: skip
