"""What to say of a name that means nothing: the nearest names that there are."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.names.scope import (
    Scope,
    base_classes,
    find_class,
    find_first,
    own_or_inherited,
)
from lacuna.codegen.library.classes import HOME_PACKAGE, Library
from lacuna.codegen.library.predefined import PRIMITIVES
from lacuna.codegen.library.search_path import WITHOUT_MODELICA
from lacuna.codegen.library.versions import not_in_copy, other_version, top_package
from lacuna.codegen.syntax import ast
from lacuna.suggest import LISTED, did_you_mean, nearest, question


def visible_classes(library: Library, cls: ast.Class) -> list[str]:
    """Names a reference inside `cls` could start with, for hints."""
    names: list[str] = []
    current: ast.Class | None = cls
    while current is not None:
        names += library.members(current)
        for base in base_classes(library, current):
            names += library.members(base)
        names += [i.alias or i.path.names[-1] for i in current.imports]
        current = current.parent
    return names + library.members(library.root)


def unknown_class(library: Library, cls: ast.Class, ref: ast.Ref, what: str) -> Diagnostic:
    if ref.names == ("Clock",):
        hint = "use when sample(start, interval) then"
        return Diagnostic("R091", "Clock is outside the subset", ref.span, hint)
    known: list[str] = [*visible_classes(library, cls), *PRIMITIVES]
    missing, held, last = ref.names[0], "", None
    current = find_first(library, cls, ref.names[0])
    for name in ref.names[1:]:
        if current is None:
            break
        if _means_nothing(library, current):
            return unknown_class(library, current, current.alias.base, "class")
        known, missing = library.members(current), name
        more = f" and {len(known) - LISTED} more" if len(known) > LISTED else ""
        held = f"{current.name} has {', '.join(known[:LISTED])}{more}" if known else ""
        last = current
        held = ": ".join(filter(None, (not_in_copy(library, current, name), held)))
        current = own_or_inherited(library, current, name)
    hint = did_you_mean(missing, known) or held or _to_import(library, ref) or _elsewhere(library, ref)
    if current is not None and len(ref.names) == 1:
        hint = f"{missing} is inherited, and what is extended is looked up outside of what a class inherits (5.6.1)"
    if current is None and missing == ref.names[0] in visible_classes(library, cls):
        imported = _imported_as(cls, missing)
        hint = (
            f"{missing} is imported as {imported}, which there is not"
            if imported
            else f"an encapsulated class around it sees only what it imports: import ...{missing};"
        )
    return Diagnostic("R001", f"there is no {what} {ref}", ref.span, _for_other_version(hint, library, last, cls))


def _for_other_version(hint: str, library: Library, package: ast.Class | None, user: ast.Class | None) -> str:
    """A hint, and whether the library that `package` belongs to is another version than `user` was written for."""
    top = top_package(library, package) if package is not None else None
    said = other_version(top, user) if top is not None else ""
    return " ".join(filter(None, (hint if not said or hint.endswith("?") else f"{hint};", said)))


def unknown_element(cls: ast.Class, name: str, known: Iterable[str], span: Span) -> Diagnostic:
    """R032: a class has no element of this name to modify, with the nearest that it has."""
    names = list(known)
    hint = did_you_mean(name, names, f"{cls.name} has {', '.join(names[:10]) or 'no elements'}")
    return Diagnostic("R032", f"{cls.path} has no element {name} to modify", span, hint)


def unknown_function(ref: ast.Ref, scope: Scope) -> Diagnostic:
    """R004: no function of this name, with the nearest that there are; of a variable, that it is one."""
    if str(ref) in scope.context.lowering.functions:
        return Diagnostic("R004", f"{ref} has one result", ref.span, f"write y := {ref}(...), or y = {ref}(...)")
    library, before = scope.context.library, ref.names[:-1]
    package = (
        find_class(library, scope.cls, replace(ref, names=before, subscripts=ref.subscripts[:-1])) if before else None
    )
    if package is not None and _means_nothing(library, package):
        return unknown_class(library, package, package.alias.base, "class")
    hint = did_you_mean(ref.names[-1], _functions_beside(package, scope), "declare it, or import its package")
    if scope.instance is not None and ref.names[0] in scope.instance.elements:
        hint = f"{ref} is a variable: index it as {ref}[i], multiply as {ref}*(...)"
    hint = _for_other_version(hint, library, package, scope.cls)
    return Diagnostic("R004", f"there is no function {ref}", ref.span, hint)


def _means_nothing(library: Library, cls: ast.Class) -> bool:
    """Is it a short definition of a class that there is not?"""
    alias = cls.alias
    return alias is not None and str(alias.base) not in PRIMITIVES and not base_classes(library, cls)


def _functions_beside(package: ast.Class | None, scope: Scope) -> list[str]:
    """Names that the last one of a reference may mean where there is no such function: of the package before it, if
    any."""
    library = scope.context.library
    if package is not None:
        return [name for own in (package, *base_classes(library, package)) for name in library.members(own)]
    return [*scope.context.lowering.functions, *visible_classes(library, scope.cls)]


def _imported_as(cls: ast.Class, name: str) -> ast.Ref | None:
    """What an import that `cls` sees would bring in under this name."""
    current: ast.Class | None = cls
    while current is not None:
        for item in current.imports:
            if not item.every and name == (item.alias or item.path.names[-1]):
                return item.path
        current = None if current.encapsulated else current.parent
    return None


def _to_import(library: Library, ref: ast.Ref) -> str:
    """A hint where the name begins as those write it who import a package of the standard library, as in SI.Voltage."""
    for holder in ("Modelica.Units", "Modelica"):
        cls: ast.Class | None = library.root
        try:
            for name in (*holder.split("."), *ref.names):
                cls = own_or_inherited(library, cls, name) if cls is not None else None
        except Diagnostic:
            return ""
        if cls is not None:
            return f"write import {holder}.{ref.names[0]}; in the class"
    return ""


def _elsewhere(library: Library, ref: ast.Ref) -> str:
    """A hint where a class of this name lies in a package that was not looked in."""
    if ref.names[0] == "Modelica":
        return WITHOUT_MODELICA
    try:
        classes = library.all_classes(library.member(library.root, HOME_PACKAGE))
    except Diagnostic:
        classes = []
    names = nearest(ref.names[-1], (c.name for c in classes))
    found = [c.path for name in names for c in classes if c.name == name]
    return question(found[:3]) if found else "declare it, or import its package"
