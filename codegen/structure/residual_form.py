"""The residual form for IDA: states and their derivatives known, what can be is computed in sequence, the
rest of the algebraic variables (the tears) become unknowns of the integrator."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import or_

from lacuna.codegen.structure.causal import LinearBlock, Step, rows_of, unknowns_of
from lacuna.codegen.structure.reach import Reach, Users, users_of
from lacuna.codegen.structure.sorting.tearing import Assignment, Tearing, Torn
from lacuna.codegen.structure.system import Row, System
from lacuna.codegen.symbolic.differentiate import Differentiator
from lacuna.codegen.symbolic.expr import ONE, ZERO, Expr, der, is_const, substitute, var
from lacuna.codegen.symbolic.leaves import leaves


@dataclass
class ResidualForm:
    """F(t, [x; z], y'): the assignments that the residuals need, in order, then one residual a row."""

    assignments: list[Assignment]
    tears: list[Expr]
    residuals: list[Row]


def residual_form(system: System, explicit: Sequence[Step], tearing: Tearing) -> ResidualForm:
    """Derivatives that equal a state (speeds) are taken from it everywhere but in the equation that says so. Where the
    sequence would amplify rounding, unknowns of linear blocks of the explicit form are left to the integrator whole.
    What no derivative depends on is none of its business: outputs and guards are computed by the explicit form."""
    states = set(system.states)
    own, unknowns = _of_derivatives(system, explicit)
    speeds = dict(filter(None, (_speed(row, states) for row in own)))
    rows = [row if _speed(row, states) else _with_speeds(row, speeds) for row in own]
    rough = [d for d in system.derivatives if d not in speeds]
    algebraics = [v for n in system.algebraics if (v := var(n)) in unknowns]
    orders = (tearing.tear(rows, algebraics, rough, values_first=first) for first in (False, True))
    torn = min(orders, key=lambda torn: nonzeros(torn, system))
    if tearing.amplifies(torn, map(var, system.states)):
        blocks = [unknowns_of(step) for step in explicit if isinstance(step, LinearBlock)]
        known = set(algebraics)  # slopes of a choice of states are none: no derivative depends on them
        torn = tearing.tear(rows, algebraics, rough, [u for block in blocks for u in block if u in known])
    used = needed(torn.assignments, (row.leaves for row in torn.residuals))
    return ResidualForm(used, torn.tears, torn.residuals)


def _of_derivatives(system: System, explicit: Sequence[Step]) -> tuple[list[Row], set[Expr]]:
    """The rows, in their order, that derivatives of states follow from, and their unknowns."""
    wanted, rows, unknowns = set(system.derivatives), set(), set()
    for step in reversed(explicit):
        if wanted.isdisjoint(unknowns_of(step)):
            continue
        own = rows_of(step)
        rows.update(own)
        unknowns.update(unknowns_of(step))
        wanted.update(*(row.leaves for row in own))
    return [row for row in system.rows if row in rows], unknowns


def nonzeros(torn: Torn, system: System) -> int:
    """Entries of the Jacobian that the integrator would see: a sum of currents carried along a ladder, say, makes each
    equation depend on all derivatives before it, where differences of voltages know their neighbours only."""
    columns = {var(name): 1 << k for k, name in enumerate(system.states)}
    columns |= {der(n): bit for n, bit in columns.items()}
    columns |= {tear: 1 << k for k, tear in enumerate(torn.tears, len(system.states))}

    def of(used: Iterable[Expr]) -> int:
        return reduce(or_, (columns.get(n, 0) for n in used), 0)

    for step in torn.assignments:
        columns[step.unknown] = of(leaves(step.value))
    return sum(of(row.leaves).bit_count() for row in torn.residuals)


def _speed(row: Row, states: set[str]) -> tuple[Expr, Expr] | None:
    """(der(x), w) of an equation w = der(x) between states."""
    for derivative, value in ((row.lhs, row.rhs), (row.rhs, row.lhs)):
        if derivative.op == "der" and value.op == "var" and value.value in states:
            return derivative, value
    return None


def _with_speeds(row: Row, speeds: dict[Expr, Expr]) -> Row:
    if not any(n in speeds for n in row.leaves):
        return row
    return Row(substitute(row.lhs, speeds), substitute(row.rhs, speeds), row.source, row.integral)


def needed(assignments: Sequence[Assignment], wanted: Iterable[frozenset[Expr]]) -> list[Assignment]:
    """Those assignments, in order, that the wanted leaves depend on."""
    live = set().union(*wanted)
    kept = []
    for step in reversed(assignments):
        if step.unknown in live:
            kept.append(step)
            live |= leaves(step.value)
    return kept[::-1]


CJ = var("$cj")


@dataclass
class Jacobian:
    """Columns of dF/dy + cj dF/dy': `tangents` are derivatives of assigned variables to compute in order,
    each a (name, value); `entries[column]` lists (row, value)."""

    tangents: list[tuple[Expr, Expr]]
    entries: list[list[tuple[int, Expr]]]


def jacobian(form: ResidualForm, system: System) -> Jacobian:
    """Forward differentiation through the assigned sequence, one column at a time. The state x and its
    derivative share a column: their seeds are 1 and cj."""
    result = Jacobian([], [])
    users = (users_of(leaves(s.value) for s in form.assignments), users_of(leaves(r.residual) for r in form.residuals))
    for name, derivative in zip(system.states, system.derivatives, strict=True):
        result.entries.append(_column({var(name): ONE, derivative: CJ}, form, users, result, name))
    for tear in form.tears:
        result.entries.append(_column({tear: ONE}, form, users, result, str(tear.value)))
    return _without_unused(result)


def _without_unused(found: Jacobian) -> Jacobian:
    """A derivative that only ever meets a factor of zero, as that of a table with one row, is not computed."""
    live = set().union(*(leaves(value) for column in found.entries for _, value in column))
    kept = []
    for tangent, value in reversed(found.tangents):
        if tangent in live:
            kept.append((tangent, value))
            live |= leaves(value)
    return Jacobian(kept[::-1], found.entries)


def _column(
    seeds: dict[Expr, Expr], form: ResidualForm, users: tuple[Users, Users], result: Jacobian, name: str
) -> list[tuple[int, Expr]]:
    differentiate = Differentiator(lambda n: seeds.get(n, ZERO), seeds.keys())
    chain, rows = Reach(users[0], seeds), Reach(users[1], seeds)
    for k in chain:
        step = form.assignments[k]
        value = differentiate(step.value)
        if is_const(value, 0):
            continue
        if value.args:
            tangent = var(f"$d {step.unknown.value} d {name}")
            result.tangents.append((tangent, value))
            value = tangent
        seeds[step.unknown] = value
        chain.add(step.unknown)
        rows.add(step.unknown)
    columns = ((k, differentiate(form.residuals[k].residual)) for k in rows)
    return [(k, value) for k, value in columns if not is_const(value, 0)]
