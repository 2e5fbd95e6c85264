"""The instance tree: classes with their modifications become components, one level at a time and on demand.

So `parameter Integer n = 3; Real x[n];` needs no ordering: asking for x asks for n.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import prod

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.context import Context
from lacuna.codegen.flatten.enumerations import IndexType, index_type
from lacuna.codegen.flatten.evaluate import evaluate_boolean, evaluate_dimensions
from lacuna.codegen.flatten.inheritance import Element, Inheritance
from lacuna.codegen.flatten.leaf import Leaf
from lacuna.codegen.flatten.lower import modifier_value
from lacuna.codegen.flatten.modifiers import Modifier, for_each, from_tree, merge, narrow
from lacuna.codegen.flatten.scope import Scope, require_class
from lacuna.codegen.flatten.types import Type, resolve_type
from lacuna.codegen.flatten.values import Record, Value, indices
from lacuna.codegen.syntax import ast


@dataclass
class ArrayNode:
    """An array of components."""

    name: str
    shape: tuple[int, ...]
    items: list[Instance]
    index_types: tuple[IndexType, ...] = ()


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
        self.context, self.cls, self.name, self.parent = context, cls, name, parent
        self.declaration = declaration
        self.span = declaration.span if declaration else cls.span
        inherited = parent.variability if parent else ""
        self.variability = (declaration.variability if declaration else "") or inherited
        self._modifier = modifier
        self._record: Record | None = None
        self._children: dict[str, Node] = {}
        self._building: list[str] = []
        above = parent
        while above is not None:
            if above.cls is cls:
                raise Diagnostic("R011", f"{cls.name} contains itself", self.span, "break the circle of components")
            above = above.parent
        inherited = Inheritance(context, self, cls, modifier)
        self.elements, self.sections, self.classes = inherited.elements, inherited.sections, inherited.classes

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
            node = self._children[name] = self._build(element)
        finally:
            self._building.pop()
        return node

    def children(self) -> list[Node]:
        return [self.child(name) for name in self.elements]

    def path_of(self, name: str) -> str:
        return f"{self.name}.{name}" if self.name else name

    def _build(self, element: Element) -> Node:
        declaration = element.declaration
        scope = Scope(self.context, element.cls, self)
        redeclared = element.modifier is not None and element.modifier.redeclare is not None
        tree = (
            declaration.constraint.modification if redeclared and declaration.constraint else declaration.modification
        )
        own = from_tree(tree, scope, final=declaration.final)
        modifier = merge(element.modifier, own) or own
        if declaration.outer and not declaration.inner:
            return self._outer(declaration)
        if declaration.condition is not None and not evaluate_boolean(declaration.condition, scope):
            return Absent(self.path_of(declaration.name), declaration.span)
        reference, type_scope = declaration.type, scope
        if modifier.redeclare is not None:
            reference, type_scope = self._redeclared(element, modifier)
        found = resolve_type(reference, type_scope)
        sizes = evaluate_dimensions([*declaration.dimensions], scope, modifier, declaration.name)
        index_types = tuple(index_type(d, scope) for d in declaration.dimensions)
        sizes += found.dimensions
        record = self._record_value()
        given = record is not None and declaration.name in record.fields
        if given and (element.modifier is None or element.modifier.value is None):
            modifier = replace(modifier, value=record.fields[declaration.name], index=())
        self.context.spend(prod(sizes), declaration.span)
        name = self.path_of(declaration.name)
        if found.primitive is not None:
            attributes = for_each(found.modifier) if sizes else found.modifier
            complete = merge(modifier, attributes) or modifier
            return Leaf(self.context, self, declaration, name, found, tuple(sizes), complete, index_types)
        self._check_component(declaration, found)
        if not sizes:
            return Instance(self.context, found.cls, name, self, merge(modifier, found.modifier), declaration)
        items = []
        for index in indices(tuple(sizes)):
            text = "[" + ",".join(map(str, index)) + "]"
            inner = merge(narrow(modifier, index), found.modifier)
            items.append(Instance(self.context, found.cls, name + text, self, inner, declaration))
        return ArrayNode(name, tuple(sizes), items, index_types)

    def _record_value(self) -> Record | None:
        """The record this component is bound to, as in `Data data = other`."""
        if self._record is None and self._modifier is not None and self._modifier.value is not None:
            value: Value = modifier_value(self._modifier)
            if not isinstance(value, Record):
                hint = "bind its fields, or give a record"
                raise Diagnostic("R041", f"{self.name} is no scalar and cannot be bound", self._modifier.span, hint)
            self._record = value
        return self._record

    def _redeclared(self, element: Element, modifier: Modifier) -> tuple[ast.Ref, Scope]:
        declaration, new = element.declaration, modifier.redeclare
        if not declaration.replaceable:
            error = Diagnostic(
                "R033", f"{declaration.name} is not replaceable", modifier.span, "declare it with 'replaceable'"
            )
            error.notes.append((declaration.span, "declared here"))
            raise error
        library = self.context.library
        scope = element.modifier.scope
        limit = declaration.constraint.base if declaration.constraint else declaration.type
        bound = require_class(library, element.cls, limit, "class")
        chosen = require_class(library, scope.cls, new.type, "class")
        needed = Instance(self.context, bound, "", None, None).elements
        offered = Instance(self.context, chosen, "", None, None).elements
        missing = [n for n, e in needed.items() if n not in offered and not e.declaration.protected]
        if missing:
            hint = f"choose a class that has what {bound.name} has"
            raise Diagnostic("R034", f"{chosen.name} lacks {', '.join(missing)} of {bound.name}", new.span, hint)
        return new.type, scope

    def _outer(self, declaration: ast.Component) -> Node:
        above = self.parent
        while above is not None:
            element = above.elements.get(declaration.name)
            if element is not None and element.declaration.inner:
                return above.child(declaration.name)
            above = above.parent
        hint = f"declare in a model around it: inner {declaration.type} {declaration.name};"
        raise Diagnostic("R013", f"no 'inner' matches the 'outer' {declaration.name}", declaration.span, hint)

    @staticmethod
    def _check_component(declaration: ast.Component, found: Type) -> None:
        cls = found.cls
        if cls.kind in ("package", "function"):
            hint = "components are of a model, block, connector, record or type"
            raise Diagnostic("R014", f"{cls.name} is a {cls.kind}, not a component class", declaration.span, hint)
        if cls.expandable:
            hint = "declare a connector with the variables it carries"
            raise Diagnostic("R091", "expandable connectors are outside the subset", declaration.span, hint)
        if cls.partial:
            hint = "use a class that extends it"
            if declaration.replaceable:
                hint = f"redeclare it: {declaration.name}(redeclare CLASS {declaration.name})"
            raise Diagnostic("R015", f"{cls.name} is partial and cannot be a component", declaration.span, hint)


Node = Instance | Leaf | ArrayNode | Absent


def package_of(context: Context, cls: ast.Class) -> Instance:
    """The constants of a package (or of a class around the one at hand)."""
    found = context.packages.get(id(cls))
    if found is None:
        found = context.packages[id(cls)] = Instance(context, cls, cls.path, None, None)
    return found
