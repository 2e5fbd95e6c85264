"""Names of types that index and can be run over: enumerations and Boolean, by whatever name (Modelica 3.6, 4.9.5)."""

from __future__ import annotations

from lacuna.codegen.flatten.names.scope import Scope, base_class, base_clauses, find_class, own_or_inherited
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import ast

_MOST_NAMES = 30  # of one type: a circle of them is refused where it is declared


def enumeration(ref: ast.Ref, scope: Scope) -> ast.Class | None:
    """The enumeration type that `ref` names, itself or by another name, if it names one."""
    cls = _plain_type(ref, scope)
    return cls if cls is not None and cls.literals is not None else None


def boolean_type(ref: ast.Ref, scope: Scope) -> bool:
    """Does `ref` name the type Boolean, or one declared as it?"""
    cls = _plain_type(ref, scope)
    base = ref if cls is None else cls.alias.base if cls.alias is not None and not cls.alias.dimensions else None
    return str(base) == "Boolean" and not _is_element(ref, scope)


def _is_element(ref: ast.Ref, scope: Scope) -> bool:
    return scope.instance is not None and ref.names[0] in scope.instance.elements


def _plain_type(ref: ast.Ref, scope: Scope) -> ast.Class | None:
    """The class that `ref` names, of `type A = B` the one that B names; None where it names none."""
    found = None if _is_element(ref, scope) else find_class(scope.context.library, scope.cls, ref)
    return plain_type(scope.context.library, found) if found is not None else None


def plain_type(library: Library, cls: ast.Class) -> ast.Class:
    """`cls`, or what it is another name of: type A = B; type A extends B; end A."""
    for _ in range(_MOST_NAMES):
        named = cls.alias is not None and not cls.alias.dimensions
        clauses = base_clauses(cls) if named or (cls.kind == "type" and len(cls.extends) == 1) else []
        base = base_class(library, cls, *clauses[0]) if clauses else None
        if base is None:
            break
        cls = base
    return cls


def literals_of(path: str, scope: Scope) -> list[str]:
    """Names of the literals of the enumeration with this full name."""
    names = path.split(".")
    cls: ast.Class | None = scope.context.library.root
    for name in names:
        cls = own_or_inherited(scope.context.library, cls, name) if cls is not None else None
    return [name for name, _ in cls.literals] if cls is not None and cls.literals else []
