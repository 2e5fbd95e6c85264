"""Expressions of the source that must be known at translation."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.expressions.constants import known
from lacuna.codegen.flatten.expressions.enumerations import index_type
from lacuna.codegen.flatten.expressions.lower import lower, modifier_value
from lacuna.codegen.flatten.names.modifiers import Modifier
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Value, shape_of
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import references

MAX_SIZE = 100_000


def evaluate_boolean(e: ast.Expression, scope: Scope, what: str = "the condition") -> bool:
    value = lower(e, scope)
    if isinstance(value, str | Array) or getattr(value, "type", None) != BOOLEAN:
        raise Diagnostic("R020", f"{what} is not a Boolean", e.span, "use a comparison, or a Boolean parameter")
    return bool(known(value, scope, e.span, what).value)


def evaluate_integer(e: ast.Expression, scope: Scope, what: str) -> int:
    value = lower(e, scope)
    if isinstance(value, str | Array) or getattr(value, "type", None) != INTEGER:
        raise Diagnostic("R020", f"{what} is not an Integer", e.span, "use a whole number or an Integer parameter")
    return int(known(value, scope, e.span, what).value)


def evaluate_dimensions(
    dimensions: list[ast.Expression], scope: Scope, modifier: Modifier | None, name: str
) -> list[int]:
    """Sizes of a declaration; `:` takes the size of the binding in `modifier`, or of the start values."""
    result = []
    bound: Value | None = None
    for position, dimension in enumerate(dimensions):
        if isinstance(dimension, ast.Colon):
            if bound is None:
                bound = _given(modifier)
            if bound is None:
                hint = "give a size, or bind it to an array"
                raise Diagnostic("R043", f"the size of {name} is unknown", dimension.span, hint)
            shape = shape_of(bound)
            if position >= len(shape):
                raise _of_fewer_dimensions(name, dimensions, shape, modifier)
            result.append(shape[position])
            continue
        size = _dimension(dimension, _knowing_itself(dimension, scope, modifier, name), name)
        if not 0 <= size <= MAX_SIZE:
            raise Diagnostic("R043", f"{name} has size {size}", dimension.span, f"sizes are from 0 to {MAX_SIZE}")
        result.append(size)
    return result


def _of_fewer_dimensions(
    name: str, dimensions: list[ast.Expression], shape: tuple[int, ...], modifier: Modifier
) -> Diagnostic:
    given = "a scalar" if not shape else f"an array of {len(shape)} dimension{'s' if len(shape) > 1 else ''}"
    hint = "bind it to an array, {1, 2}" if len(dimensions) == 1 else "write a matrix by rows: [1, 2; 3, 4]"
    message = f"{name} has {len(dimensions)} dimension{'s' if len(dimensions) > 1 else ''} and is bound to {given}"
    error = Diagnostic("R043", message, modifier.span, hint)
    error.notes.append((dimensions[0].span, "declared here"))
    return error


def _given(modifier: Modifier | None) -> Value | None:
    """The binding, or without one an array of start values."""
    if modifier is None or modifier.value is not None:
        return None if modifier is None else modifier_value(modifier)
    start = modifier.children.get("start")
    return modifier_value(start) if start is not None and start.value is not None and not start.each else None


def _knowing_itself(e: ast.Expression, scope: Scope, modifier: Modifier | None, name: str) -> Scope:
    """`scope` for a size that asks for the binding's: `A[:, size(A, 1)]` (10.1)."""
    bound = modifier is not None and modifier.value is not None
    if not bound or name in scope.locals or not any(r.names == (name,) for r in references(e)):
        return scope
    return scope.with_locals(**{name: modifier_value(modifier)})


def _dimension(e: ast.Expression, scope: Scope, name: str) -> int:
    kind = index_type(e, scope)
    if kind is not None:
        return len(kind)
    return evaluate_integer(e, scope, f"the size of {name}")
