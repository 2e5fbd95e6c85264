"""What expressions share: computed once, before the first of them."""

from __future__ import annotations

from collections.abc import Iterable

from lacuna.codegen.emit.text.doubts import Doubts
from lacuna.codegen.emit.text.expression import is_trivial
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.symbolic.leaves import LEAF_OPS


class Uses:
    """Counts how often planned expressions use their parts."""

    def __init__(self, doubts: Doubts):
        self._doubts = doubts
        self._count: dict[Expr, int] = {}
        self._certain: set[Expr] = set()

    def plan(self, roots: Iterable[Expr]) -> None:
        seen: set[Expr] = set()
        for root in roots:
            self._add(root, seen)
            self._reach(root)

    def _add(self, root: Expr, seen: set[Expr]) -> None:
        stack = [root]
        while stack:
            n = stack.pop()
            self._count[n] = self._count.get(n, 0) + 1
            if n not in seen or n.op == "array":  # an array is written out wherever it stands: so are its elements
                seen.add(n)
                if n.op not in LEAF_OPS:
                    stack.extend(n.args)

    def _reach(self, root: Expr) -> None:
        """Note what of `root` is computed whatever holds, as far as that matters."""
        stack = [root] if self._doubts.inside(root) else []
        while stack:
            n = stack.pop()
            if n in self._certain or not self._doubts.inside(n):
                continue
            self._certain.add(n)
            stack.extend(n.args[:1] if n.op in ("if", "and", "or") else n.args)  # C leaves out the others

    def is_shared(self, e: Expr) -> bool:
        """Whether `e` gets a temporary: it is used twice, and computing it ahead notes nothing of what the conditions
        that it stands under leave out."""
        if self._count.get(e, 0) < 2 or is_trivial(e):
            return False
        return e in self._certain or not self._doubts.inside(e)
