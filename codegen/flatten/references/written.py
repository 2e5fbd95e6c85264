"""Every name that is written means something, whether it is evaluated or not (Modelica 3.6, 5.3): in branches that a
known condition leaves out, in loops that are passed no time, in components that are not there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Absent, ArrayNode, Instance, Node
from lacuna.codegen.flatten.classes.types import resolve_type
from lacuna.codegen.flatten.names.scope import Scope, find_class
from lacuna.codegen.flatten.names.unknown import unknown_function
from lacuna.codegen.flatten.references.class_values import from_class
from lacuna.codegen.flatten.references.references import member
from lacuna.codegen.library.predefined import PRIMITIVES
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import parts_of
from lacuna.suggest import did_you_mean

Bound = Mapping[str, ast.Class | None]  # names of functions and loops; of those of records their classes
_NONE: Bound = {}
MEANINGLESS = ("R002", "R003", "R004")  # no variable, no element, no function; other faults are those of evaluation


def instances(top: Instance) -> Iterator[Instance]:
    """`top` and the components below it, the first one of each class."""
    seen: set[int] = set()
    waiting: list[Node] = [top]
    while waiting:
        node = waiting.pop()
        waiting += node.items[:1] if isinstance(node, ArrayNode) else []
        if isinstance(node, Instance) and id(node.cls) not in seen:
            seen.add(id(node.cls))
            yield node
            waiting += [node.child(name) for name in reversed(node.elements)]


def check_written(top: Instance) -> None:
    """Report names without a meaning in `top` and below, of each class once."""
    attempt = top.context.attempt
    for instance in instances(top):
        around = Scope(instance.context, instance.cls, instance)
        for section, cls in instance.sections:
            scope = around.within(cls)
            for item in section.items:
                with attempt():
                    check_names(item, scope)
        for name, element in instance.elements.items():
            with attempt():
                _check_declaration(instance, name, around.within(element.cls))


def _check_declaration(instance: Instance, name: str, scope: Scope) -> None:
    element = instance.elements[name]
    if isinstance(instance.child(name), Absent):
        resolve_type(element.declaration.type, scope)
    check_names(element.declaration.modification, scope)


def check_names(tree: object, scope: Scope, bound: Bound = _NONE) -> None:
    """Raises R002, R003 or R004 for a name in a part of the syntax tree that is neither one of `bound` nor found."""
    check = _CHECKS.get(type(tree))
    if check is not None:
        check(tree, scope, bound)
    else:
        for part in parts_of(type(tree)):
            check_names(getattr(tree, part), scope, bound)


def _check_each(trees: Iterable[object], scope: Scope, bound: Bound) -> None:
    for tree in trees:
        check_names(tree, scope, bound)


def _check_ref(ref: ast.Ref, scope: Scope, bound: Bound) -> None:
    check_names(ref.subscripts, scope, bound)
    if ref.absolute or ref.names[0] not in bound:
        _check_variable(ref, scope)
    elif (record := bound[ref.names[0]]) is not None:
        _check_fields(record, ref, scope)


def _check_call(call: ast.Call | ast.PartialFunction, scope: Scope, bound: Bound) -> None:
    if call.function.absolute or call.function.names[0] not in bound:
        _check_function(call.function, scope)
    _check_each(call.named.values(), scope, bound)
    _check_each(call.args if isinstance(call, ast.Call) else (), scope, bound)


def _check_loop(loop: ast.For | ast.Comprehension, scope: Scope, bound: Bound) -> None:
    for iterator in loop.iterators:
        check_names(iterator.range, scope, bound)
        bound = {**bound, iterator.name: None}
    check_names(loop.body, scope, bound)


_CHECKS: dict[type, Callable[..., None]] = {
    ast.Ref: _check_ref, ast.Call: _check_call, ast.PartialFunction: _check_call, ast.For: _check_loop,
    ast.Comprehension: _check_loop, list: _check_each, tuple: _check_each,
    ast.Argument: lambda argument, scope, bound: check_names(argument.modification, scope, bound),
    dict: lambda parts, scope, bound: _check_each(parts.values(), scope, bound),
}  # fmt: skip


def _check_variable(ref: ast.Ref, scope: Scope) -> None:
    first = ref.names[0]
    if first in scope.locals or first in ("time", *PRIMITIVES):
        return
    try:
        if scope.instance is not None and not ref.absolute and scope.instance.sees(first, scope.cls):
            node = scope.instance.meant(first)
            if node is not None:
                _check_elements(node, ref)
                return
        from_class(ref, scope)
    except Diagnostic as error:
        if error.code in MEANINGLESS:
            raise


def _check_elements(node: Node, ref: ast.Ref) -> None:
    for at in range(1, len(ref.names)):
        if isinstance(node, ArrayNode) and node.items:
            node = node.items[0]
        if not isinstance(node, Instance) or node.cls.expandable:
            return
        node = member(node, ref, at)


def _check_fields(cls: ast.Class, ref: ast.Ref, scope: Scope) -> None:
    """As `_check_elements`, of a record that is no component."""
    for name in ref.names[1:]:
        elements = Instance(scope.context, cls, ref.names[0], None, None).elements
        if name not in elements:
            hint = did_you_mean(name, elements, f"{cls.name} has {', '.join(list(elements)[:12])}")
            raise Diagnostic("R003", f"{ref.names[0]} has no element {name}", ref.span, hint)
        element = elements[name]
        found = resolve_type(element.declaration.type, Scope(scope.context, element.cls)).cls
        if not is_record(found) or (element.modifier is not None and element.modifier.redeclare is not None):
            return
        cls = found


def is_record(cls: ast.Class | None) -> bool:
    return cls is not None and cls.kind in ("record", "operator record")


def _check_function(ref: ast.Ref, scope: Scope) -> None:
    name = str(ref).removeprefix(".")
    lowering = scope.context.lowering
    of_component = scope.instance is not None and len(ref.names) > 1 and ref.names[0] in scope.instance.elements
    if of_component or name in lowering.functions or name in lowering.words or name in scope.locals:
        return
    if find_class(scope.context.library, scope.cls, ref) is None:
        raise unknown_function(ref, scope)
