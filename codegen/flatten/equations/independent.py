"""The parts of an algorithm that do not depend on the order in which they stand, each an algorithm by itself.

What a part reads of another one is final when it reads it, so it is the same whether the statements stand in one
section or in two (11.1). An event-generating function of what `when` has set, `integer(n*time)`, is then an equation
beside it.
"""

from __future__ import annotations

from collections.abc import Sequence

from lacuna.codegen import flat
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.structure.sorting.blocks import strong_components
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import assigned, expressions
from lacuna.codegen.symbolic.union_find import UnionFind


def independent_parts(statements: Sequence[flat.Statement], context: Context) -> list[list[flat.Statement]]:
    """The statements of each part, in their order; parts in the order in which they begin."""
    count = len(statements)
    gives = [{_variable(n, context) for n in assigned([s])} for s in statements]
    takes = [
        {_variable(str(n.value), context) for e in expressions([s]) for n in leaves(e) if n.op == "var"}
        for s in statements
    ]
    last = {variable: k for k, given in enumerate(gives) for variable in given}
    parts = UnionFind()
    for k in range(count):
        parts.find(k)
        for variable in (*gives[k], *(t for t in takes[k] if last.get(t, -1) > k)):
            parts.join(last[variable], k)
    groups = [
        [k for k in range(count) if parts.find(k) == root] for root in dict.fromkeys(map(parts.find, range(count)))
    ]
    of = {k: number for number, group in enumerate(groups) for k in group}
    needs = [
        sorted({of[last[t]] for k in group for t in takes[k] if t in last} - {number})
        for number, group in enumerate(groups)
    ]
    whole = [sorted(k for number in circle for k in groups[number]) for circle in strong_components(needs)]
    return [[statements[k] for k in part] for part in sorted(whole)]


def _variable(name: str, context: Context) -> object:
    """Elements of an array are assigned as one (11.1.2)."""
    found = context.scalars.get(name)
    return id(found[0]) if found is not None else name
