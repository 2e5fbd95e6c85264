"""What a class inherits and declares, with the modifications that meet each element."""

from __future__ import annotations

from dataclasses import dataclass, replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.component import Component
from lacuna.codegen.flatten.context import Context
from lacuna.codegen.flatten.modifiers import Modifier, from_tree, merge
from lacuna.codegen.flatten.scope import Scope, require_class
from lacuna.codegen.suggest import did_you_mean
from lacuna.codegen.syntax import ast

MAX_DEPTH = 40


@dataclass
class Element:
    """A declaration as an instance sees it: own or inherited, with the modification from outside."""

    declaration: ast.Component
    cls: ast.Class  # where it is declared
    modifier: Modifier | None


class Inheritance:
    """Elements by name, sections with the classes they are written in, and the classes; bases before what extends them.

    `elements` are in order of declaration. Raises R010, R011, R030 to R032 and R037 for what does not fit.
    """

    def __init__(self, context: Context, instance: Component, cls: ast.Class, modifier: Modifier | None) -> None:
        self._context, self._instance = context, instance
        self.elements: dict[str, Element] = {}
        self.sections: list[tuple[ast.Section, ast.Class]] = []
        self.classes: list[ast.Class] = []  # own class and bases
        self._collect(cls, modifier)
        if modifier is not None:
            self._refuse_unknown(modifier, self.elements, cls)
            self._refuse_protected(modifier, cls)

    def _collect(self, cls: ast.Class, modifier: Modifier | None, depth: int = 0) -> None:
        if depth > MAX_DEPTH:
            raise Diagnostic("R011", f"{cls.name} extends itself", cls.span, "break the circle of extends")
        context = self._context
        scope = Scope(context, cls, self._instance)
        clauses = [(e.base, e.modification) for e in cls.extends]
        if cls.alias is not None:
            clauses.append((cls.alias.base, cls.alias.modification))
        self.classes.append(cls)
        for reference, tree in clauses:
            base = require_class(context.library, cls, reference, "class", of_base=True)
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
        used: set[frozenset[str]] = set()
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

    def _refuse_protected(self, modifier: Modifier, cls: ast.Class) -> None:
        for name, child in modifier.children.items():
            declaration = self.elements[name].declaration
            if declaration.protected:
                hint = "make it public, or modify it in an extends clause"
                error = Diagnostic("R037", f"{name} is protected in {cls.name}", child.span, hint)
                error.notes.append((declaration.span, "declared here"))
                raise error


def written(reference: ast.Ref) -> str:
    """A name as text, subscripts that are whole numbers included, to compare connections."""
    parts = []
    for name, subscripts in zip(reference.names, reference.subscripts, strict=True):
        shown = [str(s.value) if isinstance(s, ast.Literal) else "?" for s in subscripts or ()]
        parts.append(name + (f"[{','.join(shown)}]" if shown else ""))
    return ".".join(parts)
