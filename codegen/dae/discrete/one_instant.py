"""Conditions that hold at one instant only: `x >= 1 and x <= 1`, which is x == 1.

Relations are frozen between events (Modelica 3.6, 8.5). At the event of `x >= 1` the other has become false, unless x
stays where it is, so the condition is never seen to hold on the way. Equality of Reals is refused for that reason; here
a warning says so, for x may stay.
"""

from __future__ import annotations

from collections.abc import Iterator

from lacuna.codegen import flat
from lacuna.codegen.dae.relations import Relation
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.symbolic.expr import Expr, walk
from lacuna.codegen.symbolic.rewrite import expressions


def one_instant(model: flat.FlatModel, relations: list[Relation]) -> list[Diagnostic]:
    """A warning for each pair of frozen relations that one condition asks for together."""
    number = {(r.left, r.right): k for k, r in enumerate(relations)}
    opposite = {k: j for k, r in enumerate(relations) if (j := number.get((r.right, r.left))) is not None}
    if not opposite:
        return []
    found = {}
    for e in _conditions(model):
        for n in walk(e):
            denied = {a.args[0].value for a in _parts(n) if a.op == "not" and a.args[0].op == "rel"}
            found |= {min(k, opposite[k]): None for k in denied if opposite.get(k) in denied}
    return [_warning(relations[k]) for k in found]


def _conditions(model: flat.FlatModel) -> Iterator[Expr]:
    for eq in model.equations:
        yield from (eq.lhs, eq.rhs)
    yield from expressions(model.whens)
    for a in model.algorithms:
        yield from expressions(a.statements)


def _parts(n: Expr) -> Iterator[Expr]:
    if n.op == "and":
        for a in n.args:
            yield from _parts(a)
    else:
        yield n


def _warning(r: Relation) -> Diagnostic:
    text = f"{r.left} >= {r.right} and {r.left} <= {r.right} hold together at one instant only, where no event is found"
    hint = f"a when-clause of `{r.left} >= {r.right}` alone happens once {r.left} gets there"
    return Diagnostic("S025", text, r.source.span, hint, severity="warning")
