"""Loop variables: what they run over, written or implied by what they index (Modelica 3.6, 11.2.2)."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.expressions.constants import known
from lacuna.codegen.flatten.expressions.enumerations import enumeration_of, index_type
from lacuna.codegen.flatten.expressions.lower import lower, lower_scalar
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Value, shape_of, stack
from lacuna.codegen.flatten.references.references import is_known_here, node_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.affine import offset
from lacuna.codegen.symbolic.expr import BOOLEAN, FALSE, INTEGER, REAL, TRUE, Expr
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import references


def iterate(iterator: ast.Iterator, scope: Scope, body: object) -> tuple[Value, ...]:
    """The values a loop variable takes, in order; without a range they follow from what it indexes in `body`."""
    if iterator.range is None:
        return _implied(iterator, scope, body)
    kind = index_type(iterator.range, scope)
    if kind is not None:
        return kind
    value = lower(iterator.range, scope)
    if not isinstance(value, Array):
        raise Diagnostic("R047", f"{iterator.name} runs over a scalar", iterator.span, "write 1:n or an array")
    if len(value.shape) != 1:
        message = f"{iterator.name} runs over an array of {len(value.shape)} dimensions"
        raise Diagnostic("R047", message, iterator.span, "a loop runs over a vector")
    scope.context.spend(value.shape[0], iterator.span)
    return tuple(value.rows())


def _implied(iterator: ast.Iterator, scope: Scope, body: object) -> tuple[Value, ...]:
    """The index set of every dimension that the bare loop variable subscripts; they must be the same."""
    found: tuple[Value, ...] | None = None
    for reference in references(body):
        for at, subscripts in enumerate(reference.subscripts):
            for position, subscript in enumerate(subscripts or ()):
                if isinstance(subscript, ast.Ref) and subscript.names == (iterator.name,):
                    _refuse_whole(reference, at, body)
                    indexed = _index_set(reference, at, position, scope)
                    if found is not None and found != indexed:
                        message = f"{iterator.name} indexes dimensions of different size, or of different type"
                        raise Diagnostic("R047", message, reference.span, f"say what it runs over: {iterator.name} in")
                    found = indexed
    if found is None:
        message = f"{iterator.name} has no range and indexes nothing"
        raise Diagnostic("R047", message, iterator.span, f"say what it runs over: {iterator.name} in 1:n")
    return found


def _refuse_whole(reference: ast.Ref, at: int, body: object) -> None:
    """What a loop takes its range from is not assigned as a whole inside it (11.2.2.1). Raises R058."""
    name = reference.names[: at + 1]
    for item in body if isinstance(body, list) else ():
        if isinstance(item, ast.Assignment) and isinstance(item.target, ast.Ref):
            target = item.target
            if target.names == name and not any(target.subscripts):
                hint = "assign its elements, or say what the loop runs over"
                raise Diagnostic("R058", f"{target} is assigned in the loop that runs over it", target.span, hint)


def _index_set(reference: ast.Ref, at: int, position: int, scope: Scope) -> tuple[Value, ...]:
    """What may stand as subscript number `position` of name number `at`."""
    upto = slice(0, at + 1)
    whole = replace(reference, names=reference.names[upto], subscripts=(*reference.subscripts[:at], None))
    node = node_of(whole, scope)
    if node is not None:
        kinds = node.index_types
        if position < len(kinds) and kinds[position] is not None:
            return kinds[position]
        shape = node.shape
    else:
        shape = shape_of(lower(whole, scope))
    if position >= len(shape):
        raise Diagnostic("R044", f"{whole} has {len(shape)} dimensions", reference.span, "it has too many subscripts")
    return tuple(map(ex.const, range(1, shape[position] + 1)))


def range_values(e: ast.Range, scope: Scope) -> Array:
    """The values of a range of numbers, of an enumeration or of Booleans. Its bounds are known at translation, or vary
    together, so that its size is known: `i:i + 1`."""
    parts = [e.first, e.step, e.last]
    lowered = [lower_scalar(p, scope) if p else None for p in parts]
    moving = _moving(e, *lowered, scope)
    if moving is not None:
        return moving
    values = [
        known(v, scope, p.span, "a bound of the range") if p else None for v, p in zip(lowered, parts, strict=True)
    ]
    first, step, last = values
    given = [v for v in values if v is not None]
    if BOOLEAN in {v.type for v in given}:
        return _booleans(e, first, step, last)
    kinds = {enumeration_of(v, scope.context) for v in given}
    if kinds != {""}:
        if len(kinds) > 1 or step is not None:
            raise Diagnostic("R025", "a range of one enumeration goes from literal to literal", e.span, "E.a:E.c")
        return Array((max(0, last.value - first.value + 1),), tuple(
            ex.const(type(first.value)(n)) for n in range(first.value, last.value + 1)))  # fmt: skip
    kind = float if REAL in {v.type for v in given} else int  # one Real makes all of them Reals (10.4.3)
    return _numbers(e, kind(first.value), 1 if step is None else kind(step.value), last.value, scope)


def varying_bounds(iterator: ast.Iterator, scope: Scope) -> tuple[Expr, Expr, Expr] | None:
    """First value, step and last value of a range of Integers that is not known at translation."""
    e = iterator.range
    if not isinstance(e, ast.Range):
        return None
    step = lower_scalar(e.step, scope) if e.step else ex.const(1)
    first, last = (lower_scalar(b, scope) for b in (e.first, e.last))
    if all(is_known_here(b, scope) for b in (first, last)) or {first.type, step.type, last.type} != {INTEGER}:
        return None
    return first, known(step, scope, e.span, "the step of the range"), last


def _moving(e: ast.Range, first: Expr, step: Expr | None, last: Expr, scope: Scope) -> Array | None:
    """The values of a range of Integers whose bounds vary and are a known number apart; None for any other."""
    whole = first.type == last.type == INTEGER and not enumeration_of(first, scope.context)
    length = offset(last, first) if whole and not is_known_here(first, scope) else None
    if length is None:
        return None
    by = known(step, scope, e.step.span, "the step of the range") if step is not None else ex.const(1)
    steps = _numbers(e, 0, by.value, length, scope)
    return Array(steps.shape, tuple(ex.add(first, k) for k in steps.items))


def _booleans(e: ast.Range, first: Expr, step: Expr | None, last: Expr) -> Array:
    if step is not None or first.type != last.type:
        raise Diagnostic("R047", "a range of Booleans goes from one to the other", e.span, "false:true")
    items = tuple(b for b in (FALSE, TRUE) if first.value <= b.value <= last.value)
    return Array((len(items),), items)


def _numbers(e: ast.Range, first: float, step: float, last: float, scope: Scope) -> Array:
    if step == 0:
        raise Diagnostic("R047", "the step of a range is 0", e.span, "it counts up or down by a step other than 0")
    count = max(0, int((last - first) / step + 1e-9) + 1) if (last - first) / step >= 0 else 0
    scope.context.spend(count, e.span)
    return Array((count,), tuple(ex.const(first + i * step) for i in range(count)))


def comprehension(e: ast.Comprehension, scope: Scope) -> Value:
    """{e for i in r}: the values of e in order, a new first dimension for each iterator."""
    first, rest = e.iterators[-1], e.iterators[:-1]
    inner = ast.Comprehension(e.span, e.body, rest) if rest else e.body
    rows = [lower(inner, scope.with_locals(**{first.name: v})) for v in iterate(first, scope, e.body)]
    return stack(rows, e.span)


RANGES = {ast.Range: range_values, ast.Comprehension: comprehension}
