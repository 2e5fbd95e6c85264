"""What connections of a class and of its components join: nodes, edges, branches past components, signals."""

from __future__ import annotations

from dataclasses import dataclass, field

from lacuna.codegen.flatten.classes.inheritance import written
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.connections.connectors import Connector, connectors
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import indices
from lacuna.codegen.syntax import ast
from lacuna.discovery.efforts.places.sites import Port, Site, Step, root


@dataclass
class Joined:
    """Ports by their full names, and which of them are joined, in a class and in components that it is made of, to each
    of which there is a way."""

    top: ast.Class
    ways: dict[str, tuple[Step, ...]] = field(default_factory=dict)
    ports: dict[str, Port] = field(default_factory=dict)
    _group: dict[str, str] = field(default_factory=dict)
    _found: list[Site] = field(default_factory=list)

    def read(
        self, item: ast.Connect, scope: Scope, way: tuple[Step, ...] | None, loops: bool
    ) -> list[tuple[str, str]]:  # fmt: skip
        """Join what a connection joins; itself a place where nothing but it is written there and there is a `way` to
        its class. What is closed."""
        owner, closed = scope.instance.name, []
        pairs = list(zip(connectors(item.left, scope), connectors(item.right, scope), strict=False))
        for pair in pairs:
            names = [_path(node) for node in pair]
            inner = [_inside(name, owner) for name in names]
            alone = not loops and len(pairs) == 1 and inner == [written(item.left), written(item.right)]
            alone = alone and way is not None
            into = [k for k in (0, 1) if "." in inner[k] and _causality(pair[k]) == "input"]
            if len(into) == 1 and all(map(_causality, pair)):
                if alone:
                    self._signal(item, names, into[0], owner, way)
                continue
            kinds = [self._port(end, node) for end, node in zip(names, pair, strict=True)]
            if None in kinds:
                closed.append((", ".join(names), "its connectors are not one flow and one potential"))
                continue
            self.ports[names[0]], self.ports[names[1]] = kinds
            self._group[root(self._group, names[1])] = root(self._group, names[0])
            if alone:
                label = " to ".join(names)
                self._found.append(Site("edge", label, tuple(names), kinds[0], item.span, owner, way=way))
        return closed

    def _signal(self, item: ast.Connect, names: list[str], into: int, owner: str, way: tuple[Step, ...]) -> None:
        label = f"{names[1 - into]} to {names[into]}"
        site = Site("signal", label, tuple(names), None, item.span, owner, names[into], way=way)
        self._found.append(site)

    def sites(self) -> list[Site]:
        """Nodes, branches, edges and signals."""
        together: dict[str, list[str]] = {}
        for end in self.ports:
            together.setdefault(root(self._group, end), []).append(end)
        own: dict[str, set[str]] = {}  # ports of components
        for end in self.ports:
            own.setdefault(end.rpartition(".")[0], set()).add(end)
        nodes = []
        for first, ends in together.items():
            order = sorted(ends, key=lambda end: (end.count("."), end != first))
            owner, port = _owner(order[0]), self.ports[first]
            way, whole = self.ways[owner], self._whole(order, own)
            nodes.append(Site("node", order[0], tuple(order), port, instance=owner, left=whole, way=way))
        return [*nodes, *self._branches(), *self._found]

    def _whole(self, ends: list[str], own: dict[str, set[str]]) -> str:
        """A component that has all its ports at a node, and no others inside; "" where none has."""
        for name in dict.fromkeys(end.rpartition(".")[0] for end in ends):
            if name not in self.ways and own[name] <= set(ends):
                return name
        return ""

    def _branches(self) -> list[Site]:
        """Past every component that joins two nodes: what goes on between them may have been left out. Its ports are of
        one kind where the language lets them be connected: their variables have the same names (specification 9.3)."""
        of: dict[tuple[str, str, str], list[str]] = {}
        for end, port in self.ports.items():
            of.setdefault((end.rpartition(".")[0], port.flow, port.potential), []).append(end)
        return [
            Site("branch", name, (ends[0], ends[1]), self.ports[ends[0]], instance=_owner(ends[0]),
                 way=self.ways[_owner(ends[0])])
            for (name, *_), ends in of.items()
            if len(ends) == 2 and root(self._group, ends[0]) != root(self._group, ends[1])
        ]  # fmt: skip

    def _port(self, end: str, node: Connector) -> Port | None:
        if not isinstance(node, Instance) or "." not in end or node.cls.kind != "connector":
            return None
        flows = [n for n, e in node.elements.items() if e.declaration.flow]
        others = [n for n, e in node.elements.items() if not e.declaration.flow and not e.declaration.variability]
        plain = all(not isinstance(node.child(n), Instance) for n in (*flows, *others))
        if not plain or len(flows) != 1 or len(others) != 1:
            return None
        return Port(_seen_from(self.top, node.cls.path), flows[0], others[0])


def _owner(end: str) -> str:
    """The component in which that stands whose port it is."""
    return ".".join(end.split(".")[:-2])


def _inside(name: str, owner: str) -> str:
    return name.removeprefix(f"{owner}.") if owner else name


def _path(node: Connector) -> str:
    if not isinstance(node, tuple):
        return node.name
    leaf, position = node
    return leaf.name + (f"[{', '.join(map(str, list(indices(leaf.shape))[position]))}]" if leaf.shape else "")


def _causality(node: Connector) -> str:
    """Of a signal: input | output; "" of anything else."""
    return node[0].causality if isinstance(node, tuple) else node.causality if isinstance(node, Leaf) else ""


def _seen_from(model: ast.Class, path: str) -> str:
    """A class as a model that extends `model` names it: what that declares is inherited, all else has its full name."""
    return path.removeprefix(f"{model.path}.")
