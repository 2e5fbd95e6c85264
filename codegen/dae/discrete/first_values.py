"""What discrete variables are before the initial system is solved for the first time.

Those that an equation gives by parameters and time have that value: functions may have none at 0, and of several roots
of an equation the one is wanted that belongs to it (Modelica 3.6, 8.6: at the start all equations hold together). An
enumeration begins with its first literal (4.9.5).
"""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.symbolic.annotated import plain
from lacuna.codegen.symbolic.expr import START_TIME, TIME, Expr, const, transform, walk
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import assigned

_OF_EVENTS = frozenset(("sample", "edge", "change", "delay"))
_HELD = (flat.CONSTANT, flat.PARAMETER)


def first_values(model: flat.FlatModel) -> flat.FlatModel:
    """The model with these as start values, where none is declared."""
    variables, known = dict(model.variables), {TIME: START_TIME}
    for v in model.variables.values():
        if v.variability == flat.DISCRETE and v.enumeration and v.start is None:
            variables[v.name] = replace(v, start=const(1))
    for name, n, defined in _followers(model):
        known[n] = transform(plain(defined), lambda e: known.get(e) or _unguarded(e), {})
        if model.variables[name].start is None:
            variables[name] = replace(variables[name], start=known[n])
    return replace(model, variables=variables)


def _unguarded(e: Expr) -> Expr | None:
    """Nothing is an event before the start."""
    return e.args[0] if e.op in ("noEvent", "smooth") else None


def _followers(model: flat.FlatModel) -> list[tuple[str, Expr, Expr]]:
    """Name, variable and value of the discrete variables that follow from parameters and time at all times, each after
    those that it follows from."""
    at_events = {n for w in model.whens for n in assigned([w])}.union(*(a.targets for a in model.algorithms))
    missing: dict[str, set[str]] = {}  # of each candidate: of what it follows and what has no value yet
    readers: dict[str, list[str]] = {}
    found = {}
    for eq in model.equations:
        name = str(eq.lhs.value) if eq.lhs.op == "var" else ""
        v = model.variables.get(name)
        if v is None or v.variability != flat.DISCRETE or v.causality == "input" or name in at_events:
            continue
        needed = {n for n in leaves(eq.rhs) if n is not TIME}
        if any(n.op != "var" for n in needed) or any(n.op in _OF_EVENTS for n in walk(eq.rhs)):
            continue
        names = {str(n.value) for n in needed}
        missing[name] = {n for n in names if model.variables[n].variability not in _HELD}
        found[name] = (name, eq.lhs, eq.rhs)
        for n in missing[name]:
            readers.setdefault(n, []).append(name)
    ready = [name for name, of in missing.items() if not of]
    order = []
    while ready:
        name = ready.pop()
        order.append(found[name])
        for reader in readers.get(name, ()):
            missing[reader].discard(name)
            if not missing[reader]:
                ready.append(reader)
    return order
