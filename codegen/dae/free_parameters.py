"""Parameters with fixed = false: what the initial equations determine (Modelica 3.6, 8.6).

    p = e, e of parameters and time p is a dependent parameter (time being that of the start)
    p = e, any other                p is discrete and takes its value at the start, if no other initial equation has p
    p in any other equation         p is a Real that does not move, der(p) = 0, an unknown of the initial system

A parameter that depends on one of the latter two follows it, as a discrete or a continuous variable.
"""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.symbolic.expr import (
    BOOLEAN,
    FALSE,
    REAL,
    START_TIME,
    TIME,
    TRUE,
    ZERO,
    Expr,
    const,
    der,
    var,
    walk,
)
from lacuna.codegen.symbolic.leaves import leaves, with_leaves
from lacuna.codegen.symbolic.rewrite import expressions

_RANK = {flat.CONSTANT: 0, flat.PARAMETER: 0, flat.DISCRETE: 1, flat.CONTINUOUS: 2}


def free_parameters(model: flat.FlatModel) -> flat.FlatModel:
    """The model without them. Raises S023 where a value before the start would depend on one, or none determines it."""
    free = {v.name for v in model.variables.values() if v.variability == flat.PARAMETER and v.fixed is FALSE}
    if not free:
        return model
    variables, initial = _explicit(dict(model.variables), list(model.initial_equations), free)
    equations = list(model.equations)
    initial += _start_equations(variables, free)
    for name in [n for n in variables if n in free]:
        equations += _converted(variables, initial, name)
    equations += _followers(variables)
    _check_attributes(variables)
    _check_samples(model, variables)
    return replace(model, variables=variables, initial_equations=initial, equations=equations)


def _explicit(
    variables: dict[str, flat.Variable], initial: list[flat.Equation], free: set[str]
) -> tuple[dict[str, flat.Variable], list[flat.Equation]]:
    """Bindings from initial equations in parameters that are known; their names leave `free`."""
    while True:
        for eq in initial:
            found = next(((n, e) for n, e in _definitions(eq) if n in free and _is_known(e, variables, free)), None)
            if found:
                name, value = found
                value = with_leaves(value, {TIME: START_TIME})
                variables[name] = replace(variables[name], binding=value, fixed=None, final=True)
                free.discard(name)
                initial = [other for other in initial if other is not eq]
                break
        else:
            return variables, initial


def _definitions(eq: flat.Equation) -> list[tuple[str, Expr]]:
    """(name, value) of each side that is a variable which the other side does not hold."""
    sides = ((eq.lhs, eq.rhs), (eq.rhs, eq.lhs))
    return [(str(a.value), b) for a, b in sides if a.op == "var" and a not in leaves(b)]


def _start_equations(variables: dict[str, flat.Variable], free: set[str]) -> list[flat.Equation]:
    """Equations for fixed start values that depend on one of `free` (8.6); as a guess each start value stays, of what
    these are guessed to be."""
    equations: list[flat.Equation] = []
    for v in [v for v in variables.values() if v.start is not None and v.variability == flat.CONTINUOUS]:
        if _is_known(v.start, variables, free):
            continue
        if v.fixed is TRUE:
            equations.append(flat.Equation(var(v.name, v.type), v.start, v.span, "", f"{v.name} = {v.start}"))
        variables[v.name] = replace(v, start=_guess(v.start, variables, free), fixed=None)
    return equations


def _guess(e: Expr, variables: dict[str, flat.Variable], free: set[str]) -> Expr:
    """`e` with start values in the place of `free` parameters."""
    guesses = {}
    for n in leaves(e):
        v = variables.get(str(n.value)) if n.op == "var" else None
        if v is not None and not _is_known(n, variables, free):
            inner = (v.start or {REAL: ZERO, BOOLEAN: FALSE}.get(v.type, const(0))) if v.name in free else v.binding
            guesses[n] = n if inner is None else _guess(inner, variables, free)
    return with_leaves(e, guesses)


def _is_known(e: Expr, variables: dict[str, flat.Variable], free: set[str]) -> bool:
    """Does `e` depend on parameters and the start time only, and through their bindings on no free parameter?"""
    for leaf in leaves(e) - {TIME}:
        v = variables.get(str(leaf.value)) if leaf.op == "var" else None
        if v is None or v.name in free or v.variability not in (flat.CONSTANT, flat.PARAMETER):
            return False
        if v.binding is not None and not _is_known(v.binding, variables, free):
            return False
    return True


def _converted(variables: dict[str, flat.Variable], initial: list[flat.Equation], name: str) -> list[flat.Equation]:
    """`name` as a variable, with the equation that it needs while it does not move."""
    v = variables[name]
    users = [eq for eq in initial if var(name, v.type) in leaves(eq.lhs) | leaves(eq.rhs)]
    given = [e for eq in users for n, e in _definitions(eq) if n == name]
    explicit = given and not any(_follows(e, name, variables) for e in given)
    if (len(users) == 1 or v.type != REAL) and explicit:
        variables[name] = replace(v, variability=flat.DISCRETE)
        return []
    if v.type != REAL:
        raise Diagnostic(
            "S023", f"no initial equation gives the parameter {name}, which has fixed=false, by itself", v.span,
            f"write an initial equation {name} = ..., or give it a value",
        )  # fmt: skip
    variables[name] = replace(v, variability=flat.CONTINUOUS, free=True)
    text = f"der({name}) = 0"
    return [flat.Equation(der(var(name)), ZERO, v.span, "", text)]


def _follows(e: Expr, name: str, variables: dict[str, flat.Variable]) -> bool:
    """Does `e` depend on `name` through the bindings of other parameters?"""
    names = [str(n.value) for n in leaves(e) if n.op == "var"]
    bindings = [variables[n].binding for n in names if n in variables]
    return name in names or any(b is not None and _follows(b, name, variables) for b in bindings)


def _followers(variables: dict[str, flat.Variable]) -> list[flat.Equation]:
    """Equations of the parameters that depend on what is no parameter any more."""
    equations: list[flat.Equation] = []
    changed = True
    while changed:
        changed = False
        for v in list(variables.values()):
            if v.variability not in (flat.CONSTANT, flat.PARAMETER) or v.binding is None:
                continue
            used = [variables[str(n.value)].variability for n in leaves(v.binding) if n.op == "var"]
            rank = max((_RANK[u] for u in used), default=0)
            if rank:
                kind = flat.DISCRETE if rank == 1 or v.type != REAL else flat.CONTINUOUS
                variables[v.name] = replace(v, variability=kind, binding=None)
                text = f"{v.name} = {v.binding}"
                equations.append(flat.Equation(var(v.name, v.type), v.binding, v.span, "", text))
                changed = True
    return equations


def _check_samples(model: flat.FlatModel, variables: dict[str, flat.Variable]) -> None:
    """The times of sample() must be known before the start is."""
    conditions = [*((e.lhs, e.rhs, e.span) for e in model.equations)]
    conditions += [(e, e, w.span) for w in model.whens for e in expressions([w])]
    conditions += [(e, e, a.span) for a in model.algorithms for e in expressions(a.statements)]
    for *parts, span in conditions:
        for n in (n for e in parts for n in walk(e) if n.op == "sample"):
            for leaf in (leaf for argument in n.args for leaf in leaves(argument) if leaf.op == "var"):
                if variables[str(leaf.value)].variability not in (flat.CONSTANT, flat.PARAMETER):
                    message = f"sample at times that depend on {leaf.value}, which the initial equations determine"
                    raise Diagnostic("S023", message, span, "give it a value of its own")


def _check_attributes(variables: dict[str, flat.Variable]) -> None:
    moved = {n for n, v in variables.items() if v.variability in (flat.DISCRETE, flat.CONTINUOUS)}
    for v in variables.values():
        for attribute in (v.start, v.min, v.max, v.nominal):
            if attribute is None:
                continue
            name = next((str(n.value) for n in leaves(attribute) if n.op == "var" and n.value in moved), None)
            if name is not None:
                raise Diagnostic(
                    "S023", f"an attribute of {v.name} depends on {name}, which the initial equations determine",
                    v.span, "give it a value of its own",
                )  # fmt: skip
