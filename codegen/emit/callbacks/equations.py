"""The table of equations that a model carries for its messages: each source equation once, in order of first use."""

from __future__ import annotations

from lacuna.codegen import flat


class EquationTable:
    def __init__(self, equations: list[flat.Equation]):
        self.entries: list[flat.Equation] = []
        self._index: dict[tuple, int] = {}
        for e in equations:
            self.index(e)

    def index(self, e: flat.Equation) -> int:
        key = (e.span, e.origin, e.text, e.lhs if not e.text else None, e.rhs if not e.text else None)
        if key not in self._index:
            self._index[key] = len(self.entries)
            self.entries.append(e)
        return self._index[key]
