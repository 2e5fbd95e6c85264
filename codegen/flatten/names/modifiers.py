"""Modifications: trees of name = value that meet a declaration; the outer one wins over the inner one."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.alike import alike


@dataclass(slots=True)
class Modifier:
    """`value` in the scope it was written in; `index` is the array element it is narrowed to: (position, size)
    of each dimension."""

    span: Span
    value: ast.Expression | Expr | None = None
    scope: Scope | None = None
    each: bool = False
    final: bool = False
    children: dict[str, Modifier] = field(default_factory=dict)
    redeclare: ast.Component | ast.Class | None = None
    redeclared_in: Scope | None = None  # the scope a redeclaration is written in
    redeclared_each: bool = False  # in every element of an array
    replaced: tuple[Modifier, ...] = ()  # redeclarations further inside, which this one stands in place of
    tree: ast.Modification | None = None  # as written
    weak: bool = False  # of a part of a component that is bound as a whole from further outside
    index: tuple[tuple[int, int], ...] = ()
    in_array: bool = False  # somewhere inside the modification of an array of components

    @property
    def empty(self) -> bool:
        return self.value is None and not self.children and self.redeclare is None

    def copy(self) -> Modifier:
        """One of its own, with the same children; many are made, and `dataclasses.replace` takes ten times as long."""
        return Modifier(
            self.span, self.value, self.scope, self.each, self.final, self.children, self.redeclare,
            self.redeclared_in, self.redeclared_each, self.replaced, self.tree, self.weak, self.index, self.in_array,
        )  # fmt: skip


def from_tree(tree: ast.Modification, scope: Scope, each: bool = False, final: bool = False) -> Modifier:
    """The modifier a syntax tree stands for. Raises R030 where a name is modified twice."""
    result = Modifier(tree.span, tree.value, scope, each, final)
    for argument in tree.arguments:
        child = from_tree(argument.modification, scope, argument.each, argument.final)
        child.span = argument.span
        child.redeclare, child.tree = argument.redeclare, argument.modification
        child.redeclared_in = scope if argument.redeclare is not None else None
        child.redeclared_each = argument.each and argument.redeclare is not None
        present = result.children.get(argument.name)
        if present is not None:
            if (present.value is not None and child.value is not None) or child.redeclare or present.redeclare:
                error = Diagnostic("R030", f"{argument.name} is modified twice", argument.span, "keep one of them")
                error.notes.append((present.span, "the other one"))
                raise error
            _refuse_both(child, present)
            child = merge(child, present)
        result.children[argument.name] = child
    return result


def _refuse_both(one: Modifier, other: Modifier) -> None:
    """Raises R030 where two arguments of one modification give the same part a value (7.2.4)."""
    for name in one.children.keys() & other.children.keys():
        first, second = one.children[name], other.children[name]
        if first.value is not None and second.value is not None:
            error = Diagnostic("R030", f"{name} is modified twice", first.span, "keep one of them")
            error.notes.append((second.span, "the other one"))
            raise error
        _refuse_both(first, second)


def merge(outer: Modifier | None, inner: Modifier | None) -> Modifier | None:
    """Both together, `outer` first. Raises R031 when it touches what `inner` made final, or a part of it (7.2.6)."""
    if inner is None or outer is None:
        return outer if inner is None else inner
    if inner.final and not outer.empty:
        error = Diagnostic("R031", "this is final and cannot be modified", outer.span, "remove the modification")
        error.notes.append((inner.span, "made final here"))
        raise error
    outer, inner = (_parts_for_each(m) if m.each and not (outer.each and inner.each) else m for m in (outer, inner))
    source = outer if outer.value is not None else inner
    again = outer.redeclare is not None and inner.redeclare is not None
    if again and not inner.redeclare.replaceable:
        hint = "write redeclare replaceable there, or remove one of them"
        error = Diagnostic("R033", "this was redeclared and is not replaceable any more", outer.span, hint)
        error.notes.append((inner.span, "redeclared here"))
        raise error
    result = source.copy()
    result.final = outer.final or inner.final
    result.in_array = outer.in_array or inner.in_array
    result.children = _inner_children(outer, inner, again)
    if source.value is None:  # it is of the element that either is narrowed to
        result.index = outer.index or inner.index
    chosen = outer if outer.redeclare is not None else inner
    result.redeclare, result.redeclared_in = chosen.redeclare, chosen.redeclared_in
    result.redeclared_each = chosen.redeclared_each
    result.replaced = outer.replaced + ((inner,) if again else ()) + inner.replaced
    result.span = outer.span
    for name, child in outer.children.items():
        result.children[name] = merge(child, result.children.get(name))
    return result


def _parts_for_each(modifier: Modifier) -> Modifier:
    """A modifier for each element, to be merged with one that is not: each of its parts says so itself."""
    made = modifier.copy()
    made.each = modifier.value is not None
    made.children = {
        n: replace(c, each=True, redeclared_each=c.redeclare is not None) for n, c in modifier.children.items()
    }
    return made


def within_element(modifier: Modifier | None) -> Modifier | None:
    """A modifier as it is met inside of an element of an array, for each of which it is."""
    return replace(modifier, each=False) if modifier is not None and modifier.each and modifier.in_array else modifier


def _inner_children(outer: Modifier, inner: Modifier, again: bool) -> dict[str, Modifier]:
    """What is left of the parts of `inner`: of a component redeclared again what its constraining clause says; of one
    bound as a whole by `outer` attributes only."""
    if again:
        clause = inner.redeclare.constraint
        return from_tree(clause.modification, inner.redeclared_in).children if clause is not None else {}
    if outer.value is not None:
        return weakened(inner).children
    return dict(inner.children)


def weakened(m: Modifier) -> Modifier:
    """`m` whose parts stand behind those of a value that the whole has."""
    weak = m.copy()
    weak.weak = True
    weak.children = {name: child if child.weak else weakened(child) for name, child in m.children.items()}
    return weak


def narrow(modifier: Modifier | None, index: tuple[tuple[int, int], ...]) -> Modifier | None:
    """What `modifier` of an array means for its element, (position, size) of each dimension; parts under `each` stay
    whole."""
    if modifier is None or modifier.each:
        return modifier
    children = {name: narrow(child, index) for name, child in modifier.children.items()}
    return replace(modifier, children=children, index=modifier.index + index)


def within_array(modifier: Modifier) -> Modifier:
    """A modifier of an array of components, all its parts marked as such. Raises R038 for a redeclaration that would be
    split among the elements (7.2.5)."""
    for name, child in modifier.children.items():
        if child.redeclare is not None and not (child.each or child.redeclared_each or modifier.each):
            raise Diagnostic("R038", f"{name} is redeclared in an array", child.span, "write: redeclare each ...")
    marked = modifier.copy()
    marked.in_array = True
    marked.children = {name: within_array(child) for name, child in modifier.children.items()}
    return marked


def for_each(modifier: Modifier | None) -> Modifier | None:
    """A modifier that belongs to the type of an element, as seen from an array of them."""
    if modifier is None:
        return None
    children = {name: for_each(child) for name, child in modifier.children.items()}
    return replace(modifier, children=children, each=True)


def without_removed(modifier: Modifier) -> Modifier:
    """A modifier in which `break` has taken away the value that was declared further inside (7.2.7)."""
    return replace(modifier, value=None) if isinstance(modifier.value, ast.NoValue) else modifier


def without_attributes(modifier: Modifier) -> Modifier:
    """The modifier of a variable without the attributes that `break` has taken away."""
    kept = {n: c for n, c in modifier.children.items() if not isinstance(c.value, ast.NoValue)}
    return modifier if len(kept) == len(modifier.children) else replace(modifier, children=kept)


def same_modifier(one: Modifier | None, other: Modifier | None) -> bool:
    """Whether two modifications say the same, written in the same class."""
    if one is other:
        return True
    if one is None or other is None:
        return (one or other).empty
    values = alike(one.value, other.value) if isinstance(one.value, ast.Expression) else one.value is other.value
    alone = one.value is None or isinstance(one.value, ast.Literal)
    places = alone or one.scope is other.scope or one.scope.cls is other.scope.cls
    names = one.children.keys() | other.children.keys()
    parts = all(same_modifier(one.children.get(n), other.children.get(n)) for n in names)
    return values and places and parts and one.redeclare is other.redeclare


def refuse_each(*modifiers: Modifier | None) -> None:
    """Raises R038 for `each` in the modification of what is no array, nor part of one (7.2.5)."""
    plain = [m for m in modifiers if m is not None and m.children and not m.in_array and not m.each]
    for name, child in ((n, c) for m in plain for n, c in m.children.items()):
        if child.each:
            hint = "remove 'each'"
            raise Diagnostic("R038", f"each {name}: what is modified is no array", child.span, hint)
