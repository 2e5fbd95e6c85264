"""How fast the candidates of a group of constraints move with those of them that are states: the tangent w = dq/ds, the
solution of P w = 1, G w = 0, where a row of P has a 1 at its state. Where an entry is large, its state is a bad one."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import reduce

from lacuna.codegen import flat
from lacuna.codegen.structure.index.pivots import base_of, text_of
from lacuna.codegen.structure.system import Row
from lacuna.codegen.symbolic.differentiate import partial
from lacuna.codegen.symbolic.expr import ONE, ZERO, Expr, add, const, mul, relation, var

WATCHED = 0.1  # smallest mean slope of a state by the others that is tolerated, both by their sizes


@dataclass
class Group:
    """Constraints that determine all but `len(selected)` of the derivatives `free` (and all of `others`)."""

    rows: list[Row]
    free: list[Expr]  # derivatives of those that may be states
    others: list[Expr]  # derivatives that never are states
    selected: list[Expr]  # of `free`, those of the states at the start
    reset: Expr | None = None  # of `free`, that of one that a reinit sets, though it may not be the state then


class Tangent:
    """The slopes of a group; `scales`: the size of each candidate, by its derivative."""

    def __init__(self, number: int, group: Group, scales: dict[Expr, Expr]):
        self.group, self.number, self.scales = group, number, scales
        self.span, self.origin = group.rows[0].source.span, group.rows[0].source.origin
        self.variables: dict[str, flat.Variable] = {}
        self.slopes = [
            {d: self._slope(f"$slope{number}[{k + 1},{i + 1}]") for k, d in enumerate(scales)}
            for i in range(len(group.selected))
        ]

    def declare(self, name: str, description: str, **more: object) -> Expr:
        self.variables[name] = flat.Variable(name, self.span, nominal=ONE, description=description, **more)
        return var(name)

    def _slope(self, name: str) -> Expr:
        return self.declare(name, "slope of a candidate by a state, both by their sizes")

    def along(self, i: int, matrix: Sequence[Sequence[Expr]]) -> list[Row]:
        """The equations of the slopes by state i, where `matrix` is P, with a column for each of `group.free`."""
        found, slopes = [], self.slopes[i]
        for k, line in enumerate(matrix):
            found.append(self.row(product(line, [slopes[d] for d in self.group.free]), const(float(k == i))))
        for row in self.group.rows:
            used = [d for d in self.scales if d in row.leaves]
            terms = [mul(mul(partial(row.residual, d), self.scales[d]), slopes[d]) for d in used]
            found.append(self.row(reduce(add, terms), ZERO))
        return found

    def row(self, lhs: Expr, rhs: Expr) -> Row:
        source = self.group.rows[-1].source
        text = f"choice of states for  {source.text}"
        return Row(lhs, rhs, flat.Equation(lhs, rhs, source.span, source.origin, text))


class Watch(Tangent):
    """An assert that states that nothing else may be in place of stay good ones."""

    def rows(self) -> list[Row]:
        unit = [[const(float(i == k)) for k in range(len(self.slopes))] for i in range(len(self.slopes))]
        return [row for i in range(len(self.slopes)) for row in self.along(i, unit)]

    def condition(self, reset: Collection[str]) -> flat.Assert:
        """`reset`: names of what reinits set."""
        others = self.group.others
        named = [d for d in others if d.args[0].op == "var"]
        squares = reduce(add, [mul(w, w) for slopes in self.slopes for w in (slopes[d] for d in others)])
        names = ", ".join(text_of(d.args[0]) for d in self.group.selected)
        better = ", ".join(dict.fromkeys(str(base_of(d).value) for d in named or others))
        pinned = [str(base_of(d).value) for d in self.group.selected if base_of(d).value in reset]
        advice = f"write stateSelect=StateSelect.prefer for {better}"
        if pinned:
            advice = f"a reinit of {pinned[0]} makes it one; let it set {better} instead"
        message = f"{names} cannot be the state here: {advice}"
        bound = const(len(others) / WATCHED**2)
        text = self.group.rows[-1].source.text
        return flat.Assert(relation("<=", squares, bound), f"{message} ({text})", self.span)


def product(line: Sequence[Expr], values: Sequence[Expr]) -> Expr:
    return reduce(add, [mul(p, v) for p, v in zip(line, values, strict=True)])
