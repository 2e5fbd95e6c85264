"""What the believed model says drives something: differences that stand in its equations."""

from __future__ import annotations

from lacuna.codegen.symbolic.expr import walk
from lacuna.discovery.efforts.places.opened import Opened


def written_differences(opened: Opened) -> frozenset[frozenset[str]]:
    """Pairs of variables of which one less the other stands in an equation of the believed model."""
    aliases = opened.linear.prepared.aliases
    sides = {s for e in opened.believed.declared.equations for s in (e.lhs, e.rhs)}
    found = {n.args for s in sides for n in walk(s) if n.op == "-" and all(a.op == "var" for a in n.args)}
    return frozenset(frozenset(aliases.get(str(a.value), (str(a.value), 1))[0] for a in pair) for pair in found)
