"""Names in expressions: the component, constant or enumeration literal they mean, with subscripts applied."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.constants import is_known, known
from lacuna.codegen.flatten.elements import at_index
from lacuna.codegen.flatten.enumerations import IndexType, enumeration_of, index_number, literal
from lacuna.codegen.flatten.instance import Absent, ArrayNode, Instance, Node, package_of
from lacuna.codegen.flatten.leaf import Leaf
from lacuna.codegen.flatten.lower import lower
from lacuna.codegen.flatten.scope import Scope, find_class, find_first, own_or_inherited, visible_classes
from lacuna.codegen.flatten.values import Array, Record, Value, elementwise, scalars, shape_of, stack
from lacuna.codegen.suggest import did_you_mean
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, Expr
from lacuna.codegen.syntax import ast


def read(ref: ast.Ref, scope: Scope) -> Value:
    """The value of a name in an expression."""
    first = ref.names[0]
    if first in scope.locals:
        return _read_local(ref, scope)
    if first == "time" and len(ref.names) == 1:
        return ex.TIME
    node = scope.instance.child(first) if scope.instance is not None and not ref.absolute else None
    return _from_class(ref, scope) if node is None else _walk(node, ref, 0, scope)


def _read_local(ref: ast.Ref, scope: Scope) -> Value:
    value = scope.locals[ref.names[0]]
    value = apply_subscripts(value, ref.subscripts[0], scope, ref)
    for name, subscripts in zip(ref.names[1:], ref.subscripts[1:], strict=True):
        if not isinstance(value, Record):
            raise Diagnostic("R003", f"{ref.names[0]} has no element {name}", ref.span, "only records have elements")
        if name not in value.fields:
            hint = did_you_mean(name, value.fields, f"{value.name} has {', '.join(value.fields)}")
            raise Diagnostic("R003", f"{value.name} has no element {name}", ref.span, hint)
        value = apply_subscripts(value.fields[name], subscripts, scope, ref)
    return value


def _walk(node: Node, ref: ast.Ref, at: int, scope: Scope) -> Value:
    """From `node`, which name number `at` means, to the value at the end of the name."""
    subscripts = ref.subscripts[at]
    last = at == len(ref.names) - 1
    if isinstance(node, Absent):
        hint = "use it under an if with the same condition"
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
        return Record(node.name, {name: _field(node.child(name), ref, scope) for name in node.elements})
    return _walk(member(node, ref, at + 1), ref, at + 1, scope)


def member(node: Node, ref: ast.Ref, at: int) -> Node:
    """The element that name number `at` means in the component before it; it must exist and be public."""
    name = ref.names[at]
    found = node.child(name)
    if found is None:
        hint = did_you_mean(name, node.elements, f"{node.cls.name} has {', '.join(list(node.elements)[:12])}")
        raise Diagnostic("R003", f"{node.name} has no element {name}", ref.span, hint)
    if node.elements[name].declaration.protected:
        error = Diagnostic("R017", f"{name} is protected in {node.cls.name}", ref.span, "make it public to use it here")
        error.notes.append((node.elements[name].declaration.span, "declared here"))
        raise error
    return found


def _field(node: Node, ref: ast.Ref, scope: Scope) -> Value:
    whole = replace(ref, names=("",), subscripts=(None,))
    return _walk(node, whole, 0, scope)


def _walk_array(node: Node, ref: ast.Ref, at: int, scope: Scope) -> Value:
    subscripts = ref.subscripts[at]
    part = replace(ref, names=ref.names[: at + 1])
    picked = apply_subscripts(node.numbers, subscripts, scope, part, node.index_types)
    inner = ref.subscripts[:at] + (None,) + ref.subscripts[at + 1 :]
    plain = replace(ref, subscripts=inner)
    if isinstance(picked, Expr):
        return _numbered(node, picked, plain, at, scope)
    values = [_walk(node.items[p.value - 1], plain, at, scope) for p in picked.items]
    stacked = stack(values, ref.span)
    return Array(picked.shape + stacked.shape[1:], stacked.items)


def _numbered(node: ArrayNode, number: Expr, ref: ast.Ref, at: int, scope: Scope) -> Value:
    """From the element of that number; where it changes at run time, `number` chooses among constants."""
    if number.op == "const":
        return _walk(node.items[number.value - 1], ref, at, scope)
    condition, *numbers = number.args
    values = [_numbered(node, n, ref, at, scope) for n in numbers]
    return elementwise(lambda a, b: ex.if_else(condition, a, b), values, ref.span, "elements")


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
    if isinstance(first, ast.Colon):
        return _stacked([apply_subscripts(r, rest, scope, ref, later) for r in value.rows()], value, ref, len(rest))
    index = _index(first, kinds, replace(scope, end=shape[0]), ref)
    if isinstance(index, Array):
        picked = [_row(value, i, scope, ref, first) for i in index.items]
        return _stacked([apply_subscripts(r, rest, scope, ref, later) for r in picked], value, ref, len(rest))
    if index.op == "const" or (is_known(index, scope.context) and not scope.in_function):
        return apply_subscripts(_row(value, index, scope, ref, first), rest, scope, ref, later)
    if scope.in_function:
        moved = at_index(value.row(0), index) if shape[0] else None
        if moved is not None:
            return apply_subscripts(moved, rest, scope, ref, later)
    return _choose([apply_subscripts(r, rest, scope, ref, later) for r in value.rows()], index, first, scope)


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


def _stacked(rows: list[Value], value: Array, ref: ast.Ref, subscripts_left: int) -> Value:
    """The rows as one array; of no rows, the sizes of the dimensions without a subscript are kept."""
    if rows:
        return stack(rows, ref.span)
    return Array((0, *value.shape[1 + subscripts_left :]), ())


def _row(array: Array, index: Expr, scope: Scope, ref: ast.Ref, written: ast.Expression) -> Value:
    number = known(index, scope, written.span, "the subscript").value
    if not 1 <= number <= array.shape[0]:
        raise Diagnostic("R045", f"{ref}[{number}] is outside 1..{array.shape[0]}", written.span, "arrays start at 1")
    return array.row(number - 1)


def _choose(rows: list[Value], index: Expr, written: ast.Expression, scope: Scope) -> Value:
    """An element by a number known only at run time: an if-expression over all of them."""
    result = rows[-1]
    for number in range(len(rows) - 1, 0, -1):
        condition = ex.relation("==", index, ex.const(number))

        def pick(a: Expr, b: Expr, condition: Expr = condition) -> Expr:
            return ex.if_else(condition, a, b)

        result = elementwise(pick, [rows[number - 1], result], written.span, "elements")
    return result


def _from_class(ref: ast.Ref, scope: Scope) -> Value:
    """A constant of a package around or elsewhere, or a literal of an enumeration."""
    library = scope.context.library
    found = _constant_around(ref, scope)
    if found is not None:
        return _walk(found, ref, 0, scope)
    cls = library.member(library.root, ref.names[0]) if ref.absolute else find_first(library, scope.cls, ref.names[0])
    for at, name in enumerate(ref.names[1:], 1):
        if cls is None:
            break
        if cls.literals is not None:
            return _literal(cls, name, ref)
        inner = own_or_inherited(library, cls, name)
        if inner is None:
            package = package_of(scope.context, cls)
            if name in package.elements and package.elements[name].declaration.variability == "constant":
                return _walk(package.child(name), ref, at, scope)
            known = [*library.members(cls), *package.elements]
            hint = did_you_mean(name, known, f"{cls.name} has {', '.join(known[:12])}")
            raise Diagnostic("R002", f"{cls.path} has no constant {name}", ref.span, hint)
        cls = inner
    if cls is not None:
        hint = "use one of its components or constants"
        raise Diagnostic("R018", f"{ref} is a {cls.kind}, not a value", ref.span, hint)
    raise unknown_name(ref, scope)


def _constant_around(ref: ast.Ref, scope: Scope) -> Node | None:
    library, name = scope.context.library, ref.names[0]
    current: ast.Class | None = None if ref.absolute else scope.cls
    while current is not None and current.name:
        for item in current.imports:
            if not item.every and (item.alias or item.path.names[-1]) == name and len(item.path.names) > 1:
                path = replace(item.path, names=item.path.names[:-1], subscripts=item.path.subscripts[:-1])
                owner = find_class(library, library.root, path)
                if owner is not None and own_or_inherited(library, owner, item.path.names[-1]) is None:
                    return package_of(scope.context, owner).child(item.path.names[-1])
            if item.every:
                owner = find_class(library, library.root, item.path)
                if owner is not None and name in (package := package_of(scope.context, owner)).elements:
                    return package.child(name)
        if current is not scope.cls or scope.instance is None:
            package = package_of(scope.context, current.whole or current)
            if name in package.elements and package.elements[name].declaration.variability == "constant":
                return package.child(name)
        current = current.parent
    return None


def _literal(cls: ast.Class, name: str, ref: ast.Ref) -> Expr:
    names = [n for n, _ in cls.literals]
    if name not in names:
        hint = did_you_mean(name, names, f"{cls.name} has {', '.join(names)}")
        raise Diagnostic("R019", f"{name} is no literal of {cls.name}", ref.span, hint)
    return literal(cls, names.index(name) + 1)


def unknown_name(ref: ast.Ref, scope: Scope) -> Diagnostic:
    """R002: nothing of this name, with the nearest that there are."""
    known = [*scope.locals, *(scope.instance.elements if scope.instance else ())]
    known += visible_classes(scope.context.library, scope.cls)
    hint = did_you_mean(ref.names[0], known)
    if not hint:
        hint = did_you_mean(ref.names[0], scope.context.lowering.functions, "declare it")
    return Diagnostic("R002", f"there is no variable {ref.names[0]}", ref.span, hint)


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
