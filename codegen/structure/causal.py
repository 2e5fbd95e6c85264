"""Causalisation: matching, block lower triangular form and torn blocks, as a sequence of steps to compute.

The same procedure serves the explicit form (states known) and the initial system (states unknown too).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from lacuna.codegen.structure.reach import Reach, users_of
from lacuna.codegen.structure.sorting.blocks import strong_components
from lacuna.codegen.structure.sorting.matching import Matching
from lacuna.codegen.structure.sorting.tearing import Assignment, Tearing
from lacuna.codegen.structure.system import Row
from lacuna.codegen.symbolic.affine import UNSAFE, isolate
from lacuna.codegen.symbolic.differentiate import Differentiator
from lacuna.codegen.symbolic.expr import ONE, ZERO, Expr, neg
from lacuna.codegen.symbolic.leaves import leaves, with_leaves


@dataclass(eq=False)
class Division:
    """unknown = numerator / denominator, where the denominator may vanish: checked when computed. `guess`: where
    that makes 0 = 0 the unknown keeps the value it had."""

    unknown: Expr
    numerator: Expr
    denominator: Expr
    row: Row
    guess: bool = False


@dataclass(eq=False)
class LinearBlock:
    """matrix * tears = right side, then the assignments in order."""

    tears: list[Expr]
    matrix: list[list[Expr]]
    right: list[Expr]
    assignments: list[Assignment]
    residuals: list[Row]


@dataclass(eq=False)
class NonlinearBlock:
    """Newton iteration over the tears: assignments in order, then residuals and jacobian[row][tear]."""

    tears: list[Expr]
    assignments: list[Assignment]
    residuals: list[Row]
    jacobian: list[list[Expr]]


Step = Assignment | Division | LinearBlock | NonlinearBlock


def causalise(rows: Sequence[Row], unknowns: Sequence[Expr], tearing: Tearing) -> list[Step]:
    """Steps that solve a structurally regular square system, each using only what earlier steps give."""
    column = {u: k for k, u in enumerate(unknowns)}
    incidence = [sorted(column[n] for n in row.leaves if n in column) for row in rows]
    matching = Matching(incidence, len(unknowns))
    unmatched = matching.match_all()
    assert not unmatched and len(rows) == len(unknowns), [rows[r].text for r in unmatched]
    needs = [[matching.row_of[c] for c in columns] for columns in incidence]
    steps: list[Step] = []
    for component in strong_components(needs):
        block_unknowns = sorted(matching.column_of[r] for r in component)
        steps += _block([rows[r] for r in component], [unknowns[c] for c in block_unknowns], tearing)
    return steps


def _block(rows: list[Row], unknowns: list[Expr], tearing: Tearing) -> list[Step]:
    if len(rows) == 1:
        single = _single(rows[0], unknowns[0], tearing)
        if single:
            return [single]
    if not _is_linear(rows, set(unknowns)):
        torn = tearing.tear_at_guesses(rows, unknowns)
        return [_nonlinear(torn.assignments, torn.tears, torn.residuals)]
    torn = tearing.tear(rows, unknowns)
    if tearing.amplifies(torn):
        torn = tearing.steady.tear(rows, unknowns)
    if tearing.amplifies(torn):
        return [_linear([], unknowns, rows)]
    return [_linear(torn.assignments, torn.tears, torn.residuals)]


def _single(row: Row, unknown: Expr, tearing: Tearing) -> Assignment | Division | None:
    rank, value = tearing.explicit(row, unknown)
    if rank < UNSAFE:
        return Assignment(unknown, value, row)
    parts = isolate(row.lhs, row.rhs, unknown)
    return Division(unknown, *parts, row) if parts else None


def _is_linear(rows: list[Row], unknowns: set[Expr]) -> bool:
    """Whether all rows are jointly affine in the unknowns, and no condition depends on one."""
    for row in rows:
        for u in unknowns & row.leaves:
            parts = isolate(row.lhs, row.rhs, u)
            if parts is None or leaves(parts[1]) & unknowns:
                return False
    return True


def _linear(chain: list[Assignment], tears: list[Expr], residuals: list[Row]) -> LinearBlock:
    at_zero: dict[Expr, Expr] = dict.fromkeys(tears, ZERO)
    for step in chain:
        at_zero[step.unknown] = with_leaves(step.value, at_zero)
    right = [neg(with_leaves(row.residual, at_zero)) for row in residuals]
    matrix = _jacobian(tears, chain, residuals)
    return LinearBlock(tears, matrix, right, chain, residuals)


def _jacobian(tears: list[Expr], chain: list[Assignment], residuals: list[Row]) -> list[list[Expr]]:
    """d residuals / d tears, through the chain."""
    matrix: list[list[Expr]] = [[ZERO] * len(tears) for _ in residuals]
    users = users_of(leaves(step.value) for step in chain), users_of(row.leaves for row in residuals)
    for column, tear in enumerate(tears):
        seeds = {tear: ONE}
        differentiate = Differentiator(lambda n, seeds=seeds: seeds.get(n, ZERO), seeds.keys())
        steps, rows = Reach(users[0], seeds), Reach(users[1], seeds)
        for k in steps:
            unknown = chain[k].unknown
            seeds[unknown] = differentiate(chain[k].value)
            steps.add(unknown)
            rows.add(unknown)
        for k in rows:
            matrix[k][column] = differentiate(residuals[k].residual)
    return matrix


def _nonlinear(chain: list[Assignment], tears: list[Expr], residuals: list[Row]) -> NonlinearBlock:
    return NonlinearBlock(tears, chain, residuals, _jacobian(tears, chain, residuals))


def unknowns_of(step: Step) -> list[Expr]:
    if isinstance(step, Assignment | Division):
        return [step.unknown]
    return [*step.tears, *(a.unknown for a in step.assignments)]


def rows_of(step: Step) -> list[Row]:
    """The equations that a step solves."""
    if isinstance(step, Assignment | Division):
        return [step.row]
    return [*step.residuals, *(a.row for a in step.assignments)]


def expressions_of(step: Step) -> list[Expr]:
    """Everything that a step computes."""
    match step:
        case Assignment():
            return [step.value]
        case Division():
            return [step.numerator, step.denominator]
        case LinearBlock():
            own = [*(a for line in step.matrix for a in line), *step.right]
        case NonlinearBlock():
            own = [*(a for line in step.jacobian for a in line), *(row.residual for row in step.residuals)]
    return own + [a.value for a in step.assignments]


def upstream(steps: Sequence[Step], wanted: Iterable[Expr]) -> Iterator[Step]:
    """What is computed on the way to the wanted unknowns, from behind."""
    wanted = set(wanted)
    for step in reversed(steps):
        if wanted.isdisjoint(unknowns_of(step)):
            continue
        for e in expressions_of(step):
            wanted |= leaves(e)
        yield step


def of_nonlinear(steps: Sequence[Step]) -> set[Expr]:
    """Unknowns that nonlinear equations give, or that follow from those: they may have several values at one point."""
    return following(steps, starts=lambda step: isinstance(step, NonlinearBlock))


def following(
    steps: Sequence[Step], begun: Collection[Expr] = (), starts: Callable[[Step], bool] = lambda step: False
) -> set[Expr]:
    """Unknowns that follow from `begun`, or from steps that `starts` names."""
    found = set(begun)
    for step in steps:
        if starts(step) or any(not found.isdisjoint(leaves(e)) for e in expressions_of(step)):
            found.update(unknowns_of(step))
    return found.difference(begun)


def rewritten(step: Step, rule: Callable[[Expr], Expr]) -> Step:
    """The step with `rule` applied to everything that it computes."""
    match step:
        case Assignment():
            return replace(step, value=rule(step.value))
        case Division():
            return replace(step, numerator=rule(step.numerator), denominator=rule(step.denominator))
    assignments = [replace(a, value=rule(a.value)) for a in step.assignments]
    if isinstance(step, NonlinearBlock):
        jacobian = [[rule(a) for a in line] for line in step.jacobian]
        return replace(step, assignments=assignments, jacobian=jacobian)
    matrix = [[rule(a) for a in line] for line in step.matrix]
    return replace(step, assignments=assignments, matrix=matrix, right=[rule(b) for b in step.right])
