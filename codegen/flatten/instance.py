"""The instance tree: classes with their modifications become components, one level at a time and on demand.

So `parameter Integer n = 3; Real x[n];` needs no ordering: asking for x asks for n.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import prod

from ..errors import Diagnostic, Span
from ..suggest import did_you_mean
from ..syntax import ast
from .context import Context
from .evaluate import evaluate_boolean, evaluate_dimensions
from .leaf import Leaf
from .lower import modifier_value
from .modifiers import Modifier, for_each, from_tree, merge, narrow
from .scope import Scope, require_class
from .types import Type, resolve_type
from .values import Record, Value, indices

MAX_DEPTH = 40


def written(reference: ast.Ref) -> str:
    """A name as text, subscripts that are whole numbers included, to compare connections."""
    parts = []
    for name, subscripts in zip(reference.names, reference.subscripts, strict=True):
        shown = [str(s.value) if isinstance(s, ast.Literal) else "?" for s in subscripts or ()]
        parts.append(name + (f"[{','.join(shown)}]" if shown else ""))
    return ".".join(parts)


@dataclass
class Element:
    """A declaration as an instance sees it: own or inherited, with the modification from outside."""

    declaration: ast.Component
    cls: ast.Class  # where it is declared
    modifier: Modifier | None


@dataclass
class ArrayNode:
    """An array of components."""

    name: str
    shape: tuple[int, ...]
    items: list[Instance]


@dataclass
class Absent:
    """A component whose condition is false."""

    name: str
    span: Span


Node = "Instance | Leaf | ArrayNode | Absent"


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
        self.elements: dict[str, Element] = {}
        self.sections: list[tuple[ast.Section, ast.Class]] = []
        self.classes: list[ast.Class] = []  # own class and bases
        self._modifier = modifier
        self._record: Record | None = None
        self._children: dict[str, Instance | Leaf | ArrayNode | Absent] = {}
        self._building: list[str] = []
        above = parent
        while above is not None:
            if above.cls is cls:
                raise Diagnostic("R011", f"{cls.name} contains itself", self.span, "break the circle of components")
            above = above.parent
        self._collect(cls, modifier)
        if modifier is not None:
            self._refuse_unknown(modifier, self.elements, cls)
            self._refuse_protected(modifier)

    def _refuse_protected(self, modifier: Modifier) -> None:
        for name, child in modifier.children.items():
            declaration = self.elements[name].declaration
            if declaration.protected:
                hint = "make it public, or modify it in an extends clause"
                error = Diagnostic("R037", f"{name} is protected in {self.cls.name}", child.span, hint)
                error.notes.append((declaration.span, "declared here"))
                raise error

    def _collect(self, cls: ast.Class, modifier: Modifier | None, depth: int = 0) -> None:
        if depth > MAX_DEPTH:
            raise Diagnostic("R011", f"{cls.name} extends itself", cls.span, "break the circle of extends")
        library = self.context.library
        scope = Scope(self.context, cls, self)
        clauses = [(e.base, e.modification) for e in cls.extends]
        if cls.alias is not None:
            clauses.append((cls.alias.base, cls.alias.modification))
        self.classes.append(cls)
        for reference, tree in clauses:
            base = require_class(library, cls, reference, "class", of_base=True)
            inner = from_tree(tree, scope)
            before, sections = dict(self.elements), len(self.sections)
            self._collect(base, merge(modifier, inner) if tree.arguments else modifier, depth + 1)
            if tree.left_out:
                self._leave_out(tree.left_out, sections, base)
            inherited = {n: e for n, e in self.elements.items() if before.get(n) is not e}
            self._refuse_unknown(inner, inherited, base)
        for declaration in cls.components:
            outer = modifier.children.get(declaration.name) if modifier else None
            self._add(Element(declaration, cls, outer))
        self.sections += [(section, cls) for section in cls.sections]

    def _leave_out(self, left_out: list[ast.Ref | ast.Connect], first: int, base: ast.Class) -> None:
        """Selective extension (Modelica 3.6, 7.4): drop inherited components with their connections, or connections."""
        names = {str(item): item for item in left_out if isinstance(item, ast.Ref)}
        pairs = {frozenset((written(c.left), written(c.right))): c for c in left_out if isinstance(c, ast.Connect)}
        used: set[object] = set()
        for name, item in names.items():
            if name not in self.elements:
                hint = did_you_mean(name, self.elements, f"{base.name} has {', '.join(list(self.elements)[:10])}")
                raise Diagnostic("R032", f"{base.path} has no component {name} to leave out", item.span, hint)
            del self.elements[name]

        def kept(item: ast.Item) -> bool:
            if not isinstance(item, ast.Connect):
                return True
            pair = frozenset((written(item.left), written(item.right)))
            used.add(pair)
            return pair not in pairs and item.left.names[0] not in names and item.right.names[0] not in names

        for k in range(first, len(self.sections)):
            section, cls = self.sections[k]
            self.sections[k] = (replace(section, items=[i for i in section.items if kept(i)]), cls)
        for pair, item in pairs.items():
            if pair not in used:
                hint = "write it as the base class does"
                raise Diagnostic("R032", f"{base.path} has no such connection to leave out", item.span, hint)

    def _add(self, element: Element) -> None:
        name = element.declaration.name
        present = self.elements.get(name)
        if present is not None and present.declaration is not element.declaration:
            same_type = str(present.declaration.type) == str(element.declaration.type)
            if present.cls is element.cls or not same_type:
                error = Diagnostic("R010", f"{name} is declared twice", element.declaration.span, "rename one of them")
                error.notes.append((present.declaration.span, "the other declaration"))
                raise error
        self.elements[name] = element

    @staticmethod
    def _refuse_unknown(modifier: Modifier, elements: dict[str, Element], cls: ast.Class) -> None:
        for name, child in modifier.children.items():
            if name not in elements:
                hint = did_you_mean(name, elements, f"{cls.name} has {', '.join(list(elements)[:10]) or 'no elements'}")
                raise Diagnostic("R032", f"{cls.path} has no element {name} to modify", child.span, hint)

    def child(self, name: str) -> Instance | Leaf | ArrayNode | Absent | None:
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

    def children(self) -> list[Instance | Leaf | ArrayNode | Absent]:
        return [self.child(name) for name in self.elements]

    def path_of(self, name: str) -> str:
        return f"{self.name}.{name}" if self.name else name

    def _build(self, element: Element) -> Instance | Leaf | ArrayNode | Absent:
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
        sizes += found.dimensions
        record = self._record_value()
        if record is not None and (element.modifier is None or element.modifier.value is None):
            modifier = replace(modifier, value=record.fields.get(declaration.name), index=())
        self.context.spend(prod(sizes), declaration.span)
        name = self.path_of(declaration.name)
        if found.primitive is not None:
            attributes = for_each(found.modifier) if sizes else found.modifier
            return Leaf(self, declaration, name, found, tuple(sizes), merge(modifier, attributes) or modifier)
        self._check_component(declaration, found)
        if not sizes:
            return Instance(self.context, found.cls, name, self, merge(modifier, found.modifier), declaration)
        items = []
        for index in indices(tuple(sizes)):
            text = "[" + ",".join(map(str, index)) + "]"
            inner = merge(narrow(modifier, index), found.modifier)
            items.append(Instance(self.context, found.cls, name + text, self, inner, declaration))
        return ArrayNode(name, tuple(sizes), items)

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

    def _outer(self, declaration: ast.Component) -> Instance | Leaf | ArrayNode | Absent:
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
        if cls.partial:
            hint = "use a class that extends it"
            if declaration.replaceable:
                hint = f"redeclare it: {declaration.name}(redeclare CLASS {declaration.name})"
            raise Diagnostic("R015", f"{cls.name} is partial and cannot be a component", declaration.span, hint)


def package_of(context: Context, cls: ast.Class) -> Instance:
    """The constants of a package (or of a class around the one at hand)."""
    found = context.packages.get(id(cls))
    if found is None:
        found = context.packages[id(cls)] = Instance(context, cls, cls.path, None, None)
    return found
