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
from lacuna.codegen.flatten.names.values import indices
from lacuna.codegen.symbolic.expr import INTEGER
from lacuna.codegen.syntax import ast

Connections = list[tuple[ast.Connect, Scope]]


class Brought(set[tuple[str, str]]):
    """What connections brought to expandable connectors: (path of the connector, name)."""


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
    """The expandable connector that lacks the last name of `ref`, or the element that it means of what connections
    brought by elements; None where there is nothing missing."""
    owner = _bus(ref, scope)
    have = None if owner is None else owner.child(ref.names[-1])
    return owner if have is None or _lacks(owner, have, ref, scope) else None


def _bus(ref: ast.Ref, scope: Scope) -> Instance | None:
    """The expandable connector that `ref` names something of."""
    if len(ref.names) < 2:
        return None
    part = replace(ref, names=ref.names[:-1], subscripts=ref.subscripts[:-1])
    owners = _resolved(part, scope)
    if len(owners) != 1 or not isinstance(owners[0], Instance) or not owners[0].cls.expandable:
        return None
    return owners[0]


def _lacks(owner: Instance, have: Node, ref: ast.Ref, scope: Scope) -> bool:
    """Whether what connections brought has too few elements for the last subscripts of `ref`."""
    subscripts, shape = ref.subscripts[-1], _shape(have)
    if subscripts is None or any(isinstance(s, ast.Colon | ast.Range) for s in subscripts):
        return False
    if (owner.name, ref.names[-1]) not in owner.context.table(Brought):
        return False
    return len(subscripts) == len(shape) and any(
        _number(s, scope) > size for s, size in zip(subscripts, shape, strict=True)
    )


def _shape(node: Node) -> tuple[int, ...]:
    return node.shape if isinstance(node, (Leaf, ArrayNode)) else ()


def _number(subscript: ast.Expression, scope: Scope) -> int:
    return int(known(lower_scalar(subscript, scope, INTEGER), scope, subscript.span, "the subscript").value)


def _adopt(owner: Instance, name: str, node: Node) -> None:
    owner.context.table(Brought).add((owner.name, name))
    owner.adopt(name, node)


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
    left, right = connectors(item.left, scope), connectors(item.right, scope)
    changed = False
    for a, b in zip(left, right, strict=False):
        if isinstance(a, Instance) and isinstance(b, Instance) and (a.cls.expandable or b.cls.expandable):
            if not (a.cls.expandable and b.cls.expandable):
                which = a if a.cls.expandable else b
                hint = f"name an element of it, such as {which.name}.signal"
                raise Diagnostic("R061", f"only {which.name} is expandable", item.span, hint)
            changed = _share(a, b) or changed
            changed = _share(b, a) or changed
    return changed


def _share(giver: Instance, taker: Instance) -> bool:
    """Both have what one of them has, nested expandable connectors included."""
    changed = False
    for name in list(giver.present):
        node, was_present = giver.child(name), name in taker.present
        have = taker.child(name)
        changed = changed or (have is not None and not was_present)  # declared there, and used from now on
        if have is None and taker.cls.expandable and not isinstance(node, Absent):
            taken = _like(node, name, taker)
            _relay(taken)
            _adopt(taker, name, taken)
            changed = True
        elif _grown(node, have, taker, name):
            changed = True
        elif isinstance(node, Instance) and isinstance(have, Instance) and node.cls.expandable:
            changed = _share(node, have) or changed
    return changed


def _grown(node: Node, have: Node | None, taker: Instance, name: str) -> bool:
    """Give `taker` the elements of an array that only the connector it is connected with has: each is augmented by what
    is declared in the other one alone (9.1.3), element by element."""
    wanted, own = _shape(node), _shape(have)
    brought = (taker.name, name) in taker.context.table(Brought)
    if not brought or len(wanted) != len(own) or all(w <= o for w, o in zip(wanted, own, strict=True)):
        return False
    shape = tuple(map(max, wanted, own))
    if isinstance(node, Leaf) and isinstance(have, Leaf):
        larger = _leaf(have, name, taker, shape)
        larger.relayed = have.relayed | (set(larger.names) - set(have.names))
        _adopt(taker, name, larger)
    elif isinstance(node, ArrayNode) and isinstance(have, ArrayNode) and len(shape) == 1:
        more = [_like(n, f"{name}[{k + 1}]", taker) for k, n in enumerate(node.items) if k >= own[0]]
        for item in more:
            _relay(item)
        _adopt(taker, name, ArrayNode(have.name, shape, [*have.items, *more], have.index_types))
    else:
        return False
    return True


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
    elements = _elements(owner, name, connections) if ref.subscripts[-1] is not None else set()
    have = owner.child(name)
    if elements:
        shape = tuple(map(max, zip(*elements, *filter(None, [_shape(have)]), strict=True)))
    node = first[0] if isinstance(first, tuple) else first
    if isinstance(node, Leaf):
        whole = not isinstance(first, tuple)
        _adopt(owner, name, _leaf(node, name, owner, node.shape if whole and not shape else shape))
    elif shape:
        items = [_like(node, f"{name}[{k + 1}]", owner) for k in range(shape[0])]
        _adopt(owner, name, ArrayNode(owner.path_of(name), shape, items, (None,)))
    else:
        _adopt(owner, name, _like(node, name, owner))
    if elements:
        _relay_others(owner.child(name), elements)
    before = set[str]().union(*(leaf.relayed for leaf in _leaves(have))) if have is not None else set()
    for leaf in _leaves(owner.child(name)):
        leaf.relayed |= before & set(leaf.names)
    if (
        isinstance(node, Leaf)
        and node.causality == "input"
        and not node.declaration.protected
        and (node.instance is scope.instance and owner.parent is scope.instance)
    ):  # what its own input brings goes out by its own bus
        _relay(owner.child(name))


def _relay(node: Node) -> None:
    """Say of what is inside that a connected connector brought it."""
    for leaf in _leaves(node):
        leaf.relayed.update(leaf.names)


def _relay_others(node: Node, elements: set[tuple[int, ...]]) -> None:
    """Elements that no connection names here are there because others have them (9.1.3)."""
    if isinstance(node, Leaf):
        node.relayed |= {n for n, at in zip(node.names, indices(node.shape), strict=True) if at not in elements}
    elif isinstance(node, ArrayNode):
        for item in (item for k, item in enumerate(node.items) if (k + 1,) not in elements):
            _relay(item)


def _elements(owner: Instance, name: str, connections: Connections) -> set[tuple[int, ...]]:
    """The elements of an array that connections name, by their subscripts."""
    return {
        tuple(_number(subscript, scope) for subscript in ref.subscripts[-1])
        for item, scope in connections for ref in (item.left, item.right)
        if ref.names[-1] == name and ref.subscripts[-1] is not None and _bus(ref, scope) is owner
    }  # fmt: skip


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
