"""Names that mean something of a class: constants of packages, around or elsewhere, and literals of enumerations."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Node, package_of
from lacuna.codegen.flatten.expressions.enumerations import literal
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.index_types import plain_type
from lacuna.codegen.flatten.names.scope import (
    Scope,
    class_inside,
    find_class,
    find_first,
    imported_class,
    is_package_like,
    own_or_inherited,
)
from lacuna.codegen.flatten.names.unknown import visible_classes
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast
from lacuna.suggest import did_you_mean


def from_class(ref: ast.Ref, scope: Scope) -> tuple[Node, int] | Expr:
    """A literal; or a constant, with the number of the name that means it. Raises R002, R018, R019 or R075."""
    library = scope.context.library
    found = _constant_around(ref, scope)
    if found is not None:
        return found, 0
    cls = library.member(library.root, ref.names[0]) if ref.absolute else find_first(library, scope.cls, ref.names[0])
    for at, name in enumerate(ref.names[1:], 1):
        if cls is None:
            break
        kind = plain_type(library, cls)
        if kind.literals is not None:
            return _literal(kind, name, ref)
        inner = class_inside(library, cls, name, ref)
        if inner is None:
            return _constant_of(cls, name, ref, scope.context), at
        cls = inner
    if cls is not None:
        hint = "use one of its components or constants"
        raise Diagnostic("R018", f"{ref} is a {cls.kind}, not a value", ref.span, hint)
    raise unknown_name(ref, scope)


def _constant_of(cls: ast.Class, name: str, ref: ast.Ref, context: Context) -> Node:
    package = package_of(context, cls)
    element = package.elements.get(name)
    if element is None or element.declaration.variability != "constant":
        known = [*context.library.members(cls), *package.elements]
        hint = did_you_mean(name, known, f"{cls.name} has {', '.join(known[:12])}")
        if element is not None:
            hint = f"declare a component of {cls.name} and use that of it, or declare {name} constant"
        raise Diagnostic("R002", f"{cls.path} has no constant {name}", ref.span, hint)
    if element.declaration.protected:
        error = Diagnostic("R017", f"{name} is protected in {cls.name}", ref.span, "make it public to use it here")
        error.notes.append((element.declaration.span, "declared here"))
        raise error
    if not is_package_like(context.library, cls):
        hint = f"declare {name} in a package"
        raise Diagnostic("R075", f"{cls.name} is no package, {name} cannot be named from outside", ref.span, hint)
    if cls.partial and cls.origin is None:
        hint = "name a package that extends it"
        raise Diagnostic("R075", f"{cls.name} is partial, its constants are not to be used", ref.span, hint)
    return package.child(name)


def _constant_around(ref: ast.Ref, scope: Scope) -> Node | None:
    """The constant that a name means in the classes around, their imports included: a qualified one first."""
    name = ref.names[0]
    current: ast.Class | None = None if ref.absolute else scope.cls
    while current is not None and current.name:
        found = _declared_constant(current, name, ref, scope) or _imported_constant(current, name, scope)
        if found is not None or current.encapsulated:
            return found
        current = current.parent
    return None


def _declared_constant(cls: ast.Class, name: str, ref: ast.Ref, scope: Scope) -> Node | None:
    if cls.kind == "type" or (cls is scope.cls and scope.instance is not None):
        return None  # a type holds attributes only
    package = package_of(scope.context, cls.whole or cls)
    element = package.elements.get(name) if package.sees(name, cls) else None
    if element is None:
        return None
    if element.declaration.variability == "constant":
        return package.child(name)
    if cls is not scope.cls and scope.instance is not None:
        hint = "declare it constant, or hand it on as a parameter"
        error = Diagnostic("R002", f"{name} of the class around is no constant", ref.span, hint)
        error.notes.append((element.declaration.span, "declared here"))
        raise error
    return None


def _imported_constant(cls: ast.Class, name: str, scope: Scope) -> Node | None:
    library = scope.context.library
    for item in cls.imports:
        if not item.every and (item.alias or item.path.names[-1]) == name and len(item.path.names) > 1:
            path = replace(item.path, names=item.path.names[:-1], subscripts=item.path.subscripts[:-1])
            owner = find_class(library, library.root, path)
            if owner is not None and own_or_inherited(library, owner, item.path.names[-1]) is None:
                return _constant_of(owner, item.path.names[-1], replace(item.path, span=item.span), scope.context)
    return _from_whole_packages(cls, name, scope)


def _from_whole_packages(cls: ast.Class, name: str, scope: Scope) -> Node | None:
    """The constant that an unqualified import brings in. Raises R075 where two bring in different ones (5.3.1)."""
    found, meant = None, None
    for item in cls.imports:
        owner = imported_class(scope.context.library, item) if item.every else None
        package = package_of(scope.context, owner) if owner is not None else None
        element = package.elements.get(name) if package is not None else None
        if element is None or element.declaration.protected:
            continue
        if meant is not None and element.declaration is not meant:
            hint = "name the one that is meant by its full name, or import it by name"
            raise Diagnostic("R075", f"two imports bring in {name}", item.span, hint)
        found, meant = package.child(name), element.declaration
    return found


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
