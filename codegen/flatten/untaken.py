"""What a known condition leaves out is of types that fit all the same (Modelica 3.6, 8.3.4 and 4.4.5): branches of
if-equations that are not taken and components that are not there are looked at, and nothing of them is kept."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.inheritance import Element
from lacuna.codegen.flatten.classes.instance import Absent, ArrayNode, Instance, Node
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.equations.equations import Collected
from lacuna.codegen.flatten.equations.sections import flatten_item, scope_of
from lacuna.codegen.flatten.equations.variables import flatten_variables
from lacuna.codegen.flatten.references.written import instances
from lacuna.codegen.syntax import ast

OF_TYPES = ("R020", "R021", "R024", "R031", "R032", "R056")  # faults whatever the values and sizes are


def check_untaken(top: Instance) -> None:
    """Report faults of types in what `top` and what is below leave out, of each class of the user's once. To be called
    when the flat model is complete: the context is used up."""
    library = top.context.library
    for instance in instances(top):
        if library.foreign_package(instance.cls.span.file):
            continue
        _check_branches(instance)
        for name, element in instance.elements.items():
            if isinstance(instance.child(name), Absent):
                there = replace(element, declaration=replace(element.declaration, condition=None))
                _check(partial(_check_component, instance, there), instance)


def _check(look: Callable[[], None], instance: Instance) -> None:
    with instance.context.attempt():
        try:
            look()
        except Diagnostic as error:
            if error.code in OF_TYPES:
                raise


def _check_branches(instance: Instance) -> None:
    for section, cls in instance.sections:
        scope = scope_of(section, cls, instance)
        for item in () if section.algorithm else _in_branches(section.items):
            _check(partial(flatten_item, item, scope, Collected()), instance)


def _in_branches(items: list[ast.Item]) -> Iterator[ast.Item]:
    """What stands in if-equations, those inside of them taken apart."""
    for conditional in (item for item in items if isinstance(item, ast.If)):
        for _, body in conditional.branches:
            yield from _in_branches(body)
            yield from (item for item in body if not isinstance(item, ast.If))


def _check_component(instance: Instance, element: Element) -> None:
    for part in _parts(instance.build(element)):
        if isinstance(part, Leaf):
            flatten_variables(part, flat.FlatModel("", part.span, ""))
            continue
        for section, cls in part.sections:
            scope = scope_of(section, cls, part)
            for item in () if section.algorithm else section.items:
                flatten_item(item, scope, Collected())


def _parts(node: Node) -> Iterator[Leaf | Instance]:
    for part in node.items[:1] if isinstance(node, ArrayNode) else [node]:
        if isinstance(part, Instance):
            for name in part.elements:
                yield from _parts(part.child(name))
        if isinstance(part, Leaf | Instance):
            yield part
