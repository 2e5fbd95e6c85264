"""Expandable connectors get the elements that connections bring to them (Modelica 3.6, 9.1.3)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Absent, ArrayNode, Instance, Node
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.connections.connectors import Connector, connectors, pick
from lacuna.codegen.flatten.expressions.constants import known
from lacuna.codegen.flatten.expressions.lower import lower_scalar
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic.expr import INTEGER
from lacuna.codegen.syntax import ast

Connections = list[tuple[ast.Connect, Scope]]


def expand(connections: Connections, buses: Iterable[Instance], context: Context) -> None:
    """Add to expandable connectors what `connections` name in them, until nothing is new.

    Raises R061 where neither side of a connection is declared anywhere, or where a modification gives a value to what
    only a connection makes present.
    """
    found: dict[tuple[int, tuple[str, ...]], bool] = {}  # by what a name means, all elements of arrays together

    def touches(ref: ast.Ref, scope: Scope) -> bool:
        key = id(scope.instance), ref.names
        if key not in found:
            found[key] = _touches_expandable(ref, scope)
        return found[key]

    _refuse_values(buses)
    waiting = [c for c in connections if any(touches(ref, c[1]) for ref in (c[0].left, c[0].right))]
    changed = True
    while changed:
        changed = False
        for item, scope in waiting:
            with context.attempt():
                changed = _expand_one(item, scope, waiting) or changed
    for item, scope in waiting:
        if _owner(item.left, scope) is not None and _owner(item.right, scope) is not None:
            hint = "declare it in one of the expandable connectors"
            with context.attempt():
                raise Diagnostic("R061", f"neither {item.left} nor {item.right} is declared", item.span, hint)


def _refuse_values(buses: Iterable[Instance]) -> None:
    for bus in buses:
        for name, element in bus.elements.items():
            given = element.modifier
            if given is not None and given.value is not None and given.redeclare is None:
                hint = "connect a source to it"
                raise Diagnostic("R061", f"{name} of the expandable {bus.name} is given a value", given.span, hint)


def _touches_expandable(ref: ast.Ref, scope: Scope) -> bool:
    return any(isinstance(n, Instance) and n.cls.expandable for n in _along(ref, scope))


def _along(ref: ast.Ref, scope: Scope) -> Iterator[Node]:
    """The components that the names of `ref` mean, as far as there are such; of arrays every element."""
    nodes: list[Node | None] = [scope.instance.child(ref.names[0])]
    for name in (*ref.names[1:], None):
        nodes = [inner for n in nodes for inner in (n.items if isinstance(n, ArrayNode) else [n])]
        yield from (n for n in nodes if n is not None)
        if name is not None:
            nodes = [n.child(name) if isinstance(n, Instance) else None for n in nodes]


def _owner(ref: ast.Ref, scope: Scope) -> Instance | None:
    """The expandable connector that lacks the last name of `ref`; None where there is nothing missing."""
    holder = _holder(ref, scope)
    return holder if holder is not None and holder.child(ref.names[-1]) is None else None


def _holder(ref: ast.Ref, scope: Scope) -> Instance | None:
    """The expandable connector that the last name of `ref` is looked for in, if there is one."""
    if len(ref.names) < 2:
        return None
    part = replace(ref, names=ref.names[:-1], subscripts=ref.subscripts[:-1])
    owners = _resolved(part, scope)
    if len(owners) != 1 or not isinstance(owners[0], Instance) or not owners[0].cls.expandable:
        return None
    return owners[0]


def _resolved(ref: ast.Ref, scope: Scope) -> list[Connector]:
    nodes: list[Connector] = [scope.instance.child(ref.names[0])]
    for at, subscripts in enumerate(ref.subscripts):
        if at:
            nodes = [n.child(ref.names[at]) for n in nodes if isinstance(n, Instance)]
        nodes = [picked for n in nodes if n is not None for picked in pick(n, subscripts, ref, at, scope)]
    return nodes


def _expand_one(item: ast.Connect, scope: Scope, all_of_them: Connections) -> bool:
    missing = [(_owner(ref, scope), ref) for ref in (item.left, item.right)]
    if missing[0][0] is not None and missing[1][0] is not None:
        return False
    for (owner, ref), other in zip(missing, (item.right, item.left), strict=True):
        if owner is not None:
            found = connectors(other, scope)
            if found:
                _add(owner, ref, found, scope, all_of_them)
            return bool(found)
    changed = [_grown(ref, scope) for ref in (item.left, item.right)] != [False, False]
    left, right = connectors(item.left, scope), connectors(item.right, scope)
    for a, b in zip(left, right, strict=False):
        if isinstance(a, Instance) and isinstance(b, Instance) and (a.cls.expandable or b.cls.expandable):
            if not (a.cls.expandable and b.cls.expandable):
                which = a if a.cls.expandable else b
                hint = f"name an element of it, such as {which.name}.signal"
                raise Diagnostic("R061", f"only {which.name} is expandable", item.span, hint)
            changed = _share(a, b) or changed
            changed = _share(b, a) or changed
    return changed


def _grown(ref: ast.Ref, scope: Scope) -> bool:
    """Whether an array of an expandable connector gets the element that `ref` names: other connections named fewer."""
    subscripts, holder = ref.subscripts[-1], _holder(ref, scope)
    if holder is None or not subscripts or any(isinstance(s, ast.Colon | ast.Range) for s in subscripts):
        return False
    return _grow(holder, ref.names[-1], _element_number(ref, scope))


def _share(giver: Instance, taker: Instance) -> bool:
    """Both have what one of them has, nested expandable connectors included."""
    changed = False
    for name in list(giver.present):
        node, was_present = giver.child(name), name in taker.present
        have = taker.child(name)
        changed = changed or (have is not None and not was_present)  # declared there, and used from now on
        if have is None and taker.cls.expandable and not isinstance(node, Absent):
            taken = _like(node, name, taker)
            for leaf in _leaves(taken):
                leaf.relayed = frozenset(leaf.names)
            _bring(taker, name, taken)
            changed = True
        elif isinstance(node, Instance) and isinstance(have, Instance) and node.cls.expandable:
            changed = _share(node, have) or changed
        else:
            changed = _grow(taker, name, _shape(node)) or changed
    return changed


def _shape(node: Node) -> tuple[int, ...]:
    return node.shape if isinstance(node, Leaf | ArrayNode) else ()


def _grow(owner: Instance, name: str, shape: tuple[int, ...]) -> bool:
    """Give an array that connections brought to an expandable connector the elements that `shape` has besides: each is
    there by itself (9.1.3). What is declared keeps its size. Whether anything is new."""
    node = owner.child(name)
    have = _shape(node)
    wanted = tuple(map(max, have, shape))
    if len(have) != len(shape) or wanted == have or name not in owner.context.table(Brought).get(id(owner), set()):
        return False
    if isinstance(node, Leaf):
        new: Node = _leaf(node, name, owner, wanted)
        new.relayed = node.relayed | set(new.names).difference(node.names)
    else:
        more = [_like(node.items[0], f"{name}[{k + 1}]", owner) for k in range(have[0], wanted[0])]
        for leaf in (leaf for item in more for leaf in _leaves(item)):
            leaf.relayed = frozenset(leaf.names)
        new = ArrayNode(owner.path_of(name), wanted, [*node.items, *more], node.index_types)
    owner.adopt(name, new)
    return True


class Brought(dict[int, set[str]]):
    """What is in expandable connectors by connections alone, by the identities of these."""


def _bring(owner: Instance, name: str, node: Node) -> None:
    owner.context.table(Brought).setdefault(id(owner), set()).add(name)
    owner.adopt(name, node)


def _leaves(node: Node) -> Iterator[Leaf]:
    if isinstance(node, Leaf):
        yield node
    elif isinstance(node, ArrayNode):
        yield from (leaf for item in node.items for leaf in _leaves(item))
    elif isinstance(node, Instance):
        yield from (leaf for name in node.present for leaf in _leaves(node.child(name)))


def _add(owner: Instance, ref: ast.Ref, found: list[Connector], scope: Scope, connections: Connections) -> None:
    name, first = ref.names[-1], found[0]
    shape: tuple[int, ...] = (len(found),) if len(found) > 1 else ()
    numbers: list[tuple[int, ...]] = []
    if ref.subscripts[-1] is not None:
        numbers = _numbers(owner, name, connections)
        shape = tuple(map(max, zip(*numbers, strict=True)))
    node = first[0] if isinstance(first, tuple) else first
    if isinstance(node, Leaf):
        whole = not isinstance(first, tuple)
        _bring(owner, name, _leaf(node, name, owner, node.shape if whole and not shape else shape))
    elif shape:
        items = [_like(node, f"{name}[{k + 1}]", owner) for k in range(shape[0])]
        _bring(owner, name, ArrayNode(owner.path_of(name), shape, items, (None,)))
    else:
        _bring(owner, name, _like(node, name, owner))
    if numbers:
        _relay_others(owner.child(name), {f"{owner.path_of(name)}[{','.join(map(str, n))}]" for n in numbers})
    if (
        isinstance(node, Leaf)
        and node.causality == "input"
        and not node.declaration.protected
        and (node.instance is scope.instance and owner.parent is scope.instance)
    ):  # what its own input brings goes out by its own bus
        for leaf in _leaves(owner.child(name)):
            leaf.relayed = frozenset(leaf.names)


def _relay_others(array: Node, named: set[str]) -> None:
    """Elements that nothing here connects to are driven from elsewhere, if they are."""
    items = array.items if isinstance(array, ArrayNode) else [array]
    for leaf in (leaf for item in items if item.name not in named for leaf in _leaves(item)):
        leaf.relayed = frozenset(leaf.names) - named


def _numbers(owner: Instance, name: str, connections: Connections) -> list[tuple[int, ...]]:
    """The elements of an array of `owner` that connections name."""
    found = []
    for item, scope in connections:
        for ref in (item.left, item.right):
            if ref.names[-1] == name and ref.subscripts[-1] is not None and _holder(ref, scope) is owner:
                found.append(_element_number(ref, scope))
    return found


def _element_number(ref: ast.Ref, scope: Scope) -> tuple[int, ...]:
    numbers = [known(lower_scalar(s, scope, INTEGER), scope, s.span, "the subscript") for s in ref.subscripts[-1]]
    return tuple(int(n.value) for n in numbers)


def _like(node: Node, name: str, owner: Instance) -> Node:
    """A component of the same kind as `node`, as the element `name` of `owner`."""
    if isinstance(node, Leaf):
        return _leaf(node, name, owner, node.shape)
    if isinstance(node, ArrayNode):
        items = [_like(n, f"{name}[{k + 1}]", owner) for k, n in enumerate(node.items)]
        return ArrayNode(owner.path_of(name), node.shape, items, node.index_types)
    assert isinstance(node, Instance)
    declaration = replace(node.declaration, name=name, condition=None, protected=False)
    new = Instance(owner.context, node.cls, owner.path_of(name), owner, None, declaration)
    if new.cls.expandable:
        _share(node, new)
    return new


def _leaf(like: Leaf, name: str, owner: Instance, shape: tuple[int, ...]) -> Leaf:
    declaration = replace(
        like.declaration, name=name, condition=None, protected=False, causality="", inner=False, outer=False,
        variability="", modification=ast.Modification(like.span),
    )  # fmt: skip
    modifier = like.type.modifier or Modifier(like.span)
    attributes = {k: m for k, m in modifier.children.items() if k not in ("start", "fixed")}
    plain = replace(modifier, value=None, children={k: replace(m, each=True) for k, m in attributes.items()})
    return Leaf(owner.context, owner, declaration, owner.path_of(name), like.type, shape, plain, (None,) * len(shape))
