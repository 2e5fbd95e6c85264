"""Terms that a law at any place may be the sum of, in the model's own variables, each scaled by its largest value.

Powers of either sign, relaxations, roots, dry and saturating forms, exponentials, dead zones, waves along a variable,
products of two, and a quantity that another one saturates (an inductance that falls with the current: a rate times a
function). Texts are Modelica.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lacuna.discovery.efforts.laws.lagging import ageing, late, remembering, swinging
from lacuna.discovery.efforts.places.sites import MOST
from lacuna.discovery.law.terms.forms import is_of_several
from lacuna.discovery.law.terms.law_terms import BEYOND, DRY, EXPONENTS, Group, Shape, Variable, exponent, stribeck

LEAST = 1.5  # cycles over the range: less of a wave is a bend, which powers say with fewer numbers
CYCLES = 30  # of a wave along a variable, over the range that it has
TURN = 1.6  # rad from one wave number to the next at the ends of the range: so that none is missed
AWAY = 0.05  # of its largest value, that a variable stays above for laws that divide by it, or hold by it at rest


def groups(
    found: Sequence[Variable], ranges: dict[str, tuple[float, float]], interval: float, duration: float
) -> list[Group]:
    """Every group of terms in these variables; `ranges` are those of their scaled values, `interval` and `duration`
    (s) those of the samples and of the longest recording."""
    result = [Group(("1",))]
    result += [g for v in found if v.kind == "unheld" for g in _bounded(v)]
    common = [v for v in found if v.kind not in ("recording", "unheld", "through")]
    for v in common:
        result += remembering(v, common, interval, duration) if v.kind not in ("rate", "above") else []
        result += late(v, interval, duration) if v.kind == "input" else []
        result += swinging(v, common, interval, duration) if v.sticks else []
        low, high = ranges[v.local]
        if v.switch:
            result.append(Group((v.scaled,)))
        elif v.kind != "rate":
            result += _alone(v) if low < 0 < high else _of_one_sign(v, low, high)
        result += _driven(v, common, ranges) if v.kind == "apart" else []
        own = [rate for rate in common if rate.local == v.rate]
        result += [g for rate in own for g in (*_contacts(v, rate, low < 0 < high), *_hysteretic(v, rate, high - low))]
        free = next((w for w in found if w.kind == "unheld" and w.name == f"der({v.name})"), None)
        result += [g for rate in common if rate.name == f"der({v.name})" for g in _humped(v, rate, free, low, high)]
        if v.kind == "state":
            result += _waves(v, high - low) + _turning(v, high - low)
    result += _aged(found, common, ranges, interval, duration)
    plain = [v for v in common if v.kind not in ("apart", "above")]
    for a in plain:
        for b in plain:
            if a is not b and b.kind != "rate":
                both = a.kind != "rate" and a.local > b.local
                result += _together(a, b, ranges, not both)
    return result + [g for v in found if v.kind == "recording" for g in _in_proportion(v, result)]


def _aged(
    found: Sequence[Variable], common: Sequence[Variable], ranges: dict[str, tuple[float, float]], interval: float,
    duration: float,
) -> list[Group]:  # fmt: skip
    """Coefficients of one of the nearest variables, or by themselves, that change with what any one has done, with time
    alone, or with what goes through the place itself; those of others with what these have done."""

    def done(v: Variable) -> list[str]:
        return [v.scaled if ranges[v.local][0] >= 0 else f"abs{v.scaled}", f"{v.scaled}^2"]

    does = [v for v in common if v.kind not in ("rate", "above") and not v.switch]
    every = ["1", *(g for v in does for g in done(v))]
    own = [v for v in found if v.kind == "through"]
    near, far = does[: MOST // 3], does[MOST // 3 :]  # pairs with every one of all would be most of what is offered
    behind = [("", every), *((v.scaled, every) for v in near), *((v.scaled, done(v)) for v in far)]
    behind += [(factor, done(v)) for v in own for factor in ("", v.scaled)]
    result = [g for factor, what in behind for g in ageing(factor, what, interval, duration)]
    for v in does:
        over = zip(beyond(v.scaled), thresholds(*ranges[v.local]), strict=True)
        result += [g for text, found in over for q in found for g in ageing("", [text], interval, duration, (q,))]
    return result


def _bounded(v: Variable) -> list[Group]:
    """A rate that goes no further either way: an amplifier that slews, a valve that is open all the way."""
    return [
        Group((f"bounded({v.scaled}, {{q}})",), (Shape("q", "1", q, 0.01, 0.99, (), 0.25),), held=True)
        for q in (1 / 16, 0.25, 0.5, 0.75)
    ]


def _in_proportion(v: Variable, others: Sequence[Group]) -> list[Group]:
    """What is one term without a shape in other variables, and goes with a power of what differs between recordings."""
    plain = [group.texts[0] for group in others if len(group.texts) == 1 and not group.shapes]
    factors = [v.scaled, *(f"abs{v.scaled}^{p}" for p in (2, 3)), f"1/{v.scaled}"]
    return [Group((f if text == "1" else f"{text}*{f}",)) for text in plain for f in factors]


def counts(found: Sequence[Variable], offered: Sequence[Group]) -> tuple[int, int]:
    """Kinds of groups of one variable, and of several or of what was done since the start."""
    kinds = {group.kind for group in offered}
    several = sum(is_of_several(kind, found) for kind in kinds)
    return len(kinds) - several, several


def _of_one_sign(v: Variable, low: float, high: float) -> list[Group]:
    x = v.scaled
    power = _powers(f"abs{x}") + ([Group((f"1/{x}",))] if low > AWAY or high < -AWAY else [])  # one may divide by it
    bend = _exponential(f"{{q}}*{x}")
    upwards, _ = thresholds(low, high)
    ends = [Group((beyond(x)[0],), (q,)) for q in upwards]
    ends += [Group((f"abs{beyond(x)[0]}^{p}",), (q,)) for p in BEYOND for q in upwards]
    ends += [Group((f"({x} + {{q}} - abs({x} - {{q}}))",), (q,)) for q in upwards]  # up to a limit: what a dead zone
    return [Group((x,)), *power, *bend, *ends, *_yielding(v), *_falling_off(v)]  # loses, what a stop leaves


def _driven(v: Variable, found: Sequence[Variable], ranges: dict[str, tuple[float, float]]) -> list[Group]:
    """What goes with a power of one quantity less that of another one: a gas through a pipe with the squares of its
    pressures, radiation with fourth powers of temperatures."""
    ends = [w for name in (v.name, v.minus) for w in found if w.name == name and not w.minus]
    if len(ends) < 2 or any(ranges[w.local][0] < 0 for w in ends):
        return []
    a, b = ends
    x, y = f"abs{a.scaled}", f"abs({b.size / a.size:.15g}*{b.scaled})"
    fixed = [Group((f"({x}^{p:.4g} - {y}^{p:.4g})",)) for p in EXPONENTS]
    return [*fixed, *(Group((f"({x}^{{p}} - {y}^{{p}})",), (exponent(p, 0.75),)) for p in (0.75, 2.5, 5.0))]


def thresholds(low: float, high: float) -> tuple[list[Shape], list[Shape]]:
    """Levels that a scaled variable goes beyond, upwards and downwards, at quarters of its range; of that from zero,
    where it comes nearer to that than half of what it reaches."""
    begin, end = low if low < 0 or low > 1 / 2 else 0.0, high if high > 0 or high < -1 / 2 else 0.0
    step, reach = (end - begin) / 4, 0.99 * (end - begin)
    up = [Shape("q", "1", begin + k * step, begin - reach, begin + reach, (), step) for k in (1, 2, 3)]
    return up, [replace(q, start=-q.start, lower=-q.upper, upper=-q.lower) for q in up]


def _yielding(v: Variable) -> list[Group]:
    """What grows less and less: sites that fill up, a rubber that softens, a core near its knee."""
    return [
        Group(
            (f"({v.scaled}/(1 + {{q}}*abs{v.scaled}) - {v.scaled})",), (Shape("q", "1", q, 0.01, 100.0, (), 0.9 * q),)
        )
        for q in (0.5, 5.0)
    ]


def _falling_off(v: Variable) -> list[Group]:
    """What has a largest value and falls behind it: the torque of an induction machine over its slip (Kloss), a
    reaction that its own substrate inhibits (Haldane); the largest at seven tenths and at a quarter of the range."""
    return [
        Group((f"{v.scaled}/(1 + {{q}}*{v.scaled}^2)",), (Shape("q", "1", q, 0.1, 1e3, (), 0.9 * q),))
        for q in (2.0, 16.0)
    ]


def _exponential(exponent: str, factor: str = "") -> list[Group]:
    """What grows or falls exponentially: a rate of reaction with temperature, a diode, a seal towards its seat."""
    return [
        Group((f"{factor}exp({exponent})",), (Shape("q", "1", q, min(q / 9, q * 9), max(q / 9, q * 9), (), 3.0),))
        for q in (-4, 4)
    ]


def _powers(base: str) -> list[Group]:
    """Powers with the exponents that physics has, and with any other."""
    free = [Group((f"{base}^{{p}}",), (exponent(p, 0.75),)) for p in (0.75, 2.5, 5.0)]
    return [*(Group((f"{base}^{p:.4g}",)) for p in EXPONENTS), *free]


def _alone(v: Variable) -> list[Group]:
    x, sign = v.scaled, f"sign({v.local})"
    power = [Group((f"{sign}*abs{x}^{p:.4g}",)) for p in EXPONENTS]
    power += [Group((f"{sign}*abs{x}^{{p}}",), (exponent(p, 0.75),)) for p in (0.75, 2.5, 5.0)]
    bend = _exponential(f"{{q}}*{x}")
    reach = [
        Group((f"tanh({{q}}*{x})",), (Shape("q", "1", q, 0.5, 5e3, (), 0.8 * q),)) for q in (3.0, 15.0, 75.0, 375.0)
    ]
    ends = [
        Group((text,), (Shape("q", "1", q, -0.99, 0.99, (), 0.25),)) for text in beyond(x) for q in (0.0, 0.5)
    ]  # fmt: skip
    ends += [
        Group((f"({x} - 0.5*abs({x} + {{q}}) + 0.5*abs({x} - {{q}}))",), (Shape("q", "1", q, 0.01, 0.99, (), 0.25),))
        for q in (1 / 16, 0.25, 0.5, 0.75)
    ]  # both ways
    ends += [
        Group((f"(abs({x} + {{q}}) - abs({x} - {{q}}))",), (Shape("q", "1", q, 0.01, 0.99, (), 0.25),))
        for q in (1 / 16, 0.25, 0.5, 0.75)
    ]  # up to a limit either way
    plain = [Group((x,)), Group((f"abs{x}",)), Group((f"{x}^2",)), Group((v.dry,))]
    return [*plain, *power, *bend, *reach, *ends, *_yielding(v), *_falling_off(v), stribeck(v)]


def beyond(x: str) -> tuple[str, str]:
    """Twice what goes beyond a level upwards, and downwards."""
    return f"(abs({x} - {{q}}) + {x} - {{q}})", f"(abs(-{x} - {{q}}) - {x} - {{q}})"


def _contacts(v: Variable, rate: Variable, both: bool) -> list[Group]:
    """Stops that spring and damp, from where they are met, on one side or on `both`; and play, in which neither a
    spring nor its damper acts."""
    x, y = v.scaled, rate.scaled
    touching = (f"{y}*(1 + sign({s}{x} - {{q}}))" for s in ("", "-"))
    pairs = list(zip(beyond(x), touching, strict=True))
    result = [Group(texts, (Shape("q", "1", q, -0.99, 0.99, (), 0.25),)) for texts in pairs for q in (-0.5, 0.0, 0.5)]
    if not both:
        return result
    pairs = [
        (f"({x} - 0.5*abs({x} + {{q}}) + 0.5*abs({x} - {{q}}))", f"{y}*(1 + sign(abs{x} - {{q}}))"),
        (f"(abs({x} + {{q}}) - abs({x} - {{q}}))", f"{y}*(1 - sign(abs{x} - {{q}}))"),
    ]
    return result + [
        Group(texts, (Shape("q", "1", q, 0.01, 0.99, (), 0.25),)) for texts in pairs for q in (0.25, 0.5, 0.75)
    ]


def _hysteretic(v: Variable, rate: Variable, span: float) -> list[Group]:
    """What depends on the way back and forth, and not on how fast it goes: bristles of a contact, ropes, rubber, seals;
    bent over a third of the way down to a hundredth."""
    times = [float(part * span * v.size / rate.size) for part in (0.3, 0.1, 0.03, 0.01)]
    return [
        Group((f"hysteresis({rate.scaled}, {{t}})",), (Shape("t", "s", t, t / 9, t * 9, (), 0.7 * t),)) for t in times
    ]


def _humped(v: Variable, rate: Variable, free: Variable | None, low: float, high: float) -> list[Group]:
    """A storage that takes more around a level: what melts, boils or is bound there; a quarter of the range wide, down
    to a sixteenth. As much as is believed to be stored, or tens of times that, which the `free` rate shows."""
    found = []
    hump = f"exp(-(({v.scaled} - {{m}})/{{d}})^2)"
    slowed = [f"{free.size / rate.size:.6g}*{free.scaled}*{hump}/(1 + {q}*{hump})" for q in (1, 5, 25)] if free else []
    for width in (high - low) / np.array([4.0, 8.0, 16.0]):
        for level in np.arange(low, high, width):
            shapes = (
                Shape("m", "1", float(level), low, high, (), float(width)),
                Shape("d", "1", float(width), float(width) / 9, float(width) * 9),
            )
            found += [Group((f"{rate.scaled}*{hump}",), shapes, seen=seen) for seen in ((), *((s,) for s in slowed))]
    return found


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


def _turning(v: Variable, span: float) -> list[Group]:
    """Waves along an angle of so many turns that others are not tried: orders of a turn, as poles, slots and teeth make
    them: whole ones, and above two dozen multiples of six, of three phases and two directions."""
    if v.unit != "rad":
        return []
    orders = [m for m in (*range(1, 25), *range(30, 97, 6)) if m * span * v.size > 2 * np.pi * CYCLES]
    return [
        Group((f"sin({{k}}*{v.scaled})", f"cos({{k}}*{v.scaled})"), (Shape("k", "1", k, 0.9 * k, 1.1 * k, (), 0.0),))
        for k in (m * v.size for m in orders)
    ]


def saturating(v: Variable) -> Group:
    """What a coefficient loses as a quantity grows: a core that saturates."""
    return Group((f"(1/(1 + {{q}}*{v.scaled}^2) - 1)",), (Shape("q", "1", 1.0, 0.01, 100.0, (), 0.9),))


def dividing(v: Variable) -> list[Group]:
    """A coefficient of what lies along a quantity: the stiffness of a rope or a beam, resistances in series."""
    return [
        Group((f"1/(1 + {{q}}*abs{v.scaled})",), (Shape("q", "1", q, 0.01, 100.0, (), 0.9 * q),)) for q in (0.5, 5.0)
    ]


def _together(a: Variable, b: Variable, ranges: dict[str, tuple[float, float]], once: bool) -> list[Group]:
    """Products: those that are alike both ways once. Friction whose level goes through zero has a smooth sign."""
    x, y = a.scaled, b.scaled
    if b.switch:  # any function of it is the same again
        return [Group((f"{x}*{y}",))] if once else []
    part = (f"{y}^2", f"abs{y}")  # a core that saturates; sites that are taken, as an enzyme's
    wide = Shape("q", "1", 1.0, 0.01, 100.0, (), 0.9)
    found = [g for p in part for g in (Group((f"{x}*{p}",)), Group((f"({x}/(1 + {{q}}*{p}) - {x})",), (wide,)))]
    rubs = ranges[a.local][0] < 0 < ranges[a.local][1] and a.kind != "rate"
    holds = ranges[b.local][0] > AWAY or ranges[b.local][1] < -AWAY
    found += [Group((f"{a.dry if holds else DRY.format(x=x)}*abs{y}",))] if rubs else []
    found += _exponential(f"{{q}}*{y}", f"{x}*")
    found += _exponential(f"{{q}}*{y}", f"{a.dry}*") if rubs and a.sticks else []
    return [Group((f"{x}*{y}",)), *found] if once else found
