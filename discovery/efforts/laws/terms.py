"""Terms that a law at any place may be the sum of, in the model's own variables, each scaled by its largest value.

Powers of either sign, relaxations, roots, dry and saturating forms, exponentials, dead zones, waves along a variable,
products of two, and a quantity that another one saturates (an inductance that falls with the current: a rate times a
function). Texts are Modelica.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from lacuna.codegen.units.inference import SECOND
from lacuna.discovery.efforts.insertion import KEPT
from lacuna.discovery.efforts.linear import Along
from lacuna.discovery.law.law_terms import Group, Shape, Variable
from lacuna.runtime.model import Variable as ModelVariable
from lacuna.units import parse_unit

MOST = 12  # variables at a place, the nearest first: their pairs are what a search costs
APART = 6  # differences of variables at most: of three places with their surroundings all
SAME = 1e-3  # of their largest value, within which a variable is a polynomial of another one
DEGREE = 3  # of that polynomial
MOVES = 1e-6  # share of its largest value that a variable must move by
LEAST = 1.5  # cycles over the range: less of a wave is a bend, which powers say with fewer numbers
CYCLES = 30  # of a wave along a variable, over the range that it has
TURN = 1.6  # rad from one wave number to the next at the ends of the range: so that none is missed
AWAY = 0.05  # of its largest value, that a variable stays above for laws that divide by it
BEYOND = (1.5, 2.0)  # powers of what is beyond a threshold: weirs, contacts
EXPONENTS = (0.5, 1.5, 2.0, 3.0, 4.0)  # where powers start: flow through an orifice to radiation
OCTAVES = 3.0  # from one time constant of a relaxation to the next: half a bandwidth either way
_WHOLE = (1 / 3, 2 / 3, 1.0, 7 / 4, *EXPONENTS, 5.0)


def variables(
    along: Sequence[Along], location: str, known: Mapping[str, ModelVariable], states: list[str],
    answering: frozenset[str], added: frozenset[str] = frozenset(),
) -> list[Variable]:  # fmt: skip
    """The variables of a law at `location`, the nearest first; those that follow from another one are left out, and
    those of components that were `added` to the believed model: what is found there may yet be found anew.

    `answering` are those that the effort changes at once: they are in the balance that says what the effort is, and a
    sum of them is that balance again. Of them only rates of states serve, where something else multiplies them.
    """
    units = {n: v.unit for n, v in known.items()}
    names = [n for n, v in along[0].values.items() if np.ndim(v) == 1 and (n in units or n.startswith("der("))]
    names = [n for n in names if not n.startswith("probe") and (n not in answering or n.startswith("der("))]
    names = [n for n in names if n.removeprefix("der(").partition(".")[0] not in added]
    largest: dict[str, float] = {}
    for n in names:
        unit = units.get(n, n)
        largest[unit] = max(largest.get(unit, 0.0), max(float(np.abs(a.values[n]).max()) for a in along))
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
        unit = units.get(name) or _rate(units.get(name.removeprefix("der(").removesuffix(")"), ""))
        driven = name in known and known[name].kind == "input"
        kind = "state" if name in order else "rate" if name in answering else "input" if driven else "other"
        switch = name in known and known[name].type == "Boolean"
        sticks = kind == "state" and f"der({name})" in answering
        kept.append(Variable(f"x{len(kept) + 1}", name, unit, kind, float(f"{size:.2g}"), switch, sticks=sticks))
        courses.append(scaled)
        if len(kept) == MOST:
            break
    believed = {n: u for n, u in units.items() if n.partition(".")[0] not in added}
    moving = [n for n in states if n in names and np.ptp(np.concatenate([a.values[n] for a in along])) > 0]
    return [*kept, *_differences(along, kept, moving, believed, location)]


def _differences(
    along: Sequence[Along], kept: list[Variable], states: list[str], units: Mapping[str, str], location: str
) -> list[Variable]:  # fmt: skip
    """What drives a flow between two places: states less states, inputs and parameters of the same unit; those that are
    no multiple of a variable that is there. The ones that hold the place's own state come first."""
    fixed = {n for n, v in along[0].values.items() if np.ndim(v) == 0 and units.get(n) and v != 0}
    states = [n for n in states if units.get(n)]
    pairs = [(a, b) for k, a in enumerate(states) for b in states[k + 1 :] if units[a] == units[b]]
    pairs += [(a, b.name) for a in states for b in kept if b.kind in ("other", "input") and units[a] == b.unit]
    pairs += [(a, n) for a in states for n in sorted(fixed) if units[a] == units[n]]
    pairs.sort(key=lambda pair: not any(n == location or n.rpartition(".")[0] == location for n in pair))
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


def _says_nothing_new(course: np.ndarray, known: np.ndarray) -> bool:
    """Whether a quantity is another one on another scale, or a power of it (an energy beside a speed)."""
    basis = np.vander(known, DEGREE + 1)
    return bool(np.abs(course - basis @ np.linalg.lstsq(basis, course, rcond=None)[0]).max() < SAME)


def _rate(unit: str) -> str:
    return str(parse_unit(unit) / SECOND) if unit else ""


def groups(
    found: Sequence[Variable], ranges: dict[str, tuple[float, float]], interval: float, duration: float
) -> list[Group]:
    """Every group of terms in these variables; `ranges` are those of their scaled values, `interval` and `duration`
    (s) those of the samples and of the longest recording."""
    result = [Group(("1",))]
    for v in found:
        result += _remembering(v, interval, duration) if v.kind not in ("rate", "above") else []
        result += _late(v, interval, duration) if v.kind == "input" else []
        low, high = ranges[v.local]
        if v.switch:
            result.append(Group((v.scaled,)))
        elif v.kind != "rate":
            result += _alone(v) if low < 0 < high else _of_one_sign(v, low > AWAY or high < -AWAY)
        if v.kind == "state":
            result += _waves(v, high - low) + _varying(v, interval, duration)
    plain = [v for v in found if v.kind not in ("apart", "above")]
    for a in plain:
        for b in plain:
            if a is not b and b.kind != "rate":
                both = a.kind != "rate" and a.local > b.local
                result += _together(a, b, ranges[a.local][0] < 0 < ranges[a.local][1], not both)
    return result


def counts(found: Sequence[Variable], offered: Sequence[Group]) -> tuple[int, int]:
    """Kinds of groups of one variable and of several."""
    kinds = {group.texts for group in offered}
    several = sum(sum(any(f"{v.local}_ref" in text for text in texts) for v in found) > 1 for texts in kinds)
    return len(kinds) - several, several


def _of_one_sign(v: Variable, away: bool) -> list[Group]:
    """`away`: from zero, so that one may divide by it."""
    x = v.scaled
    power = _powers(f"abs{x}") + ([Group((f"1/{x}",))] if away else [])
    bend = [
        Group((f"exp({{q}}*{x})",), (Shape("q", "1", q, min(q / 9, q * 9), max(q / 9, q * 9), (), 3.0),))
        for q in (-4, 4)
    ]
    ends = [
        Group((f"(abs({x} - {{q}}) + {x} - {{q}})",), (Shape("q", "1", q, -0.99, 0.99, (), 0.25),))
        for q in (0.25, 0.5, 0.75)
    ]
    ends += [
        Group((f"abs(abs({x} - {{q}}) + {x} - {{q}})^{p}",), (Shape("q", "1", q, -0.99, 0.99, (), 0.25),))
        for p in BEYOND for q in (0.25, 0.5, 0.75)
    ]  # fmt: skip
    ends += [
        Group((f"({x} + {{q}} - abs({x} - {{q}}))",), (Shape("q", "1", q, -0.99, 0.99, (), 0.25),))
        for q in (0.25, 0.5, 0.75)
    ]  # up to a limit: what a dead zone loses, what a stop leaves
    return [Group((x,)), *power, *bend, *ends]


def _powers(base: str) -> list[Group]:
    """Powers with the exponents that physics has, and with any other."""
    free = [Group((f"{base}^{{p}}",), (Shape("p", "1", p, 0.1, 8.0, _WHOLE, 0.75),)) for p in (0.75, 2.5, 5.0)]
    return [*(Group((f"{base}^{p:.4g}",)) for p in EXPONENTS), *free]


def _alone(v: Variable) -> list[Group]:
    x, sign = v.scaled, f"sign({v.local})"
    power = [Group((f"{sign}*abs{x}^{p:.4g}",)) for p in EXPONENTS]
    power += [Group((f"{sign}*abs{x}^{{p}}",), (Shape("p", "1", p, 0.1, 8.0, _WHOLE, 0.75),)) for p in (0.75, 2.5, 5.0)]
    bend = [
        Group((f"exp({{q}}*{x})",), (Shape("q", "1", q, min(q / 9, q * 9), max(q / 9, q * 9), (), 3.0),))
        for q in (-4, 4)
    ]
    reach = [
        Group((f"tanh({{q}}*{x})",), (Shape("q", "1", q, 0.5, 5e3, (), 0.8 * q),)) for q in (3.0, 15.0, 75.0, 375.0)
    ]
    ends = [
        Group((f"(abs({side}{x} - {{q}}) + {side}{x} - {{q}})",), (Shape("q", "1", q, -0.99, 0.99, (), 0.25),))
        for side in ("", "-") for q in (0.0, 0.5)
    ]  # fmt: skip
    ends += [
        Group((f"({x} - 0.5*abs({x} + {{q}}) + 0.5*abs({x} - {{q}}))",), (Shape("q", "1", q, 0.01, 0.99, (), 0.25),))
        for q in (0.25, 0.5, 0.75)
    ]  # both ways
    ends += [
        Group((f"(abs({x} + {{q}}) - abs({x} - {{q}}))",), (Shape("q", "1", q, 0.01, 0.99, (), 0.25),))
        for q in (0.25, 0.5, 0.75)
    ]  # up to a limit either way
    stribeck = Group((v.dry, f"{v.dry}*exp(-abs{x}/{{q}})"), (Shape("q", "1", 0.1, 0.01, 1.0, (), 0.08),))
    plain = [Group((x,)), Group((f"abs{x}",)), Group((f"{x}^2",)), Group((v.dry,))]
    return [*plain, *power, *bend, *reach, *ends, stribeck]


def _remembering(v: Variable, interval: float, duration: float) -> list[Group]:
    """A relaxation: storage behind a resistance, a damper behind a spring, a winding around a core; all that is faster
    than the samples or slower than a recording is something else."""
    return [Group((f"({v.scaled} - lag({v.scaled}, {{t}}))",), (s,)) for s in _times(interval, duration)]


def _late(v: Variable, interval: float, duration: float) -> list[Group]:
    """A command that arrives late: kept in so many samples that the delay is of tens of them at least, or of few of the
    recording's own. Before a recording it was what it is at its start, or nothing was commanded."""
    result = []
    for shape in _times(interval, duration):
        apart = interval * np.ceil(OCTAVES * shape.start / ((KEPT - 1) * interval))
        own = replace(shape, upper=(KEPT - 1) * float(apart))
        result += [
            Group((f"({v.scaled} - {before}({v.scaled}, {{t}}, {apart:.6g}))",), (own,))
            for before in ("delay", "onset")
        ]
    return result


def _varying(v: Variable, interval: float, duration: float) -> list[Group]:
    """A coefficient that varies with what it has carried of late, as a winding's resistance does when it warms."""
    return [Group((f"{v.scaled}*lag({v.scaled}^2, {{t}})",), (s,)) for s in _times(interval, duration)]


def _times(interval: float, duration: float) -> list[Shape]:
    """Time constants between the samples' interval and a recording's duration."""
    count = max(2, int(np.ceil(np.log(duration / interval) / np.log(OCTAVES))))
    times = [float(t) for t in interval * OCTAVES ** (np.arange(count) + 0.5) if t < duration]
    return [Shape("t", "s", t, max(t / 9, interval), t * 9, (), 0.6 * t) for t in times]


def _waves(v: Variable, span: float) -> list[Group]:
    """Waves along a variable: sine and cosine, the wave numbers so close that the next is never out of step."""
    step = TURN / max(span, 1e-9)
    numbers = np.arange(2 * np.pi * LEAST / max(span, 1e-9), 2 * np.pi * CYCLES / max(span, 1e-9), step)
    return [
        Group(
            (f"sin({{k}}*{v.scaled})", f"cos({{k}}*{v.scaled})"),
            (Shape("k", "1", float(k), 0.5 * k, 2.0 * k, (), step),),
        )
        for k in numbers
    ]


def saturating(v: Variable) -> Group:
    """What a coefficient loses as a quantity grows: a core that saturates."""
    return Group((f"(1/(1 + {{q}}*{v.scaled}^2) - 1)",), (Shape("q", "1", 1.0, 0.01, 100.0, (), 0.9),))


def _together(a: Variable, b: Variable, signed: bool, once: bool) -> list[Group]:
    """Products: those that are alike both ways once."""
    x, y = a.scaled, b.scaled
    if b.switch:  # any function of it is the same again
        return [Group((f"{x}*{y}",))] if once else []
    saturating = Group((f"({x}/(1 + {{q}}*{y}^2) - {x})",), (Shape("q", "1", 1.0, 0.01, 100.0, (), 0.9),))
    found = [Group((f"{x}*{y}^2",)), Group((f"{x}*abs{y}",)), saturating]
    found += [Group((f"{a.dry}*abs{y}",))] if signed and a.kind != "rate" else []
    return [Group((f"{x}*{y}",)), *found] if once else found
