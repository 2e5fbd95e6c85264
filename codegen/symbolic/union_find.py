"""Disjoint sets."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field


@dataclass
class UnionFind:
    """Disjoint sets of hashable things, in the order they came in."""

    parent: dict[Hashable, Hashable] = field(default_factory=dict)

    def find(self, item: Hashable) -> Hashable:
        root = item
        while self.parent.setdefault(root, root) != root:
            root = self.parent[root]
        while self.parent[item] != root:
            self.parent[item], item = root, self.parent[item]
        return root

    def join(self, a: Hashable, b: Hashable) -> None:
        root, other = self.find(a), self.find(b)
        self.parent[other] = root

    def groups(self) -> list[list[Hashable]]:
        found: dict[Hashable, list[Hashable]] = {}
        for item in self.parent:
            found.setdefault(self.find(item), []).append(item)
        return list(found.values())
