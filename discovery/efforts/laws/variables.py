"""Which quantities of the model a law at a place may be of: the nearest first, none that follows from another.

Besides states, inputs and what else moves, a state less what is of its unit is one: flows follow differences.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from lacuna.discovery.catalogue.attachment import OWN
from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.places.sites import MOST
from lacuna.discovery.law.terms.law_terms import Variable
from lacuna.runtime.model import Variable as ModelVariable
from lacuna.units import per_second

APART = 6  # differences of variables at most: of three places with their surroundings all
SAME = 1e-3  # of their largest value, within which a variable is a polynomial of another one
DEGREE = 3  # of that polynomial
MOVES = 1e-6  # share of its largest value that a variable must move by


def variables(
    along: Sequence[Along], location: str, known: Mapping[str, ModelVariable], states: list[str],
    answering: frozenset[str], added: Callable[[str], bool] = lambda name: False,
    written: frozenset[frozenset[str]] = frozenset(),
) -> list[Variable]:  # fmt: skip
    """The variables of a law at `location`, the nearest first; those that follow from another one are left out, and
    those of components that were `added` to the believed model: what is found there may yet be found anew.

    `answering` are those that the effort changes at once: they are in the balance that says what the effort is, and a
    sum of them is that balance again. Of them only rates of states serve, where something else multiplies them.
    `written` are pairs of variables whose difference stands in the model.
    """
    units = {n: v.unit for n, v in known.items()}
    names = [n for n, v in along[0].values.items() if np.ndim(v) == 1 and (n in units or n.startswith("der("))]
    names = [n for n in names if not n.startswith(OWN) and (n not in answering or n.startswith("der("))]
    names = [n for n in names if not added(n)]
    largest = _largest(along, names, units)
    order = {s: k for k, s in enumerate(states)}

    def rank(name: str) -> tuple:
        inner = name.removeprefix("der(").removesuffix(")")
        near = inner == location or inner.rpartition(".")[0] == location
        return name.startswith("der(") and not near, not near, inner not in order, name.startswith("der("), name

    kept: list[Variable] = []
    courses: list[np.ndarray] = []
    for name in sorted(names, key=rank):
        course = np.concatenate([a.values[name] for a in along])
        size = float(np.abs(course).max(initial=0.0))
        if not np.isfinite(size) or np.ptp(course) <= MOVES * largest[units.get(name, name)]:
            continue
        scaled = course / size
        if any(_says_nothing_new(scaled, c) for c in courses):
            continue
        unit = units.get(name) or per_second(units.get(name.removeprefix("der(").removesuffix(")"), ""))
        driven = name in known and known[name].kind == "input"
        kind = "state" if name in order else "rate" if name in answering else "input" if driven else "other"
        switch = name in known and known[name].type == "Boolean"
        sticks = kind == "state" and f"der({name})" in answering
        kept.append(Variable(f"x{len(kept) + 1}", name, unit, kind, float(f"{size:.2g}"), switch, sticks=sticks))
        courses.append(scaled)
        if len(kept) == MOST:
            break
    believed = {n: u for n, u in units.items() if not added(n)}
    moving = [n for n in states if n in names and np.ptp(np.concatenate([a.values[n] for a in along])) > 0]
    kept += _differences(along, kept, names, moving, believed, location, written)
    found = [*_with_rates(along, kept, states), *_of_recordings(along, known, added, len(kept))]
    return [*found, *_through(along, location, believed, answering, len(found))]


def _largest(along: Sequence[Along], names: Sequence[str], units: Mapping[str, str]) -> dict[str, float]:
    """The largest values, by unit; by name where there is none."""
    largest: dict[str, float] = {}
    for n in names:
        unit = units.get(n, n)
        largest[unit] = max(largest.get(unit, 0.0), max(float(np.abs(a.values[n]).max()) for a in along))
    return largest


def _through(
    along: Sequence[Along], location: str, units: Mapping[str, str], answering: frozenset[str], count: int
) -> list[Variable]:
    """What an effort at a place changes at once, of the component there: the current through a resistor, say. No law is
    of it as it is, but what warms up remembers its square."""
    place = {location, location.rpartition(".")[0]}
    known = answering & units.keys() & along[0].values.keys()
    near = sorted(n for n in known if n.rpartition(".")[0] in place or n in place)
    courses = {n: np.concatenate([a.values[n] * np.ones(len(a.time)) for a in along]) for n in near}
    return _of_their_own(courses, units, "through", count, APART // 2)


def _of_recordings(
    along: Sequence[Along], known: Mapping[str, ModelVariable], added: Callable[[str], bool], count: int
) -> list[Variable]:  # fmt: skip
    """Parameters that differ between recordings, none of which follows from another: what a law's coefficient may be
    of, as friction is of the load that is carried."""
    fixed = [n for n, v in known.items() if v.kind == "parameter" and np.ndim(along[0].values.get(n, ())) == 0]
    values = {n: np.array([float(a.values[n]) for a in along]) for n in fixed if not added(n)}
    return _of_their_own(values, {n: known[n].unit for n in values}, "recording", count, APART)


def _of_their_own(
    courses: Mapping[str, np.ndarray], units: Mapping[str, str], kind: str, count: int, most: int
) -> list[Variable]:
    """Variables behind so many others: up to `most` that move, none of which follows from another."""
    found: list[Variable] = []
    kept: list[np.ndarray] = []
    for name, course in courses.items():
        size = float(np.abs(course).max(initial=0.0))
        if not np.isfinite(size) or np.ptp(course) <= MOVES * size:
            continue
        if any(_says_nothing_new(course / size, other) for other in kept):
            continue
        found.append(Variable(f"x{count + len(found) + 1}", name, units[name], kind, float(f"{size:.2g}")))
        kept.append(course / size)
        if len(found) == most:
            break
    return found


def _differences(
    along: Sequence[Along], kept: list[Variable], names: list[str], states: list[str], units: Mapping[str, str],
    location: str, written: frozenset[frozenset[str]],
) -> list[Variable]:  # fmt: skip
    """What drives a flow between two places: states less states, inputs and parameters of the same unit, and less what
    the model itself takes from them, far as it may be; those that are no multiple of a variable that is there. The
    ones that hold the place's own state come first, of them those that drive something in the model."""
    fixed = {n for n, v in along[0].values.items() if np.ndim(v) == 0 and units.get(n) and v != 0}
    taken = {*states, *(v.name for v in kept)}
    stated = sorted(n for n in set().union(*written) if n in names and units.get(n) and n not in taken)
    states = [n for n in states if units.get(n)]
    pairs = [(a, b) for k, a in enumerate(states) for b in states[k + 1 :] if units[a] == units[b]]
    pairs += [(a, b.name) for a in states for b in kept if b.kind in ("other", "input") and units[a] == b.unit]
    pairs += [(a, b) for a in states for b in stated if {a, b} in written and units[a] == units[b]]
    pairs += [(a, n) for a in states for n in sorted(fixed) if units[a] == units[n]]

    def rank(pair: tuple[str, str]) -> tuple[bool, bool]:
        return not any(n == location or n.rpartition(".")[0] == location for n in pair), set(pair) not in written

    pairs.sort(key=rank)
    courses = [np.concatenate([v.course(a.values) for a in along]) for v in kept]
    found: list[Variable] = []
    for name, minus in pairs:
        course = np.concatenate([a.values[name] - a.values[minus] for a in along])
        size = float(np.abs(course).max(initial=0.0))
        if not np.isfinite(size) or size <= MOVES * np.abs(np.concatenate([a.values[name] for a in along])).max():
            continue
        if any(abs(course @ c) > (1 - SAME**2) * np.linalg.norm(course) * np.linalg.norm(c) for c in courses):
            continue
        kind = "apart" if np.ndim(along[0].values[minus]) else "above"
        number = len(kept) + len(found) + 1
        found.append(Variable(f"x{number}", name, units[name], kind, float(f"{size:.2g}"), minus=minus))
        courses.append(course)
        if len(found) == APART:
            break
    return found


def _with_rates(along: Sequence[Along], found: list[Variable], states: list[str]) -> list[Variable]:
    """The variables, each with the one that is its rate, where either is made of states: something moves."""
    known = [n for n in states if np.ndim(along[0].values.get(f"der({n})", 0.0))]
    if not known:
        return found
    basis = np.column_stack([*(_joined(along, n) for n in known), np.ones(len(_joined(along, known[0])))])
    rates = np.column_stack([_joined(along, f"der({n})") for n in known])
    plain = [v for v in found if v.kind in ("state", "apart")]
    if not plain:
        return found
    courses = np.column_stack([np.concatenate([v.course(a.values) for a in along]) for v in plain])
    made = np.linalg.lstsq(basis, courses, rcond=None)[0]
    exact = np.abs(courses - basis @ made).max(axis=0) <= SAME * np.abs(courses).max(axis=0)
    changes = rates @ made[:-1]
    result = dict.fromkeys((v.local for v in found), "")
    for k, v in enumerate(plain):
        if exact[k]:
            off = np.abs(courses - changes[:, [k]]).max(axis=0) <= SAME * np.abs(courses).max(axis=0)
            result[v.local] = next((plain[n].local for n in np.flatnonzero(off)), "")
    return [replace(v, rate=result[v.local]) for v in found]


def _joined(along: Sequence[Along], name: str) -> np.ndarray:
    return np.concatenate([a.values[name] for a in along])


def _says_nothing_new(course: np.ndarray, known: np.ndarray) -> bool:
    """Whether a quantity is another one on another scale, or a power of it (an energy beside a speed)."""
    basis = np.vander(known, DEGREE + 1)
    return bool(np.abs(course - basis @ np.linalg.lstsq(basis, course, rcond=None)[0]).max() < SAME)
