"""Which connectors a name in connect(a, b) means, and the scalars they consist of."""

from __future__ import annotations

from typing import NamedTuple

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Absent, ArrayNode, Instance, Node
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Value, scalars, shape_of
from lacuna.codegen.flatten.references.class_values import unknown_name
from lacuna.codegen.flatten.references.references import apply_subscripts, member
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.syntax import ast

Connector = Node | tuple[Leaf, int]  # the latter: one scalar of a connector that is a variable


class End(NamedTuple):
    """One scalar of a connector in a connection; `outside` where the connector belongs to the connecting model."""

    name: str
    outside: bool


class Part(NamedTuple):
    """A scalar of a connector: its end and the variable it is of."""

    end: End
    leaf: Leaf
    position: int

    @property
    def kind(self) -> str:
        """flow, stream, fixed (a parameter or constant) or potential."""
        if self.leaf.is_structural or self.leaf.primitive == "String":
            return "fixed"
        return "flow" if self.leaf.flow else "stream" if self.leaf.stream else "potential"


def connectors(ref: ast.Ref, scope: Scope) -> list[Connector]:
    """The connectors a name means: instances, or (leaf, position) of connectors that are scalars.

    Empty where a condition removed the component. Raises R002, R003, R044 or R061.
    """
    return connectors_in_shape(ref, scope)[0]


def connectors_in_shape(ref: ast.Ref, scope: Scope) -> tuple[list[Connector], tuple[int, ...]]:
    """As `connectors`, with the sizes of the array of them that the name means; none for a single one."""
    node = scope.instance.meant(ref.names[0]) if scope.instance is not None else None
    if node is None:
        raise unknown_name(ref, scope)
    nodes: list[Connector] = [node]
    sizes: tuple[int, ...] = ()
    for at, subscripts in enumerate(ref.subscripts):
        if at:
            nodes = [member(n, ref, at) for n in nodes]
        found = [_pick(n, subscripts, ref, at, scope) for n in nodes]
        sizes += found[0][1] if found else ()
        nodes = [picked for some, _ in found for picked in some]
    for n in nodes:
        if not is_connector(n[0] if isinstance(n, tuple) else n):
            hint = "connect joins connectors, such as a.p or b.flange_a"
            raise Diagnostic("R061", f"{ref} is no connector", ref.span, hint)
    _refuse_deep(ref, scope)
    return nodes, sizes


def _refuse_deep(ref: ast.Ref, scope: Scope) -> None:
    """Modelica 3.6, 9.1: a connector of the model itself or of one of its components, no deeper."""
    node = scope.instance.meant(ref.names[0])
    for at, name in enumerate(ref.names[1:], 1):
        first = node.items[0] if isinstance(node, ArrayNode) and node.items else node
        if at > 1 and isinstance(first, Instance) and not is_connector(first):
            hint = "connect in the model that has the component"
            raise Diagnostic("R061", f"{ref} lies more than one component deep", ref.span, hint)
        node = first.child(name) if isinstance(first, Instance) else None


def is_outside(ref: ast.Ref, scope: Scope) -> bool:
    """Does the name mean a connector of the model itself?"""
    node = scope.instance.meant(ref.names[0])
    if isinstance(node, ArrayNode):
        if not node.items:
            return False
        node = node.items[0]
    return is_connector(node)


def is_connector(node: Node) -> bool:
    if isinstance(node, Leaf):
        return node.causality in ("input", "output") or node.flow or node.instance.in_connector
    return isinstance(node, Instance) and (node.cls.kind == "connector" or node.in_connector)


def refuse_element(node: Connector, ref: ast.Ref) -> None:
    """Raises R061 for a plain element of a connector, such as c.p of a pin c, which is no connector by itself (9.1)."""
    leaf = node[0] if isinstance(node, tuple) else node
    if not isinstance(leaf, Leaf) or leaf.causality or leaf.open_ended or not leaf.instance.in_connector:
        return
    if leaf.type.named is None or leaf.type.named.kind != "connector":
        hint = f"connect the whole connector {leaf.instance.name}"
        raise Diagnostic("R061", f"{ref} is an element of a connector, not one itself", ref.span, hint)


def pick(
    node: Node, subscripts: tuple[ast.Expression, ...] | None, ref: ast.Ref, at: int, scope: Scope
) -> list[Connector]:
    """The elements of `node` that name number `at` of `ref` means with its subscripts."""
    return _pick(node, subscripts, ref, at, scope)[0]


def _pick(
    node: Node, subscripts: tuple[ast.Expression, ...] | None, ref: ast.Ref, at: int, scope: Scope
) -> tuple[list[Connector], tuple[int, ...]]:
    """As `pick`, with the sizes of what was picked."""
    if isinstance(node, Absent):
        return [], ()
    last = at == len(ref.names) - 1
    if isinstance(node, Leaf):
        if not last:
            raise Diagnostic("R061", f"{node.name} has no connectors", ref.span, "name a connector")
        if not node.shape:
            return [(node, 0)], ()
        picked = apply_subscripts(_numbers(node), subscripts, scope, ref)
        return [(node, position) for position in _chosen(picked, ref)], shape_of(picked)
    if isinstance(node, ArrayNode):
        picked = apply_subscripts(node.numbers, subscripts, scope, ref)
        return [node.items[number - 1] for number in _chosen(picked, ref)], shape_of(picked)
    if subscripts is not None:
        raise Diagnostic("R044", f"{node.name} is no array", ref.span, "remove the subscript")
    return [node], ()


def _chosen(value: Value, ref: ast.Ref) -> list[int]:
    items = scalars(value)
    if any(item.op != "const" for item in items):
        hint = "connections never change: use whole numbers, parameters or loop variables"
        raise Diagnostic("F021", f"the element of {ref} is not known at translation", ref.span, hint)
    return [item.value for item in items]


def _numbers(leaf: Leaf) -> Array:
    return Array(leaf.shape, tuple(ex.const(i) for i in range(len(leaf.names))))


def parts(node: Connector, outside: bool, prefix: str = "") -> dict[str, Part]:
    """The scalars of one connector by their name relative to it."""
    if isinstance(node, tuple):
        leaf, position = node
        return {prefix: Part(End(leaf.names[position], outside), leaf, position)}
    if isinstance(node, Leaf):
        return {
            prefix + name.removeprefix(node.name): Part(End(name, outside), node, k)
            for k, name in enumerate(node.names)
        }  # fmt: skip
    if isinstance(node, Absent):
        return {}
    found: dict[str, Part] = {}
    if isinstance(node, ArrayNode):
        for number, item in enumerate(node.items, 1):
            found |= parts(item, outside, f"{prefix}[{number}]")
        return found
    for name in node.present:
        found |= parts(node.child(name), outside, f"{prefix}.{name}")
    return found
