"""What depends on what in a sequence of assignments: each leaf's way through it, without looking at the rest."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
import heapq

from lacuna.codegen.symbolic.expr import Expr

Users = Mapping[Expr, Sequence[int]]  # leaf -> positions of what uses it, ascending


def users_of(leaves: Iterable[Iterable[Expr]]) -> Users:
    """For each leaf the positions where it is used, from the leaves at each position."""
    users: dict[Expr, list[int]] = {}
    for k, used in enumerate(leaves):
        for n in used:
            users.setdefault(n, []).append(k)
    return users


class Reach:
    """Iterates, ascending, over the positions that depend on what was added, before or while it iterates."""

    def __init__(self, users: Users, seeds: Iterable[Expr]):
        self._users = users
        self._found: set[int] = set()
        self._queue: list[int] = []
        for leaf in seeds:
            self.add(leaf)

    def add(self, leaf: Expr) -> None:
        for k in self._users.get(leaf, ()):
            if k not in self._found:
                self._found.add(k)
                heapq.heappush(self._queue, k)

    def __iter__(self) -> Iterator[int]:
        while self._queue:
            yield heapq.heappop(self._queue)
