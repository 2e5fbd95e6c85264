"""Values of expressions while flattening: a scalar `Expr`, a string, an `Array` of either, a `Record`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from math import prod

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.symbolic.expr import Expr, const


@dataclass(frozen=True, slots=True)
class Array:
    """Elements in row-major order; `shape` has at least one dimension."""

    shape: tuple[int, ...]
    items: tuple[Expr | str | Record, ...]

    def rows(self) -> list[Value]:
        """Along the first dimension."""
        if len(self.shape) == 1:
            return list(self.items)
        return [self.row(i) for i in range(self.shape[0])]

    def row(self, i: int) -> Value:
        """Number `i`, from 0, along the first dimension."""
        if len(self.shape) == 1:
            return self.items[i]
        step = prod(self.shape[1:])
        return Array(self.shape[1:], self.items[i * step : (i + 1) * step])


@dataclass(frozen=True, slots=True)
class Record:
    """Fields by name, in the order of their declaration; `cls` (an ast.Class) is what it is a record of."""

    name: str
    fields: dict[str, Value]
    cls: object = None


@dataclass(frozen=True, slots=True)
class FunctionValue:
    """A function as a value, some of its inputs bound (Modelica 3.6, 12.4.2)."""

    cls: object  # ast.Class
    bound: dict[str, Value]


@dataclass(frozen=True, slots=True)
class ExternalValue:
    """An external object: what its constructor made of its arguments."""

    cls: object  # ast.Class
    data: object


@dataclass(frozen=True, slots=True)
class ChosenText:
    """A String that is chosen at run time: (condition, text), the first whose condition holds; the last one's does."""

    alternatives: tuple[tuple[Expr, str], ...]

    @property
    def type(self) -> str:
        return "String"


Value = Expr | str | ChosenText | Array | Record | FunctionValue | ExternalValue


def shape_of(value: Value) -> tuple[int, ...]:
    return value.shape if isinstance(value, Array) else ()


def shape_text(shape: tuple[int, ...]) -> str:
    return "a scalar" if not shape else "[" + ", ".join(map(str, shape)) + "]"


def scalars(value: Value) -> list[Expr | str | ChosenText]:
    """Every scalar inside, in order."""
    if isinstance(value, Array):
        plain = not any(isinstance(i, Record) for i in value.items)
        return list(value.items) if plain else [s for i in value.items for s in scalars(i)]
    if isinstance(value, Record):
        return [s for field in value.fields.values() for s in scalars(field)]
    if isinstance(value, FunctionValue):
        return [s for bound in value.bound.values() for s in scalars(bound)]
    return [] if isinstance(value, ExternalValue) else [value]


def expressions_of(scalar: Expr | str | ChosenText) -> list[Expr]:
    """The expressions that a scalar is or, of a String, is chosen by."""
    if isinstance(scalar, ChosenText):
        return [condition for condition, _ in scalar.alternatives]
    return [scalar] if isinstance(scalar, Expr) else []


def is_open(scalar: Expr | str | ChosenText) -> bool:
    """Is a scalar no number and no text yet?"""
    return any(e.op != "const" for e in expressions_of(scalar))


def with_scalars(value: Value, new: Iterator[Expr | str]) -> Value:
    """A value built as `value` is, of other scalars."""
    if isinstance(value, Record):
        return Record(value.name, {n: with_scalars(v, new) for n, v in value.fields.items()}, value.cls)
    if isinstance(value, Array):
        return Array(value.shape, tuple(with_scalars(i, new) for i in value.items))
    return value if isinstance(value, FunctionValue | ExternalValue) else next(new)


def items_of(value: Value) -> tuple[Value, ...]:
    """The elements of an array, records whole; anything else is one element."""
    return value.items if isinstance(value, Array) else (value,)


def holds_records(value: Value) -> bool:
    return not isinstance(value, Expr) and any(isinstance(i, Record) for i in items_of(value))


def indices(shape: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """1-based index tuples in row-major order."""
    return product(*(range(1, n + 1) for n in shape))


def stack(rows: list[Value], span: Span) -> Array:
    """A new first dimension over equally shaped values."""
    shapes = {shape_of(r) for r in rows}
    if len(shapes) > 1:
        found = " and ".join(shape_text(s) for s in sorted(shapes))
        hint = "every element of an array has the same size"
        raise Diagnostic("R040", f"the elements differ in size: {found}", span, hint)
    if any(isinstance(r, FunctionValue | ExternalValue) for r in rows):
        raise Diagnostic("R041", "an array of functions or external objects", span, "use them one by one")
    shape = shapes.pop() if shapes else ()
    return Array((len(rows), *shape), tuple(s for r in rows for s in items_of(r)))


def elementwise(function: Callable[..., Expr], values: list[Value], span: Span, what: str) -> Value:
    """`function` on corresponding elements; scalars go with every element."""
    if all(isinstance(v, Expr) for v in values):
        return function(*values)
    for v in values:
        if isinstance(v, FunctionValue | ExternalValue):
            raise Diagnostic("R041", f"{what} of a function or an external object", span, "it works on numbers")
        if any(isinstance(i, Record | str | ChosenText) for i in items_of(v)):
            found = "a record" if holds_records(v) else "a String"
            raise Diagnostic("R041", f"{what} of {found}", span, "it works on numbers and Booleans")
    shapes = {v.shape for v in values if isinstance(v, Array)}
    if not shapes:
        return function(*values)
    if len(shapes) > 1:
        first, second = (shape_text(shape_of(v)) for v in values[:2])
        raise Diagnostic("R042", f"{what} of sizes {first} and {second}", span, "both sides need the same size")
    shape = shapes.pop()
    columns = [v.items if isinstance(v, Array) else (v,) * prod(shape) for v in values]
    return Array(shape, tuple(function(*row) for row in zip(*columns, strict=True)))


def fold(join: Callable[[Expr, Expr], Expr], items: list[Expr]) -> Expr:
    """All items joined: from the left, and in halves where they are many, so that no expression is as deep as long."""
    if len(items) > 64:
        middle = len(items) // 2
        return join(fold(join, items[:middle]), fold(join, items[middle:]))
    result = items[0]
    for item in items[1:]:
        result = join(result, item)
    return result


def transpose(a: Array) -> Array:
    """The first two dimensions in each other's place."""
    (rows, columns), rest = a.shape[:2], a.shape[2:]
    step = prod(rest)
    places = ((i * columns + j) * step for j in range(columns) for i in range(rows))
    return Array((columns, rows, *rest), tuple(item for at in places for item in a.items[at : at + step]))


def integers(values: list[int]) -> Array:
    return Array((len(values),), tuple(const(v) for v in values))


def promote(value: Value, dimensions: int) -> Array:
    """`value` with sizes of 1 added on the right up to so many dimensions."""
    shape = shape_of(value)
    return Array(shape + (1,) * (dimensions - len(shape)), items_of(value))


def concatenate(along: int, parts: list[Array], span: Span) -> Array:
    """Arrays joined along a dimension (from 1); the other sizes agree. Raises R042."""
    if along == 1:
        if len({p.shape[1:] for p in parts}) > 1:
            found = " and ".join(shape_text(p.shape) for p in parts)
            raise Diagnostic("R042", f"arrays of sizes {found} side by side", span, "their other sizes must agree")
        items = tuple(i for p in parts for i in p.items)
        return Array((sum(p.shape[0] for p in parts), *parts[0].shape[1:]), items)
    if len({p.shape[0] for p in parts}) > 1:
        found = " and ".join(shape_text(p.shape) for p in parts)
        raise Diagnostic("R042", f"arrays of sizes {found} side by side", span, "they need equally many rows")
    if not parts[0].shape[0]:
        joined_size = sum(p.shape[along - 1] for p in parts)
        return Array((*parts[0].shape[: along - 1], joined_size, *parts[0].shape[along:]), ())
    rows = zip(*(p.rows() for p in parts), strict=True)
    joined = [concatenate(along - 1, list(row), span) for row in rows]
    return stack(joined, span)
