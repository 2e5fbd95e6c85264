"""Names in expressions: the component, constant or enumeration literal they mean, with subscripts applied."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
import math
import re

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Absent, ArrayNode, Instance, Node
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.classes.types import resolve_type
from lacuna.codegen.flatten.expressions.choices import chosen_value
from lacuna.codegen.flatten.expressions.constants import is_known, known, variability
from lacuna.codegen.flatten.expressions.enumerations import IndexType, enumeration_of, index_number
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.names.elements import at_index
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import (
    Array,
    Record,
    Value,
    holds_records,
    scalars,
    shape_of,
    stack,
    with_scalars,
)
from lacuna.codegen.flatten.references.class_values import from_class
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, Expr
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.syntax import ast
from lacuna.suggest import did_you_mean


def read(ref: ast.Ref, scope: Scope) -> Value:
    """The value of a name in an expression."""
    first = ref.names[0]
    if first in scope.locals:
        return read_local(ref, scope)
    if first == "time" and len(ref.names) == 1:
        if scope.cls.kind in ("function", "record", "connector"):
            raise Diagnostic(
                "R070", f"time in a {scope.cls.kind}", ref.span, "models and blocks know the time; hand it on"
            )
        return apply_subscripts(ex.TIME, ref.subscripts[0], scope, ref)
    node = None
    if scope.instance is not None and not ref.absolute and scope.instance.sees(first, scope.cls):
        node = scope.instance.meant(first)
    if node is not None:
        refuse_conditional(scope.instance, first, ref)
        _refuse_beyond_outer(node, ref, scope)
        return _walk(node, ref, 0, scope)
    found = from_class(ref, scope)
    if isinstance(found, Expr):  # a literal
        return apply_subscripts(found, ref.subscripts[-1], scope, ref)
    return _walk(found[0], ref, found[1], scope)


def _refuse_beyond_outer(node: Node, ref: ast.Ref, scope: Scope) -> None:
    """Raises R003 for what an inner component has and the type of the outer declaration has not (5.4)."""
    element = scope.instance.elements[ref.names[0]]
    if not element.declaration.outer or len(ref.names) < 2 or not isinstance(node, Instance) or node.cls.expandable:
        return
    wanted = resolve_type(element.declaration.type, Scope(scope.context, element.cls)).cls
    if wanted is None or wanted is node.cls:
        return
    known = Instance(scope.context, wanted, "", None, None).elements
    if ref.names[1] in node.elements and ref.names[1] not in known:
        hint = did_you_mean(ref.names[1], known, f"{wanted.name} has {', '.join(known)}")
        raise Diagnostic("R003", f"the outer {ref.names[0]} is a {wanted.name} without {ref.names[1]}", ref.span, hint)


def read_local(ref: ast.Ref, scope: Scope) -> Value:
    """What a name means that starts with a loop variable, or with a variable of a function."""
    kinds = scope.index_types.get(ref.names[0])
    return _further(apply_subscripts(scope.locals[ref.names[0]], ref.subscripts[0], scope, ref, kinds), ref, 1, scope)


def _further(value: Value, ref: ast.Ref, at: int, scope: Scope) -> Value:
    """From `value` along the names from number `at` on, of an array of records in each of them (10.6.9)."""
    if at == len(ref.names):
        return value
    if isinstance(value, Array) and value.items and holds_records(value):
        stacked = stack([_further(record, ref, at, scope) for record in value.items], ref.span)
        return Array(value.shape + stacked.shape[1:], stacked.items)
    element = _element_of(value, ref.names[at], ref)
    return _further(apply_subscripts(element, ref.subscripts[at], scope, ref), ref, at + 1, scope)


def read_part(e: ast.Part, scope: Scope) -> Value:
    """Elements of the value of an expression in parentheses."""
    value, ref = lower(e.whole, scope), ast.Ref(e.span, ("this expression",), (None,))
    return _element_of(value, e.name, ref) if e.name else apply_subscripts(value, e.subscripts, scope, ref)


def _element_of(value: Value, name: str, ref: ast.Ref) -> Value:
    """One field of a record, or of every record of an array."""
    if isinstance(value, Array) and value.items and holds_records(value):
        stacked = stack([_element_of(record, name, ref) for record in value.items], ref.span)
        return Array(value.shape + stacked.shape[1:], stacked.items)
    if not isinstance(value, Record):
        raise Diagnostic("R003", f"{ref.names[0]} has no element {name}", ref.span, "only records have elements")
    if name not in value.fields:
        hint = did_you_mean(name, value.fields, f"{value.name} has {', '.join(value.fields)}")
        raise Diagnostic("R003", f"{value.name} has no element {name}", ref.span, hint)
    return value.fields[name]


def _walk(node: Node, ref: ast.Ref, at: int, scope: Scope) -> Value:
    """From `node`, which name number `at` means, to the value at the end of the name."""
    subscripts = ref.subscripts[at]
    last = at == len(ref.names) - 1
    if isinstance(node, Absent):
        hint = "it can only be connected: connect it to a component of your own, and use that"
        error = Diagnostic("R016", f"{node.name} does not exist here: its condition is false", ref.span, hint)
        error.notes.append((node.span, "declared here"))
        raise error
    if isinstance(node, Leaf):
        if not last:
            hint = f"{node.name} is a {node.primitive}"
            raise Diagnostic("R003", f"{node.name} has no element {ref.names[at + 1]}", ref.span, hint)
        return apply_subscripts(node.value(), subscripts, scope, ref, node.index_types)
    if isinstance(node, ArrayNode):
        return _walk_array(node, ref, at, scope)
    assert isinstance(node, Instance)
    if subscripts is not None:
        raise Diagnostic("R044", f"{node.name} is no array", ref.span, "remove the subscript")
    if last:
        return Record(node.name, {name: _field(node.child(name), ref, scope) for name in node.elements}, node.cls)
    if ref.names[at + 1] in node.elements:
        refuse_conditional(node, ref.names[at + 1], ref)
    return _walk(member(node, ref, at + 1), ref, at + 1, scope)


def refuse_conditional(instance: Instance, name: str, ref: ast.Ref) -> None:
    """Modelica 3.6, 4.4.5: a component with a condition is used in connections only."""
    declaration = instance.elements[name].declaration
    if declaration.condition is not None:
        hint = "it can only be connected: connect it to a component of your own, and use that"
        error = Diagnostic("R016", f"{name} is conditional and can only be connected", ref.span, hint)
        error.notes.append((declaration.span, "declared here"))
        raise error


def member(node: Node, ref: ast.Ref, at: int) -> Node:
    """The element that name number `at` means in the component before it; it must exist and be public."""
    name = ref.names[at]
    found = node.meant(name) if isinstance(node, Instance) else node.child(name)
    if found is None:
        hint = did_you_mean(name, node.elements, f"{node.cls.name} has {', '.join(list(node.elements)[:12])}")
        raise Diagnostic("R003", f"{node.name} has no element {name}", ref.span, hint)
    if node.elements[name].declaration.protected:
        error = Diagnostic("R017", f"{name} is protected in {node.cls.name}", ref.span, "make it public to use it here")
        error.notes.append((node.elements[name].declaration.span, "declared here"))
        raise error
    return found


def _field(node: Node, ref: ast.Ref, scope: Scope) -> Value:
    return _walk(node, replace(ref, names=("",), subscripts=(None,)), 0, scope)


def _walk_array(node: Node, ref: ast.Ref, at: int, scope: Scope) -> Value:
    subscripts = ref.subscripts[at]
    part = replace(ref, names=ref.names[: at + 1])
    picked = apply_subscripts(node.numbers, subscripts, scope, part, node.index_types)
    inner = ref.subscripts[:at] + (None,) + ref.subscripts[at + 1 :]
    plain = replace(ref, subscripts=inner)
    if isinstance(picked, Expr):
        return _numbered(node, picked, plain, at, scope)
    values = [_numbered(node, p, plain, at, scope) for p in picked.items]
    stacked = stack(values, ref.span)
    return Array(picked.shape + stacked.shape[1:], stacked.items)


def _numbered(node: ArrayNode, number: Expr, ref: ast.Ref, at: int, scope: Scope) -> Value:
    """From the element of that number; where it changes at run time, `number` chooses among constants, of which one may
    be that of no element."""
    if ex.is_nothing(number):
        value = _walk(node.items[0], ref, at, scope)
        return with_scalars(value, (ex.nothing(s.type) if isinstance(s, Expr) else s for s in scalars(value)))
    if number.op == "const":
        return _walk(node.items[number.value - 1], ref, at, scope)
    condition, *numbers = number.args
    return chosen_value(condition, *(_numbered(node, n, ref, at, scope) for n in numbers), ref.span, scope)


def apply_subscripts(
    value: Value,
    subscripts: tuple[ast.Expression, ...] | None,
    scope: Scope,
    ref: ast.Ref,
    kinds: tuple[IndexType, ...] | None = None,
) -> Value:
    """value[i, :, {1, 3}]: each subscript is a number, `:` or a vector of numbers; rows come first. `kinds` are the
    types of the dimensions; where they are not known (None), any type that can index will do."""
    if subscripts is None:
        return value
    shape = shape_of(value)
    if len(subscripts) > len(shape):
        message = f"{ref} has {len(shape)} dimensions and {len(subscripts)} subscripts"
        raise Diagnostic("R044", message, ref.span, "give one subscript for each dimension")
    if not subscripts:
        return value
    first, rest = subscripts[0], subscripts[1:]
    later = kinds[1:] if kinds is not None else None

    def part(row: Value) -> Value:
        return apply_subscripts(row, rest, scope, ref, later)

    if isinstance(first, ast.Colon):
        return _stacked(value.rows(), value, part, ref)
    last = kinds[0][-1] if kinds and kinds[0] else ex.const(shape[0])
    index = _index(first, kinds, replace(scope, end=last), ref)
    if not isinstance(index, Array):
        return _picked(value, index, part, scope, ref, first)
    picked = [_picked(value, i, part, scope, ref, first) for i in index.items]
    return stack(picked, ref.span) if picked else _stacked([], value, part, ref)


def _picked(
    value: Array, index: Expr, part: Callable[[Value], Value], scope: Scope, ref: ast.Ref, written: ast.Expression
) -> Value:
    """A part of the row of that number, which may be known only at run time."""
    if index.op == "const" or is_known_here(index, scope):
        return part(_row(value, index, scope, ref, written))
    moved = at_index(value, index) if scope.in_function and value.shape[0] else None
    return part(moved) if moved is not None else _choose([part(r) for r in value.rows()], index, written, scope)


def is_known_here(index: Expr, scope: Scope) -> bool:
    """Is a subscript known at translation; in a function, where its variables are no parameters of the model: is it a
    constant?"""
    if not scope.in_function:
        return is_known(index, scope.context)
    own = any(re.split(r"[.\[]", str(n.value))[0] in scope.locals for n in leaves(index))
    return not own and variability(index, scope.context) == "constant"


def _index(written: ast.Expression, kinds: tuple[IndexType, ...] | None, scope: Scope, ref: ast.Ref) -> Value:
    """A subscript as a number, or a vector of numbers."""
    index = lower(written, scope)
    items = []
    for item in scalars(index):
        if not isinstance(item, Expr):
            raise Diagnostic("R044", f"a subscript of {ref} is not an Integer", written.span, "use a whole number")
        kind = None
        if kinds is None:
            kind = (item,) if item.type == BOOLEAN or enumeration_of(item, scope.context) else None
        elif kinds:
            kind = kinds[0]
        items.append(index_number(item, kind, scope.context, written.span))
    return Array(index.shape, tuple(items)) if isinstance(index, Array) else items[0]


def _stacked(rows: list[Value], value: Array, part: Callable[[Value], Value], ref: ast.Ref) -> Value:
    """A part of each row as one array; of no rows, with the sizes that the part of a row has."""
    if rows or len(value.shape) == 1:
        return stack([part(r) for r in rows], ref.span)
    shape = value.shape[1:]
    return Array((0, *shape_of(part(Array(shape, (ex.ZERO,) * math.prod(shape))))), ())


def _row(array: Array, index: Expr, scope: Scope, ref: ast.Ref, written: ast.Expression) -> Value:
    number = known(index, scope, written.span, "the subscript").value
    if not 1 <= number <= array.shape[0]:
        hint = "arrays start at 1" if number < 1 else "are the sizes as meant?"
        raise Diagnostic("R045", f"{ref}[{number}] is outside 1..{array.shape[0]}", written.span, hint)
    return array.row(number - 1)


def _choose(rows: list[Value], index: Expr, written: ast.Expression, scope: Scope) -> Value:
    """An element by a number known only at run time: an if-expression over all of them, and no value outside."""
    if not rows:
        raise Diagnostic("R045", "a subscript of an empty array", written.span, "it has no element")
    is_last = ex.relation("==", index, ex.const(len(rows)))

    def inside(a: Expr | str) -> Expr | str:
        return ex.if_else(is_last, a, ex.nothing(a.type)) if isinstance(a, Expr) else a

    result = with_scalars(rows[-1], map(inside, scalars(rows[-1])))
    for number in range(len(rows) - 1, 0, -1):
        condition = ex.relation("==", index, ex.const(number))
        result = chosen_value(condition, rows[number - 1], result, written.span, scope)
    return result


def node_of(ref: ast.Ref, scope: Scope) -> Leaf | ArrayNode | None:
    """The array that the names of `ref` mean, of arrays on the way the first element; None for anything else."""
    if ref.names[0] in scope.locals or scope.instance is None or ref.absolute:
        return None
    node: Node | None = scope.instance.child(ref.names[0])
    for name in ref.names[1:]:
        if isinstance(node, ArrayNode) and node.items:
            node = node.items[0]
        node = node.child(name) if isinstance(node, Instance) else None
    return node if isinstance(node, Leaf | ArrayNode) else None
