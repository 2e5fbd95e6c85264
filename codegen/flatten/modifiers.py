"""Modifications: trees of name = value that meet a declaration; the outer one wins over the inner one."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.scope import Scope
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast


@dataclass(slots=True)
class Modifier:
    """`value` in the scope it was written in; `index` is the array element it is narrowed to."""

    span: Span
    value: ast.Expression | Expr | None = None
    scope: Scope | None = None
    each: bool = False
    final: bool = False
    children: dict[str, Modifier] = field(default_factory=dict)
    redeclare: ast.Component | None = None
    index: tuple[int, ...] = ()

    @property
    def empty(self) -> bool:
        return self.value is None and not self.children and self.redeclare is None


def from_tree(tree: ast.Modification, scope: Scope, each: bool = False, final: bool = False) -> Modifier:
    """The modifier a syntax tree stands for. Raises R030 where a name is modified twice."""
    result = Modifier(tree.span, tree.value, scope, each, final)
    for argument in tree.arguments:
        child = from_tree(argument.modification, scope, argument.each, argument.final)
        child.span = argument.span
        child.redeclare = argument.redeclare
        present = result.children.get(argument.name)
        if present is not None:
            if (present.value is not None and child.value is not None) or child.redeclare or present.redeclare:
                error = Diagnostic("R030", f"{argument.name} is modified twice", argument.span, "keep one of them")
                error.notes.append((present.span, "the other one"))
                raise error
            child = merge(child, present)
        result.children[argument.name] = child
    return result


def merge(outer: Modifier | None, inner: Modifier | None) -> Modifier | None:
    """Both together, `outer` first. Raises R031 when it touches what `inner` made final."""
    if inner is None or outer is None:
        return outer if inner is None else inner
    if inner.final and (outer.value is not None or outer.redeclare is not None):
        error = Diagnostic("R031", "this is final and cannot be modified", outer.span, "remove the modification")
        error.notes.append((inner.span, "made final here"))
        raise error
    source = outer if outer.value is not None else inner
    result = replace(source, children=dict(inner.children), final=outer.final or inner.final)
    result.redeclare = outer.redeclare or inner.redeclare
    result.span = outer.span
    if outer.redeclare is not None and outer.value is None:
        result.scope = outer.scope
    for name, child in outer.children.items():
        result.children[name] = merge(child, inner.children.get(name))
    return result


def narrow(modifier: Modifier | None, index: tuple[int, ...]) -> Modifier | None:
    """What `modifier` of an array means for its element `index`; parts under `each` stay whole."""
    if modifier is None or modifier.each:
        return modifier
    children = {name: narrow(child, index) for name, child in modifier.children.items()}
    return replace(modifier, children=children, index=modifier.index + index)


def for_each(modifier: Modifier | None) -> Modifier | None:
    """A modifier that belongs to the type of an element, as seen from an array of them."""
    if modifier is None:
        return None
    children = {name: for_each(child) for name, child in modifier.children.items()}
    return replace(modifier, children=children, each=True)
