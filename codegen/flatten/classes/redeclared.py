"""What stands for a replaceable class or component is a subtype of its constraining class (Modelica 3.6, 7.3.2)."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.inheritance import Element, inheriting, refuse_redeclaration
from lacuna.codegen.flatten.classes.subtypes import ElementsOf, require_subtype
from lacuna.codegen.flatten.classes.types import Type, resolve_type, type_of
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier
from lacuna.codegen.flatten.names.scope import (
    Scope,
    base_class,
    base_classes,
    base_clauses,
    own_or_inherited,
)
from lacuna.codegen.flatten.names.unknown import unknown_element
from lacuna.codegen.flatten.names.views import constrain, modified, view
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import ast


def redeclaration(
    element: Element, modifier: Modifier, own: Scope, elements: ElementsOf
) -> tuple[ast.Component, Scope]:
    """The declaration in place of a replaceable one, and the scope of its type; `own` is the scope of the replaced one.

    Raises R033, R034.
    """
    old, new, scope = element.declaration, modifier.redeclare, modifier.redeclared_in
    chosen = resolve_type(new.type, scope)
    if not old.replaceable and new.dimensions:
        declared = resolve_type(old.type, own)
        if (declared.primitive, declared.cls) == (chosen.primitive, chosen.cls):
            return inheriting(new, old), scope  # sizes may be redeclared anyway
    refuse_redeclaration(new, old, modifier.span)
    bound = resolve_type(old.constraint.base if old.constraint else old.type, own)
    for made in reversed(modifier.replaced):
        bound = _narrowed(made.redeclare, made.redeclared_in, bound, elements)
    require_subtype(chosen, bound, own.context, elements, f"{new.type} for {old.name}", new.span)
    had, has = (len(d.dimensions) + len(t.dimensions) for d, t in ((old, bound), (new, chosen)))
    if new.dimensions and had != has:
        message = f"{old.name} has {had} dimensions and is redeclared with {has} (7.3)"
        raise Diagnostic("R034", message, new.span, "keep the number of dimensions")
    if any(_literals_differ(a, b) for a, b in zip(old.dimensions, new.dimensions, strict=False)):
        raise Diagnostic("R034", f"{old.name} is redeclared in another size (7.3)", new.span, "keep the size")
    _narrowed(new, scope, bound, elements)
    _refuse_unknown(old, resolve_type(old.type, own), own, elements)
    return inheriting(new, old), scope


def _literals_differ(a: ast.Expression, b: ast.Expression) -> bool:
    return isinstance(a, ast.Literal) and isinstance(b, ast.Literal) and a.value != b.value


def _refuse_unknown(old: ast.Component, declared: Type, own: Scope, elements: ElementsOf) -> None:
    """A replaceable declaration modifies what its own type has, whatever is chosen in its place (7.2)."""
    cls = declared.cls if declared.primitive is None else None
    known = elements(cls) if cls is not None and old.modification.arguments else {}
    for a in old.modification.arguments if cls is not None else ():
        if a.name not in known and own_or_inherited(own.context.library, cls, a.name) is None:
            raise unknown_element(cls, a.name, known, a.span)


def _narrowed(new: ast.Component, scope: Scope, bound: Type, elements: ElementsOf) -> Type:
    """What binds the next redeclaration: the constraining type of this one, a subtype of `bound` (7.3.2)."""
    if new.constraint is None:
        return bound
    found = resolve_type(new.constraint.base, scope)
    what = f"{new.constraint.base} as the constraining type of {new.name}"
    require_subtype(found, bound, scope.context, elements, what, new.constraint.span)
    return found


class _Checked(set[int]):
    """Classes looked at, by identity."""


def check_redeclared(cls: ast.Class, context: Context, elements: ElementsOf) -> None:
    """Raises R032, R033, R034 or R037 for a redeclaration in `cls` that does not fit; each class is looked at once."""
    checked, origin = context.table(_Checked), cls.origin or cls
    if id(origin) in checked:
        return
    checked.add(id(origin))
    for nested in origin.classes.values():
        _nested(nested, origin, context, elements)
    for component in origin.components:
        if component.constraint is not None:
            scope = Scope(context, origin)
            bound = resolve_type(component.constraint.base, scope)
            chosen = resolve_type(component.type, scope)
            require_subtype(chosen, bound, context, elements, f"the type of {component.name}", component.span)
    for reference, tree in base_clauses(origin):
        for argument in tree.arguments:
            base = base_class(context.library, cls, reference, tree) if argument.redeclare is not None else None
            if base is not None:
                _of_one_kind(argument.name, argument.redeclare, base, context)
            if isinstance(argument.redeclare, ast.Class):
                new = view(context.library, argument.redeclare, cls, written=cls.written)
                _in_place(new, own_or_inherited(context.library, base.origin or base, argument.name), context, elements)


def check_modifier(cls: ast.Class, modifier: Modifier, context: Context, elements: ElementsOf) -> None:
    """The same for classes that the modification of a component redeclares: protected ones are out of its reach."""
    for name, child in modifier.children.items():
        if child.redeclare is not None:
            _of_one_kind(name, child.redeclare, cls, context)
        if not isinstance(child.redeclare, ast.Class) and not (child.children and child.redeclare is None):
            continue
        old = own_or_inherited(context.library, cls.origin or cls, name)
        if old is None:
            continue
        if old.protected:
            raise Diagnostic("R037", f"{name} is protected in {cls.name}", child.span, "make it public to modify it")
        if isinstance(child.redeclare, ast.Class):
            scope = child.redeclared_in
            _in_place(view(context.library, child.redeclare, scope.cls, written=scope), old, context, elements)


def _of_one_kind(name: str, new: ast.Component | ast.Class, cls: ast.Class, context: Context) -> None:
    """A class stands for a class, a component for a component."""
    old = own_or_inherited(context.library, cls.origin or cls, name)
    if isinstance(new, ast.Class) and old is None:
        hint = f"write redeclare {new.alias.base if new.alias is not None else new.name} {name}"
        raise Diagnostic("R034", f"{name} of {cls.name} is no class, and is redeclared as a {new.kind}", new.span, hint)
    if isinstance(new, ast.Component) and old is not None:
        hint = f"write redeclare {old.kind} {name} = {new.type}"
        message = f"{name} is a {old.kind} of {cls.name}, and is redeclared as a component"
        raise Diagnostic("R034", message, new.span, hint)


def _nested(nested: ast.Class, cls: ast.Class, context: Context, elements: ElementsOf) -> None:
    if nested.constraint is not None:
        bound = resolve_type(nested.constraint.base, Scope(context, cls))
        chosen = type_of(nested, context)
        if nested.alias is not None:  # its own sizes are not those of the types that are compared
            chosen = replace(chosen, dimensions=chosen.dimensions[len(nested.alias.dimensions) :])
        require_subtype(chosen, bound, context, elements, nested.name, nested.span)
    if nested.redeclares:
        old = _inherited(context.library, cls, nested.name)
        if old is None:
            hint = "redeclare what a base class declares, or remove 'redeclare'"
            raise Diagnostic("R032", f"{nested.name} redeclares nothing", nested.span, hint)
        constrain(context.library, nested, old, by_element=True)
        if nested.extends_same is None:
            _in_place(nested, old, context, elements)


def _inherited(library: Library, cls: ast.Class, name: str) -> ast.Class | None:
    """The class `name` of the bases of `cls`, as they declare it."""
    found = (own_or_inherited(library, base.origin or base, name) for base in base_classes(library, cls))
    return next((f for f in found if f is not None), None)


def _in_place(new: ast.Class, old: ast.Class | None, context: Context, elements: ElementsOf) -> None:
    if old is None:
        return
    constrain(context.library, new, old, by_element=False)
    if _is_impure(context.library, new) and not _is_impure(context.library, old):
        hint = f"write impure before function {old.name}"
        raise Diagnostic("R034", f"{old.name} is redeclared as the impure function {new.name} (12.3)", new.span, hint)
    if _kind(new) != _kind(old) and "class" not in (new.kind, old.kind):
        message = f"the {old.kind} {old.name} is redeclared as a {new.kind} (6.4)"
        raise Diagnostic("R034", message, new.span, f"write redeclare {old.kind} {old.name}")
    while old.constraint is None and old.stands_for is not None:
        old = old.stands_for
    bound: Type = type_of(old, context)
    if old.constraint is not None and old.parent is not None:
        bound = resolve_type(old.constraint.base, Scope(context, old.parent))
    require_subtype(type_of(new, context), bound, context, elements, f"{new.name} for {old.name}", new.span)


def _is_impure(library: Library, cls: ast.Class) -> bool:
    """Is the function declared impure, or the one that it is short for?"""
    return cls.impure or (cls.alias is not None and any(_is_impure(library, b) for b in base_classes(library, cls)))


def _kind(cls: ast.Class) -> str:
    """What kinds of class stand for each other: models and blocks, records and types."""
    return {"block": "model", "type": "record"}.get(cls.kind, cls.kind)


def seen(cls: ast.Class, modifier: Modifier | None, context: Context) -> ast.Class:
    """`cls` with the classes that `modifier` redeclares or modifies in it."""
    library = context.library
    redeclared: dict[str, ast.Class] = {}
    for name, child in modifier.children.items() if modifier is not None else ():
        if isinstance(child.redeclare, ast.Class):
            scope = child.redeclared_in
            redeclared[name] = view(library, child.redeclare, scope.cls, written=scope)
        elif child.redeclare is None and child.children and child.tree is not None:
            plain = own_or_inherited(library, cls, name)
            if plain is not None:
                redeclared[name] = modified(library, plain, child.tree, child.scope, child.scope.cls)
    return view(library, cls, cls.parent, redeclared, cls.whole) if redeclared else cls
