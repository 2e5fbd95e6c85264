"""The instance tree: classes with their modifications become components, one level at a time and on demand.

So `parameter Integer n = 3; Real x[n];` needs no ordering: asking for x asks for n.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import prod

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.inheritance import Element, Inheritance, own_modifier
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.classes.outer_classes import with_inner_classes
from lacuna.codegen.flatten.classes.prefixes import (
    check_block,
    check_component,
    check_flow_record,
    check_outer,
    check_prefixes,
    varies_more,
)
from lacuna.codegen.flatten.classes.redeclared import check_modifier, check_redeclared, redeclaration, seen
from lacuna.codegen.flatten.classes.subtypes import mismatch
from lacuna.codegen.flatten.classes.types import Type, causality_of, resolve_type
from lacuna.codegen.flatten.expressions.enumerations import IndexType, index_type
from lacuna.codegen.flatten.expressions.evaluate import evaluate_boolean, evaluate_dimensions
from lacuna.codegen.flatten.expressions.lower import modifier_value
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import (
    Modifier,
    for_each,
    merge,
    narrow,
    refuse_each,
    weakened,
    within_array,
    within_element,
    without_attributes,
    without_removed,
)
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Record, Value, indices
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.syntax import ast


@dataclass
class ArrayNode:
    """An array of components."""

    name: str
    shape: tuple[int, ...]
    items: list[Instance]
    index_types: tuple[IndexType, ...] = ()

    @cached_property
    def numbers(self) -> Array:
        """The numbers of its elements, from 1, in its shape: subscripts are applied to them."""
        return Array(self.shape, tuple(ex.const(i + 1) for i in range(prod(self.shape))))


@dataclass
class Absent:
    """A component whose condition is false."""

    name: str
    span: Span


class Instance:
    """A component of a structured class, or the model itself (its name is then empty)."""

    def __init__(
        self,
        context: Context,
        cls: ast.Class,
        name: str,
        parent: Instance | None,
        modifier: Modifier | None,
        declaration: ast.Component | None = None,
    ) -> None:
        cls = with_inner_classes(seen(cls, modifier, context), parent, context)
        self.context, self.cls, self.name, self.parent = context, cls, name, parent
        self.declaration = declaration
        self.span = declaration.span if declaration else cls.span
        inherited = parent.variability if parent else ""
        self.variability = (declaration.variability if declaration else "") or inherited
        self._inherit_prefixes(declaration)
        if self.flow:
            check_flow_record(cls, self.span, context)
        self._modifier = modifier
        self._record: Record | None = None
        self._children: dict[str, Node] = {}
        self._building: list[str] = []
        above = parent
        while above is not None:
            if (above.cls.origin or above.cls) is (cls.origin or cls) and above.cls.redeclared == cls.redeclared:
                raise Diagnostic("R011", f"{cls.name} contains itself", self.span, "break the circle of components")
            above = above.parent
        inherited = Inheritance(context, self, cls, modifier)
        self.elements, self.sections, self.classes = inherited.elements, inherited.sections, inherited.classes
        if cls.expandable:  # what has no size is there once a connection brings it, with its size (9.1.3)
            self.elements = {n: e for n, e in self.elements.items() if not e.is_unsized}
        self._visible = inherited.visible
        for own in self.classes:
            check_redeclared(own, context, self._elements_of)
        if modifier is not None:
            check_modifier(cls, modifier, context, self._elements_of)

    def _inherit_prefixes(self, declaration: ast.Component | None) -> None:
        """Prefixes of a structured component hold for its elements (4.4.2.2)."""
        around = self.parent
        connector = self.cls.kind == "connector"
        self.in_connector = connector or (around is not None and around.in_connector)
        own = (declaration.causality if declaration else "") or causality_of(self.cls, self.context)
        self.causality = own or (around.causality if around else "")
        self.flow = bool(declaration and declaration.flow) or (around is not None and around.flow)
        self.stream = bool(declaration and declaration.stream) or (around is not None and around.stream)
        self.open_ended = self.cls.expandable or (connector and around is not None and around.open_ended)

    def adopt(self, name: str, node: Node) -> None:
        """Take `node` as an element: of an expandable connector, one that a connection brings."""
        self._children[name] = node
        declaration = node.items[0].declaration if isinstance(node, ArrayNode) else node.declaration
        self.elements[name] = Element(declaration, self.cls, None)

    @property
    def present(self) -> list[str]:
        """Names of its elements; of an expandable connector those that something connects to or uses (9.1.3)."""
        return list(self._children) if self.cls.expandable else list(self.elements)

    def child(self, name: str) -> Node | None:
        """The component `name`, made when first asked for; None where no such is declared."""
        node = self._children.get(name)
        if node is not None:
            return node
        element = self.elements.get(name)
        if element is None:
            return None
        if name in self._building:
            circle = " -> ".join([*self._building, name])
            hint = "a size or a condition cannot depend on what it decides"
            raise Diagnostic("R012", f"declarations depend on each other: {circle}", element.declaration.span, hint)
        self._building.append(name)
        try:
            node = self._children[name] = self.build(element)
        finally:
            self._building.pop()
        return node

    def sees(self, name: str, cls: ast.Class) -> bool:
        """May what is written in `cls`, itself or a base of it, use the element `name`? Bases do not see what is added
        to them (5.6.1)."""
        visible = self._visible.get(id(cls.origin or cls))
        return visible is None or name in visible

    def meant(self, name: str) -> Node | None:
        """What `name` means to those who use it: of an element that is inner and outer, the outer one (5.4)."""
        element = self.elements.get(name)
        if element is not None and element.declaration.inner and element.declaration.outer:
            return self._outer(element.declaration, Scope(self.context, element.cls, self))
        return self.child(name)

    def children(self) -> list[Node]:
        return [self.child(name) for name in self.elements]

    def path_of(self, name: str) -> str:
        return f"{self.name}.{name}" if self.name else name

    def build(self, element: Element) -> Node:  # the component that is declared
        declaration = element.declaration
        scope = Scope(self.context, element.cls, self)
        redeclared = element.modifier is not None and isinstance(element.modifier.redeclare, ast.Component)
        own = own_modifier(element, scope, redeclared)
        modifier = without_removed(merge(within_element(element.modifier), own) or own)
        if declaration.outer and not declaration.inner:
            check_outer(declaration, element.modifier)
            return self._outer(declaration, scope)
        condition = declaration.condition
        if condition is not None and not evaluate_boolean(condition, scope.within(element.written_in("condition"))):
            return Absent(self.path_of(declaration.name), declaration.span)
        type_scope, size_scope = scope, scope.within(element.written_in("dimensions"))
        if redeclared:
            declaration, type_scope = redeclaration(element, modifier, scope, self._elements_of)
            size_scope = type_scope if modifier.redeclare.dimensions else size_scope
        found = resolve_type(declaration.type, type_scope)
        check_prefixes(declaration, found, self._elements_of)
        check_block(element.cls, declaration, found, self._elements_of)
        record, outside = self._record_value(), element.modifier
        given = record is not None and declaration.name in record.fields
        if given and outside is not None and outside.value is not None and not outside.weak:
            hint = f"modify {declaration.name} in the value of {self.name}"
            message = f"{declaration.name} is modified, and {self.name} has a value as a whole"
            raise Diagnostic("R030", message, outside.span, hint)
        if given:
            modifier = merge(outside, weakened(own)) or own
            modifier = replace(modifier, value=record.fields[declaration.name], index=())
        sizes = evaluate_dimensions([*declaration.dimensions], size_scope, modifier, declaration.name)
        index_types = tuple(index_type(d, size_scope) for d in declaration.dimensions)
        sizes += found.dimensions
        self.context.spend(prod(sizes), declaration.span)
        if not sizes:
            refuse_each(own, element.modifier)
        name = self.path_of(declaration.name)
        if found.primitive is not None:
            attributes = for_each(found.modifier) if sizes else found.modifier
            complete = without_attributes(merge(modifier, attributes) or modifier)
            return Leaf(self.context, self, declaration, name, found, tuple(sizes), complete, index_types)
        check_component(self.cls, declaration, found, self.context)
        if not sizes:
            return Instance(self.context, found.cls, name, self, merge(modifier, found.modifier), declaration)
        items, modifier = [], within_array(modifier)
        for index in indices(tuple(sizes)):
            text = "[" + ",".join(map(str, index)) + "]"
            inner = merge(narrow(modifier, tuple(zip(index, sizes, strict=True))), found.modifier)
            items.append(Instance(self.context, found.cls, name + text, self, inner, declaration))
        return ArrayNode(name, tuple(sizes), items, index_types)

    def _record_value(self) -> Record | None:
        """The record this component is bound to, as in `Data data = other`."""
        if self._record is None and self._modifier is not None and self._modifier.value is not None:
            value: Value = modifier_value(self._modifier)
            if not isinstance(value, Record):
                hint = "bind its fields, or give a record"
                raise Diagnostic("R041", f"{self.name} is no scalar and cannot be bound", self._modifier.span, hint)
            more = [name for name in value.fields if name not in self.elements]
            if more:
                hint = f"give a {self.cls.name}"
                raise Diagnostic("R041", f"{self.name} has no {more[0]}, its value has", self._modifier.span, hint)
            self._record = value
        return self._record

    def _elements_of(self, cls: ast.Class) -> dict[str, Element]:
        return Instance(self.context, with_inner_classes(cls, self, self.context), "", None, None).elements

    def _outer(self, declaration: ast.Component, scope: Scope) -> Node:
        """The inner component that an outer one means. Raises R013 where none can be, R076 where it does not fit."""
        found = self._inner(declaration) or self._implicit(declaration, scope)
        if isinstance(found, Absent):
            return found
        wanted, first = resolve_type(declaration.type, scope), found
        if isinstance(found, ArrayNode):
            first = found.items[0] if found.items else found
        have = found.type if isinstance(found, Leaf) else Type(None, getattr(first, "cls", wanted.cls))
        reason = mismatch(replace(have, dimensions=[]), replace(wanted, dimensions=[]), self.context, self._elements_of)
        shape = [] if isinstance(found, Instance) else found.shape
        if len(shape) != len(declaration.dimensions) + len(wanted.dimensions):
            reason = "their numbers of dimensions differ"
        sizes = [d for d in declaration.dimensions if not isinstance(d, ast.Colon)]
        if not reason and len(sizes) == len(shape) and sizes:
            wanted_sizes = evaluate_dimensions(sizes, scope, None, declaration.name)
            if tuple(wanted_sizes) != tuple(shape):
                reason = "their sizes differ"
        reason = reason or varies_more(declaration, found.variability if isinstance(found, Leaf) else "")
        if reason:
            error = Diagnostic(
                "R076", f"outer {declaration.name}: {reason}", declaration.span, "make their types alike"
            )
            error.notes.append((found.span if not isinstance(found, ArrayNode) else first.span, "the inner one"))
            raise error
        return found

    def _inner(self, declaration: ast.Component) -> Node | None:
        above = self.parent
        while above is not None:
            element = above.elements.get(declaration.name)
            if element is not None and element.declaration.inner:
                return above.child(declaration.name)
            above = above.parent
        return None

    def _implicit(self, declaration: ast.Component, scope: Scope) -> Node:
        """The inner component that the model itself gets where none is declared (5.4), by its defaults."""
        top, name = self, declaration.name
        while top.parent is not None:
            top = top.parent
        hint = f"declare in a model around it: inner {declaration.type} {name};"
        found = resolve_type(declaration.type, scope)
        if name in top.elements or found.primitive is not None or found.cls.partial:
            raise Diagnostic("R013", f"no 'inner' matches the 'outer' {name}", declaration.span, hint)
        plain = ast.Modification(declaration.span)
        made = replace(declaration, outer=False, inner=True, condition=None, protected=False, modification=plain)
        top.elements[name] = Element(made, scope.cls, None)
        message = f"no 'inner' matches the 'outer' {name}: the model has one with its default values"
        self.context.warnings.append(Diagnostic("W008", message, declaration.span, hint, severity="warning"))
        return top.child(name)


Node = Instance | Leaf | ArrayNode | Absent


def package_of(context: Context, cls: ast.Class) -> Instance:
    """The constants of a package (or of a class around the one at hand)."""
    found = context.packages.get(id(cls))
    if found is None:
        found = context.packages[id(cls)] = Instance(context, cls, cls.path, None, None)
    return found
