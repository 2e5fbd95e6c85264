"""Algorithms that assign at all times and at events: Reals that no `when` assigns follow the time between events, too.

What such an algorithm assigns at all times becomes equations, as in an algorithm without `when`; the rest stays
statements that run at events and read, in the place of those Reals, what they are at that point.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.equations.symbolic_run import SymbolicRun
from lacuna.codegen.flatten.expressions.constants import variability
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import REAL, TRUE, Expr
from lacuna.codegen.symbolic.rewrite import Rewriter, all_statements, assigned


def lasting_targets(statements: Sequence[flat.Statement], context: Context) -> frozenset[str]:
    """The Reals that the algorithm assigns outside of `when` only, whole arrays together."""
    at_events = {n for s in all_statements(statements) if isinstance(s, flat.When) for n in assigned([s])}
    held = {id(context.scalars[n][0]) for n in at_events}

    def lasts(name: str) -> bool:
        leaf = context.scalars[name][0]
        continuous = variability(ex.var(name, leaf.primitive), context) == "continuous"
        return leaf.primitive == REAL and continuous and id(leaf) not in held

    return frozenset(filter(lasts, assigned(statements)))


def split_by_time(
    statements: Sequence[flat.Statement], lasting: Collection[str], run: SymbolicRun
) -> list[flat.Statement]:
    """What runs at events; `run` has then run the rest. Raises R059 for an if or a loop that assigns both."""

    def now(e: Expr) -> Expr | None:
        """What a Real is at this point: before the first assignment it has its start value (11.1.2)."""
        if e.op == "var" and e.value in lasting:
            return run.values[str(e.value)] if e.value in run.values else run.unassigned(str(e.value))
        return e if e.op in ("pre", "der") else None

    kept: list[flat.Statement] = []
    for s in statements:
        names = set(assigned([s]))
        if not isinstance(s, flat.When) and names and names <= set(lasting):
            run.block([s], TRUE)
        elif not isinstance(s, flat.When) and names & set(lasting):
            both = f"{min(names & set(lasting))} at all times and {min(names - set(lasting))} at events"
            hint = "assign them in two statements"
            raise Diagnostic("R059", f"one statement of an algorithm with 'when' assigns {both}", s.span, hint)
        elif isinstance(s, flat.Assert):
            run.block([s], TRUE)
        else:
            kept.append(Rewriter(now).statement(s))
    return kept
