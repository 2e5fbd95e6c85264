"""What a type name means: a primitive type with its attributes and sizes, an enumeration, or a class."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.restrictions import check_class
from lacuna.codegen.flatten.expressions.evaluate import evaluate_dimensions
from lacuna.codegen.flatten.expressions.lower import modifier_value
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier, for_each, from_tree, merge
from lacuna.codegen.flatten.names.scope import PRIMITIVES, Scope, base_class, find_class
from lacuna.codegen.flatten.names.unknown import unknown_class
from lacuna.codegen.flatten.names.values import shape_of
from lacuna.codegen.flatten.names.views import constraints_of, view
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import references

EXTERNAL = "ExternalObject"
ATTRIBUTES = {
    "Real": (
        "value", "quantity", "unit", "displayUnit", "min", "max", "start", "fixed", "nominal", "unbounded",
        "stateSelect",
    ),
    "Integer": ("quantity", "min", "max", "start", "fixed"),
    "Boolean": ("quantity", "start", "fixed"),
    "String": ("quantity", "start", "fixed"),
    EXTERNAL: (),
}  # fmt: skip


@dataclass(frozen=True)
class Type:
    """`primitive` is Real, Integer, Boolean or String, else None and `cls` is structured."""

    primitive: str | None
    cls: ast.Class | None = None
    literals: tuple[str, ...] = ()
    modifier: Modifier | None = None
    dimensions: list[int] = field(default_factory=list)
    causality: str = ""
    named: ast.Class | None = None  # of a primitive type with a name of its own: the class of that name


def resolve_type(reference: ast.Ref, scope: Scope, depth: int = 0) -> Type:
    """Follow aliases down to a primitive type or a class. Raises R001 for an unknown name."""
    if depth > 20:
        raise Diagnostic("R011", f"the type {reference} is defined by itself", reference.span, "break the circle")
    if str(reference) in PRIMITIVES:
        return Type(str(reference))
    library = scope.context.library
    cls = find_class(library, scope.cls, reference, of_base=depth > 0)
    if cls is None:
        raise unknown_class(library, scope.cls, reference, "type or class")
    return type_of(_standing_in(cls, scope), scope.context, depth)


def _standing_in(cls: ast.Class, scope: Scope) -> ast.Class:
    """A short definition in the class of the component around, whose modifications name its elements: they are looked
    up there, as if they were written outside (4.5.1)."""
    around, alias = scope.instance, cls.alias
    if around is None or alias is None or cls.written is not None or cls.parent is None:
        return cls
    if not any((c.origin or c) is (cls.parent.origin or cls.parent) for c in around.classes):
        return cls
    used = {r.names[0] for r in references([alias.modification, *alias.dimensions]) if not r.absolute}
    if used.isdisjoint(around.elements):
        return cls
    library, key = scope.context.library, (id(around), id(cls), "standing in")
    found = library.views.get(key)
    if found is None:
        written = Scope(scope.context, cls.parent, around)
        found = library.views[key] = view(library, cls, cls.parent, whole=cls.whole, written=written)
        library.kept += [around, cls]
    return found


class _Known(dict[ast.Class, Type]):
    """What was found of classes: most components are of few types."""


def type_of(cls: ast.Class, context: Context, depth: int = 0) -> Type:
    """What a class is as the type of a component."""
    known = context.table(_Known)
    if cls not in known:
        found = _type_of(cls, context, depth)
        if context.library.resolving:  # what is inherited has no meaning yet
            return found
        known[cls] = found
    return known[cls]


def _type_of(cls: ast.Class, context: Context, depth: int) -> Type:
    if cls.literals is not None:
        check_class(cls, context)
        return Type("Integer", cls, tuple(name for name, _ in cls.literals))
    inside = cls.written if isinstance(cls.written, Scope) else Scope(context, cls, None)
    if cls.alias is not None:
        check_class(cls, context)
        found = _of_alias(cls, context, depth)
        if found.primitive is None and not cls.alias.dimensions:
            return Type(None, cls)
        return _modified_by(cls, found, inside)
    if is_external(cls):
        return Type(EXTERNAL, cls)
    for clause in cls.extends:
        if str(clause.base) in PRIMITIVES or _is_primitive(clause.base, inside, depth):
            check_class(cls, context)
            found = resolve_type(clause.base, inside, depth + 1)
            modifier = merge(from_tree(clause.modification, inside), found.modifier)
            return replace(found, modifier=modifier, named=cls)
    return Type(None, cls)


def _modified_by(cls: ast.Class, found: Type, inside: Scope) -> Type:
    """The type that the short definition `cls` makes of `found`."""
    alias, modifier = cls.alias, found.modifier
    if alias.dimensions:  # what the type says is said of each element of this one
        modifier = for_each(modifier)
    for tree, around in reversed(constraints_of(cls)):
        modifier = merge(from_tree(tree, Scope(inside.context, around, None)), modifier)
    own = from_tree(alias.modification, inside)
    if alias.dimensions:
        _refuse_scalars(own, cls.name)
    dimensions = evaluate_dimensions(alias.dimensions, inside, None, cls.name) + found.dimensions
    causality = alias.causality or found.causality
    return replace(found, modifier=merge(own, modifier), dimensions=dimensions, causality=causality, named=cls)


def _refuse_scalars(said: Modifier, name: str) -> None:
    """What `type T = Real[n](...)` says is said of all its elements at once, as of a variable x[n] (4.5.1, 7.2.5)."""
    for attribute, child in said.children.items():
        if child.value is not None and not child.each and shape_of(modifier_value(child)) == ():
            message = f"{name} is an array, {attribute} a scalar"
            raise Diagnostic("R036", message, child.span, f"write each {attribute} = ...")


def causality_of(cls: ast.Class | None, context: Context) -> str:
    """The direction that short definitions give a class: `connector ComplexInput = input Complex`."""
    seen = cls
    while seen is not None and seen.alias is not None:
        if seen.alias.causality:
            return seen.alias.causality
        seen = base_class(context.library, seen, seen.alias.base, seen.alias.modification)
    return ""


def is_partial(cls: ast.Class, context: Context) -> bool:
    """Is it partial, or a short definition of what is?"""
    seen: ast.Class | None = cls
    while seen is not None and not seen.partial:
        alias = seen.alias
        seen = base_class(context.library, seen, alias.base, alias.modification) if alias is not None else None
    return seen is not None


def is_external(cls: ast.Class) -> bool:
    """Is it a class of external objects (Modelica 3.6, 12.9.7)?"""
    return any(str(clause.base) == EXTERNAL for clause in cls.extends)


def _of_alias(cls: ast.Class, context: Context, depth: int) -> Type:
    reference = cls.alias.base
    if cls.alias.target is None and str(reference) in PRIMITIVES:
        return Type(str(reference))
    base = base_class(context.library, cls, reference, cls.alias.modification)
    if base is None:
        raise unknown_class(context.library, cls, reference, "type or class")
    if depth > 20:
        raise Diagnostic("R011", f"the type {reference} is defined by itself", reference.span, "break the circle")
    return type_of(base, context, depth + 1)


def _is_primitive(base: ast.Ref, scope: Scope, depth: int) -> bool:
    return scope.cls.kind in ("type", "connector") and resolve_type(base, scope, depth + 1).primitive is not None
