"""What a name in a file means: a component or a class, and where it is declared."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.names.scope import base_classes, find_class, own_or_inherited
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import ast
from lacuna.lsp.document import Document, Name


@dataclass(frozen=True)
class Declared:
    """A class, or a component with the class it stands in. `owner` is None for a class."""

    element: ast.Class | ast.Component
    owner: ast.Class | None = None

    @property
    def span(self) -> Span:
        return self.element.span


def elements(library: Library, cls: ast.Class, depth: int = 0) -> Iterator[Declared]:
    """Components of `cls`, inherited ones after its own."""
    yield from (Declared(component, cls) for component in cls.components)
    if depth < 30:
        for base in _bases(library, cls):
            yield from elements(library, base, depth + 1)


def element(library: Library, cls: ast.Class, name: str) -> Declared | None:
    found = next((e for e in elements(library, cls) if e.element.name == name), None)
    if found is None:
        try:
            inner = own_or_inherited(library, cls, name)
        except Diagnostic:
            return None
        return Declared(inner) if inner is not None else None
    return found


def type_of(library: Library, declared: Declared) -> ast.Class | None:
    """The class of a component; a class is its own."""
    if isinstance(declared.element, ast.Class):
        return declared.element
    return look_up(library, declared.owner, declared.element.type) if declared.owner else None


def look_up(library: Library, cls: ast.Class, ref: ast.Ref) -> ast.Class | None:
    try:
        return find_class(library, cls, ref)
    except Diagnostic:
        return None


def _bases(library: Library, cls: ast.Class) -> list[ast.Class]:
    try:
        return base_classes(library, cls)
    except Diagnostic:
        return []


def resolve(library: Library, document: Document, name: Name) -> Declared | None:
    """What the last part of `name` means where it stands."""
    offset = document.tokens.offsets[name.token]
    declared = _declared_here(document, name)
    if declared is not None:
        return declared
    cls = document.class_at(offset)
    if cls is None:
        return _class(library, library.root, name)
    modified = _modified(library, document, cls, name)
    if modified is not None:
        return element(library, modified, name.parts[-1]) if len(name.parts) == 1 else None
    called = _called(document, name)
    if called is not None:
        return _argument(library, cls, called, name)
    return follow(library, cls, name)


def _called(document: Document, name: Name) -> Name | None:
    """What is called where this token names an argument, `f(k = 2)`; None where it is no such token."""
    kinds, k = document.tokens.kinds, name.token
    if len(name.parts) > 1 or kinds[k + 1] != "=" or kinds[k - 1] not in ("(", ","):
        return None
    depth = 0
    while k > 0:
        k -= 1
        depth += {")": 1, "]": 1, "}": 1, "(": -1, "[": -1, "{": -1}.get(kinds[k], 0)
        if depth < 0:
            return document.name_of(k - 1) if kinds[k] == "(" and k and kinds[k - 1] == "id" else None
    return None


def _argument(library: Library, cls: ast.Class, called: Name, name: Name) -> Declared | None:
    """The input of a function, or the element of a record, that an argument names (12.4.1)."""
    found = follow(library, cls, called)
    inner = type_of(library, found) if found else None
    return element(library, inner, name.parts[0]) if inner is not None else None


def follow(library: Library, cls: ast.Class, name: Name) -> Declared | None:
    """A dotted name from inside `cls`: components first, then classes, outwards."""
    around: ast.Class | None = cls
    while around is not None and not name.absolute:
        found = next((e for e in elements(library, around) if e.element.name == name.parts[0]), None)
        for part in name.parts[1:]:
            inner = type_of(library, found) if found else None
            found = element(library, inner, part) if inner else None
        if found is not None:
            return found
        around = around.parent
    return _class(library, cls, name)


def _class(library: Library, cls: ast.Class, name: Name) -> Declared | None:
    span = Span("", 0, 0)
    found = look_up(library, cls, ast.Ref(span, name.parts, (None,) * len(name.parts), name.absolute))
    if found is not None:
        return Declared(found)
    if len(name.parts) > 1:  # a constant of a package, a literal of an enumeration
        head = ast.Ref(span, name.parts[:-1], (None,) * (len(name.parts) - 1), name.absolute)
        package = look_up(library, cls, head)
        return element(library, package, name.parts[-1]) if package is not None else None
    return None


def _declared_here(document: Document, name: Name) -> Declared | None:
    """The component or class whose declaration this very token is."""
    offset = document.tokens.offsets[name.token]
    if len(name.parts) > 1:
        return None
    for cls in document.all_classes():
        if document.offset_of(cls.span) == offset or _is_end(document, cls, name):
            return Declared(cls)
        for component in cls.components:
            if document.offset_of(component.span) == offset:
                return Declared(component, cls)
    return None


def _is_end(document: Document, cls: ast.Class, name: Name) -> bool:
    k = name.token
    closes = k > 0 and document.tokens.kinds[k - 1] == "end" and name.parts[0] == cls.name
    return closes and document.class_at(document.tokens.offsets[k]) is cls


def _modified(library: Library, document: Document, cls: ast.Class, name: Name) -> ast.Class | None:
    """The class whose element this token modifies, as in `Resistor r(R=1)`; None where it is no such token."""
    offset = document.tokens.offsets[name.token]
    for component in cls.components:
        found = _in_arguments(library, document, component.modification, Declared(component, cls), offset)
        if found is not None:
            return found
    for clause in cls.extends:
        base = look_up(library, cls, clause.base)
        if base is not None:
            found = _in_arguments(library, document, clause.modification, Declared(base), offset)
            if found is not None:
                return found
    return None


def _in_arguments(
    library: Library, document: Document, tree: ast.Modification, of: Declared, offset: int
) -> ast.Class | None:
    for argument in tree.arguments:
        if argument.redeclare is not None:
            continue
        cls = type_of(library, of)
        if document.offset_of(argument.span) == offset:
            return cls
        inner = element(library, cls, argument.name) if cls else None
        if inner is not None:
            found = _in_arguments(library, document, argument.modification, inner, offset)
            if found is not None:
                return found
    return None
