"""May one class stand in place of another? (Modelica 3.6, 6.4 and 7.3, as far as translation needs it)"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.inheritance import Element
from lacuna.codegen.flatten.classes.types import Type, resolve_type
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.syntax import ast

ElementsOf = Callable[[ast.Class], Mapping[str, Element]]
MAX_DEPTH = 8  # of components in components: as deep as types are compared


def require_subtype(chosen: Type, bound: Type, context: Context, elements: ElementsOf, what: str, span: Span) -> None:
    """Raises R034 where `chosen` cannot stand for `bound`."""
    reason = mismatch(chosen, bound, context, elements)
    if reason:
        hint = f"choose a class that has what {_name(bound)} has"
        raise Diagnostic("R034", f"{what}: {reason}", span, hint)


def mismatch(chosen: Type, bound: Type, context: Context, elements: ElementsOf, depth: int = 0) -> str:
    """Why `chosen` is no subtype of `bound`; "" where it is one."""
    if chosen.primitive or bound.primitive:
        open_ended = bound.cls is not None and bound.cls.literals == () and bool(chosen.literals)  # enumeration(:)
        if chosen.primitive != bound.primitive or (chosen.literals != bound.literals and not open_ended):
            return f"{_name(chosen)} is no {_name(bound)}"
        if len(chosen.dimensions) != len(bound.dimensions):
            return f"{len(chosen.dimensions)} dimensions where {len(bound.dimensions)} are needed"
        return ""
    if chosen.cls is bound.cls or depth > MAX_DEPTH:
        return ""
    needed, offered = elements(bound.cls), elements(chosen.cls)
    if bound.cls.kind == chosen.cls.kind == "function" and not _in_order(needed, offered):
        return "its inputs come in another order"
    missing = [n for n, e in needed.items() if n not in offered and not e.declaration.protected]
    if missing:
        return f"{_name(chosen)} lacks {', '.join(missing)} of {_name(bound)}"
    for name, element in needed.items():
        if element.declaration.protected:
            continue
        if offered[name].declaration.protected:
            return f"{name} is protected in {_name(chosen)}"
        inner = [_type_of(e, context) for e in (offered[name], element)]
        reason = _other_prefixes(offered[name].declaration, element.declaration, inner)
        have = offered[name]
        fixed = have.declaration.final or (have.modifier is not None and have.modifier.final)
        if element.declaration.final and not fixed:
            reason = "it is not final, where it is final"
        reason = reason or mismatch(inner[0], inner[1], context, elements, depth + 1)
        if reason:
            return f"{name}: {reason}"
    return ""


def _in_order(needed: Mapping[str, Element], offered: Mapping[str, Element]) -> bool:
    """Whether the inputs of one function come in the order in which those of another one do (6.6)."""
    wanted = [name for name, e in needed.items() if e.declaration.causality == "input" and name in offered]
    return wanted == [name for name in offered if name in wanted]


_VARIABILITIES = ("constant", "parameter", "discrete", "")  # from the narrowest


def _other_prefixes(offered: ast.Component, needed: ast.Component, types: list[Type]) -> str:
    """Why the prefixes of one element do not fit those of the other; "" where they do (6.4)."""
    if _VARIABILITIES.index(offered.variability) > _VARIABILITIES.index(needed.variability):
        return f"it varies, where it is a {needed.variability}"
    if (offered.condition is None) != (needed.condition is None):
        return "only one has a condition"
    for prefix in ("flow", "stream"):
        if getattr(offered, prefix) != getattr(needed, prefix):
            return f"only one is {prefix}"
    directions = [d.causality or t.causality for d, t in zip((offered, needed), types, strict=True)]
    return f"{directions[0] or 'no direction'} where it is {directions[1] or 'none'}" if len({*directions}) > 1 else ""


def _type_of(element: Element, context: Context) -> Type:
    found = resolve_type(element.declaration.type, Scope(context, element.cls, None))
    return replace(found, dimensions=[0] * (len(found.dimensions) + len(element.declaration.dimensions)))


def _name(kind: Type) -> str:
    """A short definition by what it is short for: one that is redeclared has the name of what it stands for."""
    if kind.cls is None:
        return str(kind.primitive)
    return kind.cls.name if kind.cls.alias is None or kind.cls.alias.target else str(kind.cls.alias.base)
