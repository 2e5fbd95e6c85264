"""Every name that is written means something, whether it is evaluated or not (Modelica 3.6, 5.3): in branches that a
known condition leaves out, in loops that are passed no time, in components that are not there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Absent, ArrayNode, Instance, Node
from lacuna.codegen.flatten.classes.types import resolve_type
from lacuna.codegen.flatten.names.scope import Scope, find_class
from lacuna.codegen.flatten.names.unknown import unknown_function
from lacuna.codegen.flatten.references.class_values import from_class
from lacuna.codegen.flatten.references.references import member
from lacuna.codegen.library.predefined import PRIMITIVES
from lacuna.codegen.syntax import ast
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
    for instance in instances(top):
        for section, cls in instance.sections:
            for item in section.items:
                with instance.context.attempt():
                    check_names(item, Scope(instance.context, cls, instance))
        for name in instance.elements:
            with instance.context.attempt():
                _check_declaration(instance, name)


def _check_declaration(instance: Instance, name: str) -> None:
    element = instance.elements[name]
    scope = Scope(instance.context, element.cls, instance)
    if isinstance(instance.child(name), Absent):
        resolve_type(element.declaration.type, scope)
    check_names(element.declaration.modification, scope)


def check_names(tree: object, scope: Scope, bound: Bound = _NONE) -> None:
    """Raises R002, R003 or R004 for a name in a part of the syntax tree that is neither one of `bound` nor found."""
    if isinstance(tree, ast.Ref):
        check_names(tree.subscripts, scope, bound)
        if tree.absolute or tree.names[0] not in bound:
            _check_variable(tree, scope)
        elif (record := bound[tree.names[0]]) is not None:
            _check_fields(record, tree, scope)
    elif isinstance(tree, ast.Call | ast.PartialFunction):
        if tree.function.absolute or tree.function.names[0] not in bound:
            _check_function(tree.function, scope)
        check_names([tree.named, tree.args if isinstance(tree, ast.Call) else []], scope, bound)
    elif isinstance(tree, ast.For | ast.Comprehension):
        for iterator in tree.iterators:
            check_names(iterator.range, scope, bound)
            bound = {**bound, iterator.name: None}
        check_names(tree.body, scope, bound)
    elif isinstance(tree, ast.Argument):
        check_names(tree.modification, scope, bound)
    elif isinstance(tree, list | tuple | dict):
        for part in tree.values() if isinstance(tree, dict) else tree:
            check_names(part, scope, bound)
    elif is_dataclass(tree):
        check_names([getattr(tree, f.name) for f in fields(tree) if f.name != "span"], scope, bound)


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
