"""Algorithms that assign at all times and at events: Reals that no `when` assigns follow the time between events, too.

What such an algorithm assigns at all times becomes equations, as in an algorithm without `when`; the rest stays
statements that run at events and read, in the place of those Reals, what they are at that point.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.equations.symbolic_run import SymbolicRun
from lacuna.codegen.flatten.expressions.constants import variability
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import REAL, TRUE, Expr
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import Rewriter, all_statements, assigned, expressions


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
    statements: Sequence[flat.Statement],
    lasting: Collection[str],
    run: SymbolicRun,
    before: frozenset[str] = frozenset(),
    after: frozenset[str] = frozenset(),
) -> list[flat.Statement]:
    """What runs at events; `run` has then run the rest. `before`, `after`: what is assigned at every pass before these
    statements, and behind them. Raises R059 for a loop that assigns both kinds, and for what is not a value that lasts.
    """
    kept: list[flat.Statement] = []
    for k, s in enumerate(statements):
        names, behind = set(assigned([s])), after | _at_every_pass(statements[k + 1 :])
        if isinstance(s, flat.When) or not (names & set(lasting) or isinstance(s, flat.Assert)):
            if not isinstance(s, flat.When):
                _refuse_loop(s)
            kept.append(_at_this_point(lasting, run).statement(s))
        else:
            _refuse_passing(s, lasting, before & behind)
            if names <= set(lasting):
                run.block([s], TRUE)
            else:
                kept.append(_split_choice(s, lasting, run, before, behind))
        before |= _at_every_pass([s])
    return kept


def _at_every_pass(statements: Sequence[flat.Statement]) -> frozenset[str]:
    return frozenset(assigned([s for s in statements if not isinstance(s, flat.When)]))


def _at_this_point(lasting: Collection[str], run: SymbolicRun) -> Rewriter:
    """What Reals are at this point: before the first assignment they have their start values (11.1.2)."""

    def now(e: Expr) -> Expr | None:
        if e.op == "var" and e.value in lasting:
            return run.values[str(e.value)] if e.value in run.values else run.unassigned(str(e.value))
        return e if e.op in ("pre", "der") else None

    return Rewriter(now)


def _refuse_passing(s: flat.Statement, lasting: Collection[str], passing: frozenset[str]) -> None:
    """Raises R059 where a Real follows what a later statement of each pass overwrites: only its last value lasts. What
    is overwritten by when-clauses alone, or read before it is assigned, is at the end of an event what it was."""
    read = {str(n.value) for e in expressions([s]) for n in leaves(e) if n.op == "var"}
    if found := read & passing - set(lasting):
        name = min(found)
        hint = f"give what {name} is here a variable of its own"
        raise Diagnostic("R059", f"{name} is read between two of its assignments", s.span, hint)


def _refuse_loop(s: flat.Statement) -> None:
    """Raises R059 for a loop beside when-clauses that is not unrolled: its relations change while it runs."""
    loop = next((inner for inner in all_statements([s]) if isinstance(inner, flat.While)), None)
    if loop is not None:
        hint = "write it inside of when, or put it in a function and call it"
        raise Diagnostic("R059", "a loop beside when-clauses that sets what is discrete", loop.span, hint)


def _split_choice(
    s: flat.Statement, lasting: Collection[str], run: SymbolicRun, before: frozenset[str], after: frozenset[str]
) -> flat.Statement:
    """An if that assigns both kinds: what of it runs at events."""
    if not isinstance(s, flat.If) or any(isinstance(inner, flat.When | flat.Break) for inner in all_statements([s])):
        names = set(assigned([s]))
        both = f"{min(names & set(lasting))} at all times and {min(names - set(lasting))} at events"
        hint = "assign them in two statements"
        raise Diagnostic("R059", f"one loop of an algorithm with 'when' assigns {both}", s.span, hint)
    point = _at_this_point(lasting, run)
    values, where, asserts = dict(run.values), dict(run.where), list(run.asserts)
    branches = []
    for condition, body in s.branches:
        run.values = dict(values)
        branches.append((point.expression(condition), split_by_time(body, lasting, run, before, after)))
        run.where, run.asserts = dict(where), list(asserts)
    run.values = values
    run.block([_lasting_part(s, lasting)], TRUE)
    return replace(s, branches=branches)


def _lasting_part(s: flat.If, lasting: Collection[str]) -> flat.If:
    branches = []
    for condition, body in s.branches:
        parts = [_lasting_part(b, lasting) if isinstance(b, flat.If) else b for b in body]
        lasts = [b for b in parts if isinstance(b, flat.Assert | flat.If) or set(assigned([b])) <= set(lasting)]
        branches.append((condition, lasts))
    return replace(s, branches=branches)
