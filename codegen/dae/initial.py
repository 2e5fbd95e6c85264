"""The initial system: all equations, the initial equations and fixed start values, states unknown too.

Where that leaves unknowns open, start values of further states are used (with a warning that lists them). Where a mode
makes nothing of an equation (the acceleration of a friction that sticks is zero, whatever its torque), what it would
have given has its start value in that mode: a guess, as 8.6 calls it. A warning names the states that follow.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from lacuna.codegen import flat
from lacuna.codegen.dae.divisions import changes
from lacuna.codegen.dae.operators.homotopy import rows_at_start
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.causal import Assignment, Division, Step, causalise, following, unknowns_of
from lacuna.codegen.structure.sorting.matching import Matching
from lacuna.codegen.structure.sorting.tearing import Tearing
from lacuna.codegen.structure.system import Row, System
from lacuna.codegen.symbolic.expr import Expr, const, neg, pre, sub, var
from lacuna.codegen.symbolic.leaves import leaves


@dataclass
class InitialSystem:
    """`steps` compute all unknowns; `from_start` says that the states are simply their start values; `redundant` are
    equations of fixed start values that the others determine, which have to give the same."""

    steps: list[Step]
    from_start: bool
    warnings: list[Diagnostic] = field(default_factory=list)
    redundant: list[flat.Equation] = field(default_factory=list)


def initial_system(system: System, equations: list[flat.Equation], tearing: Tearing) -> InitialSystem:
    """Rows for every state, derivative and algebraic variable, in the order in which they are solved."""
    unknowns = [*map(var, system.states), *system.unknowns]
    column = {u: k for k, u in enumerate(unknowns)}
    rows = [*rows_at_start(system), *_distinct(equations)]
    matching = Matching([_columns(r, column) for r in rows], len(unknowns))
    unmatched = matching.match_all()
    if unmatched:
        _refuse(system, rows, unknowns, matching, unmatched)
    redundant = []
    for name in _fixed(system):
        row = _start_row(system, name)
        if matching.add_row([column[var(name)]]):
            rows.append(row)
        elif _may_agree(system, rows, matching, row, column, equations):
            redundant.append(row.source)
        else:
            _refuse_start(rows, matching, row, column)
    assumed = _assume_starts(system, rows, unknowns, matching, column)
    steps = [_guessed(s, system.model) for s in causalise(rows, unknowns, tearing)]
    own = {*map(var, system.states)}
    trivial = not any(row.source.start for row in rows) and all(
        isinstance(s, Assignment) and s.row.source.text.startswith("start of") for s in steps
        if own & set(unknowns_of(s))
    )  # fmt: skip
    warnings = [*_warnings(system, assumed), *_warnings_of_modes(system, steps), *map(_warning_of_check, redundant)]
    return InitialSystem(steps, trivial, warnings, redundant)


def _guessed(step: Step, model: flat.FlatModel) -> Step:
    """A division by what a mode makes nothing keeps the start value there, where nothing is asked of it."""
    if not isinstance(step, Division):
        return step
    return replace(step, guess=const(0.0) in _branches(step.denominator) and _is_of_mode(step.denominator, model))


def _branches(e: Expr) -> list[Expr]:
    return [b for a in e.args[1:] for b in _branches(a)] if e.op == "if" else [e]


def _is_of_mode(e: Expr, model: flat.FlatModel) -> bool:
    """Whether `e` changes at events, and at events only."""
    own = [n for n in leaves(e) if n.op != "var" or model.variables[str(n.value)].variability != flat.PARAMETER]
    return bool(own) and not changes(e, model)


def _warnings_of_modes(system: System, steps: list[Step]) -> list[Diagnostic]:
    states, found = {*map(var, system.states)}, []
    for step in steps:
        follow = following(steps, [step.unknown]) & states if isinstance(step, Division) and step.guess else ()
        if isinstance(step, Division) and follow:
            text = f"where {step.denominator} is zero, {step.unknown} is open at the start: its start value is taken"
            hint = f"what follows are {', '.join(sorted(map(str, follow)))}: give one in place of an initial equation"
            found.append(Diagnostic("S021", text, step.row.source.span, hint, severity="warning"))
    return found


def _distinct(equations: list[flat.Equation]) -> list[Row]:
    """Rows of the initial equations; of those that say the same, as ends of two joined lines may do, the first."""
    rows: dict[Expr, Row] = {}
    for e in equations:
        same = [sub(e.lhs, e.rhs), sub(e.rhs, e.lhs)]
        same += [sub(neg(e.lhs), neg(e.rhs)), sub(neg(e.rhs), neg(e.lhs))]
        if rows.keys().isdisjoint(same):
            rows[same[0]] = Row(e.lhs, e.rhs, e)
    return list(rows.values())


def _columns(row: Row, column: dict[Expr, int]) -> list[int]:
    return sorted(column[n] for n in row.leaves if n in column)


def _fixed(system: System) -> list[str]:
    variables = system.model.variables
    return [
        name for name in (*system.states, *system.algebraics)
        if (f := variables[name].fixed) is not None and f.op == "const" and f.value
    ]  # fmt: skip


def _start_row(system: System, name: str) -> Row:
    """What a variable begins with: of a state what the caller gives it, else what is declared; it is there already."""
    v = system.model.variables[name]
    declared = v.start if v.start is not None else const(0.0)
    start = pre(var(name)) if name in system.states else declared
    return Row(var(name), start, flat.Equation(var(name), declared, v.span, "", f"start of {name}"))


def _assume_starts(
    system: System, rows: list[Row], unknowns: list[Expr], matching: Matching, column: dict[Expr, int]
) -> list[str]:
    assumed = []
    if len(rows) < len(unknowns):
        states = [*(n for n in system.states if n not in system.dynamic), *system.preferred]
        variables = system.model.variables
        given = sorted(states, key=lambda n: (variables[n].free, variables[n].start is None))
        for name in dict.fromkeys((*given, *system.algebraics)):
            if len(rows) < len(unknowns) and matching.add_row([column[var(name)]]):
                rows.append(_start_row(system, name))
                assumed.append(name)
    return assumed


def _warnings(system: System, assumed: list[str]) -> list[Diagnostic]:
    """One for each start value that is used. Raises S023 where it is that of a parameter, which has to follow from
    equations (8.6)."""
    variables = system.model.variables
    open_ended = next((name for name in assumed if variables[name].free), "")
    if open_ended:
        message = f"no initial equation determines the parameter {open_ended}, which has fixed=false"
        hint = f"write an initial equation for it, or give it a value: {open_ended} = ..."
        raise Diagnostic("S023", message, variables[open_ended].span, hint)
    return [
        Diagnostic(
            "S021", f"the initial value of {name} is not fixed; its start value {variables[name].start or 0.0} is used",
            variables[name].span, "write fixed=true, or give an initial equation", severity="warning",
        )
        for name in assumed
    ]  # fmt: skip


def _refuse(system: System, rows: list[Row], unknowns: list[Expr], matching: Matching, unmatched: list[int]) -> None:
    over, columns = matching.overdetermined(unmatched)
    if not columns:
        message = f"too many initial equations: nothing in {rows[over[0]].text} is unknown"
        hint = "a parameter is, with fixed=false and no value: k(fixed=false) = break takes away that of its class"
        raise Diagnostic("S020", message, rows[over[0]].source.span, hint)
    names = ", ".join(str(unknowns[c]) for c in columns[:8])
    raise Diagnostic(
        "S020", f"too many initial equations: {len(over)} for {names}", rows[unmatched[0]].source.span,
        "remove an initial equation, or fixed=true of a start value",
        [(rows[r].source.span, rows[r].text) for r in over[:12]],
    )  # fmt: skip


def _determining(rows: list[Row], matching: Matching, row: Row, column: dict[Expr, int]) -> list[Row]:
    """The rows that determine the variable of a start row which cannot be added."""
    over, _ = matching.overdetermined([matching.row_of[column[row.lhs]]])
    return [rows[r] for r in over]


def _may_agree(
    system: System,
    rows: list[Row],
    matching: Matching,
    row: Row,
    column: dict[Expr, int],
    initial: list[flat.Equation],
) -> bool:
    """Whether a start row repeats what the model makes of others: three fixed currents of a star, of which two
    determine the third. Where initial equations determine it one of them is most likely meant to go, and so it is
    where a state, which a caller of the run may give, would not have its value."""
    written = set(map(id, initial))
    return row.lhs.value not in system.states and all(
        id(r.source) not in written for r in _determining(rows, matching, row, column)
    )


def _warning_of_check(start: flat.Equation) -> Diagnostic:
    text = f"other initial conditions determine {start.lhs} already, which has a fixed start value"
    hint = "the run ends where they give another value; drop fixed=true where that may be"
    return Diagnostic("S022", text, start.span, hint, severity="warning")


def _refuse_start(rows: list[Row], matching: Matching, row: Row, column: dict[Expr, int]) -> None:
    raise Diagnostic(
        "S022", f"{row.lhs} has a fixed start value, but other initial conditions determine it already",
        row.source.span, "drop fixed=true here or on one of the variables below",
        [(r.source.span, r.text) for r in _determining(rows, matching, row, column)[:12]],
    )  # fmt: skip
