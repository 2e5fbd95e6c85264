"""Array functions of the language: sizes, constructors, reductions, concatenation, a little linear algebra."""

from __future__ import annotations

from collections.abc import Callable
from math import prod

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import known
from lacuna.codegen.flatten.expressions.lower import Handler, lower, need_numbers
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import (  # fmt: skip
    Array,
    Value,
    concatenate,
    elementwise,
    integers,
    items_of,
    promote,
    scalars,
    shape_of,
    shape_text,
    transpose,
)
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import INTEGER, Expr
from lacuna.codegen.syntax import ast


def arguments_of(e: ast.Call, scope: Scope, least: int, most: int) -> list[Value]:
    hint = "arguments of built-in functions are given by position"
    for name, value in e.named.items():
        raise Diagnostic("R050", f"{e.function} has no argument named {name}", value.span, hint)
    if not least <= len(e.args) <= most:
        wanted = str(least) if least == most else f"{least} to {most}" if most < 99 else f"at least {least}"
        message = f"{e.function} takes {wanted} argument{'' if wanted == '1' else 's'}, given {len(e.args)}"
        raise Diagnostic("R050", message, e.span, hint)
    return [lower(a, scope) for a in e.args]


def _number(value: Value, scope: Scope, span: Span, what: str) -> int:
    if not isinstance(value, Expr) or value.type != INTEGER:
        raise Diagnostic("R020", f"{what} is not an Integer", span, "use a whole number or an Integer parameter")
    number = known(value, scope, span, what).value
    if not 0 <= number <= 1_000_000:
        raise Diagnostic("R043", f"{what} is {number}", span, "sizes are from 0 to 1000000")
    return number


def array_of(value: Value, e: ast.Call, dimensions: tuple[int, ...] = ()) -> Array:
    if not isinstance(value, Array) or (dimensions and len(value.shape) not in dimensions):
        wanted = " or ".join({1: "a vector", 2: "a matrix"}[d] for d in dimensions) or "an array"
        message = f"{e.function} needs {wanted}, given {shape_text(shape_of(value))}"
        raise Diagnostic("R051", message, e.span, "see the array functions in docs/language.md")
    return value


def size_of_array(e: ast.Call, scope: Scope) -> Value:
    arguments = arguments_of(e, scope, 1, 2)
    shape = shape_of(arguments[0])
    if len(arguments) == 1:
        return integers(list(shape))
    dimension = _number(arguments[1], scope, e.span, "the dimension")
    if not 1 <= dimension <= len(shape):
        hint = f"it has {len(shape)} dimensions"
        raise Diagnostic("R051", f"size: dimension {dimension} of {shape_text(shape)}", e.span, hint)
    return ex.const(shape[dimension - 1])


def _ndims(e: ast.Call, scope: Scope) -> Value:
    return ex.const(len(shape_of(arguments_of(e, scope, 1, 1)[0])))


def _filled(value: Value, sizes: list[Value], e: ast.Call, scope: Scope) -> Array:
    shape = tuple(_number(s, scope, e.span, "a size") for s in sizes)
    scope.context.spend(prod(shape), e.span)
    return Array(shape + shape_of(value), items_of(value) * prod(shape))


def _fill(e: ast.Call, scope: Scope) -> Value:
    value, *sizes = arguments_of(e, scope, 2, 99)
    return _filled(value, sizes, e, scope)


def _constant_array(value: int) -> Callable[[ast.Call, Scope], Value]:
    return lambda e, scope: _filled(ex.const(value), arguments_of(e, scope, 1, 99), e, scope)


def _identity(e: ast.Call, scope: Scope) -> Value:
    n = _number(arguments_of(e, scope, 1, 1)[0], scope, e.span, "a size")
    scope.context.spend(n * n, e.span)
    return Array((n, n), tuple(ex.const(int(i == j)) for i in range(n) for j in range(n)))


def _diagonal(e: ast.Call, scope: Scope) -> Value:
    v = array_of(arguments_of(e, scope, 1, 1)[0], e, (1,)).items
    scope.context.spend(len(v) ** 2, e.span)
    n = range(len(v))
    return Array((len(v), len(v)), tuple(v[i] if i == j else ex.const(0) for i in n for j in n))


def _linspace(e: ast.Call, scope: Scope) -> Value:
    first, last, count = arguments_of(e, scope, 3, 3)
    for end in (first, last):
        need_numbers(end, e.span, "linspace")
    n = _number(count, scope, e.span, "the count")
    if n < 2:
        raise Diagnostic("R051", f"linspace of {n} points", e.span, "it needs at least 2")
    scope.context.spend(n, e.span)
    step = ex.div(ex.sub(last, first), ex.const(float(n - 1)))
    return Array((n,), tuple(ex.add(first, ex.mul(ex.const(float(i)), step)) for i in range(n)))


def _transpose(e: ast.Call, scope: Scope) -> Value:
    """The first two dimensions change places (10.3.5)."""
    value = array_of(arguments_of(e, scope, 1, 1)[0], e)
    if len(value.shape) < 2:
        hint = "it needs two dimensions: docs/language.md"
        raise Diagnostic("R051", f"transpose of {shape_text(value.shape)}", e.span, hint)
    return transpose(value)


def _cross(e: ast.Call, scope: Scope) -> Value:
    a, b = (array_of(v, e, (1,)).items for v in arguments_of(e, scope, 2, 2))
    if len(a) != 3 or len(b) != 3:
        raise Diagnostic("R051", "cross needs two vectors of 3", e.span, "a cross product lives in space")
    pairs = ((1, 2), (2, 0), (0, 1))
    return Array((3,), tuple(ex.sub(ex.mul(a[i], b[j]), ex.mul(a[j], b[i])) for i, j in pairs))


def _vector(e: ast.Call, scope: Scope) -> Value:
    value = arguments_of(e, scope, 1, 1)[0]
    if sum(n > 1 for n in shape_of(value)) > 1:
        hint = "at most one dimension is larger than 1 (10.3.2); [A[1, :], A[2, :]] puts rows side by side"
        raise Diagnostic("R051", f"vector of {shape_text(shape_of(value))} elements", e.span, hint)
    items = scalars(value)
    return Array((len(items),), tuple(items))


def _scalar(e: ast.Call, scope: Scope) -> Value:
    items = scalars(arguments_of(e, scope, 1, 1)[0])
    if len(items) != 1:
        raise Diagnostic("R051", f"scalar of {len(items)} elements", e.span, "it takes an array of one")
    return items[0]


def _cat(e: ast.Call, scope: Scope) -> Value:
    along, *parts = arguments_of(e, scope, 2, 99)
    dimension = _number(along, scope, e.span, "the dimension")
    arrays = [array_of(p, e) for p in parts]
    if not 1 <= dimension <= min(len(a.shape) for a in arrays):
        raise Diagnostic("R051", f"cat along dimension {dimension}", e.span, "the arrays have fewer dimensions")
    return concatenate(dimension, arrays, e.span)


def _matrix(e: ast.Call, scope: Scope) -> Value:
    """The first two sizes; those after must be 1."""
    value = promote(arguments_of(e, scope, 1, 1)[0], 2)
    if any(n != 1 for n in value.shape[2:]):
        raise Diagnostic("R051", f"matrix of {shape_text(value.shape)}", e.span, "sizes after the second are 1")
    return Array(value.shape[:2], value.items)


def _outer_product(e: ast.Call, scope: Scope) -> Value:
    a, b = (array_of(v, e, (1,)).items for v in arguments_of(e, scope, 2, 2))
    return Array((len(a), len(b)), tuple(ex.mul(x, y) for x in a for y in b))


def _symmetric(e: ast.Call, scope: Scope) -> Value:
    """The upper triangle, mirrored."""
    a = array_of(arguments_of(e, scope, 1, 1)[0], e, (2,))
    n = range(a.shape[0])
    if a.shape[0] != a.shape[1]:
        raise Diagnostic("R051", f"symmetric of {shape_text(a.shape)}", e.span, "it needs a square matrix")
    return Array(a.shape, tuple(a.items[min(i, j) * len(n) + max(i, j)] for i in n for j in n))


def _skew(e: ast.Call, scope: Scope) -> Value:
    """The matrix of a cross product: skew(x)*y = cross(x, y)."""
    x = array_of(arguments_of(e, scope, 1, 1)[0], e, (1,)).items
    if len(x) != 3:
        raise Diagnostic("R051", "skew needs a vector of 3", e.span, "a cross product lives in space")
    zero = ex.const(0)
    return Array((3, 3), (zero, ex.neg(x[2]), x[1], x[2], zero, ex.neg(x[0]), ex.neg(x[1]), x[0], zero))


_DOMAINS: dict[str, tuple[Callable[[float], bool], str]] = {
    "sqrt": (lambda x: x >= 0, "numbers from 0"), "log": (lambda x: x > 0, "numbers above 0"),
    "log10": (lambda x: x > 0, "numbers above 0"), "asin": (lambda x: abs(x) <= 1, "numbers from -1 to 1"),
    "acos": (lambda x: abs(x) <= 1, "numbers from -1 to 1"),
}  # fmt: skip
_QUOTIENTS = ("div", "mod", "rem")


def map_call(e: ast.Call, scope: Scope, count: int) -> Value:
    """A scalar built-in, element by element where it is given arrays."""
    arguments = arguments_of(e, scope, count, count)
    name = str(e.function)
    for a, written in zip(arguments, e.args, strict=True):
        need_numbers(a, written.span, name, scope.context)
        for item in scalars(a):
            if name in _DOMAINS and item.op == "const" and not _DOMAINS[name][0](item.value) and not scope.conditional:
                message = f"{name}({ex.to_text(item)}) does not exist"
                raise Diagnostic("R064", message, written.span, f"{name} takes {_DOMAINS[name][1]}")
    if name in _QUOTIENTS and any(ex.is_const(item, 0) for item in scalars(arguments[1])):
        raise Diagnostic("R046", f"{name}: division by zero", e.span, "the divisor is the constant 0")
    return elementwise(lambda *xs: ex.call(name, *xs), arguments, e.span, f"arguments of {name}")


def _elements(e: ast.Call, scope: Scope) -> Value:
    """array(a, b, c) is {a, b, c}, array(e for i in r) is {e for i in r} (10.4)."""
    if e.named or not e.args:
        raise Diagnostic("R050", "array takes its elements", e.span, "array(a, b, c)")
    return lower(e.args[0] if isinstance(e.args[0], ast.Comprehension) else ast.ArrayLiteral(e.span, e.args), scope)


FUNCTIONS: dict[str, Handler] = {
    "array": _elements, "size": size_of_array, "ndims": _ndims, "fill": _fill,
    "zeros": _constant_array(0), "ones": _constant_array(1),
    "identity": _identity, "diagonal": _diagonal, "linspace": _linspace, "transpose": _transpose, "cross": _cross,
    "vector": _vector, "scalar": _scalar, "matrix": _matrix, "cat": _cat,
    "outerProduct": _outer_product, "symmetric": _symmetric, "skew": _skew,
}  # fmt: skip
