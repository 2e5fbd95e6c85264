"""Small swings of guards beside large states, with closed-form switching times.

States of size S carry a swing of amplitude A = S 10^-9 ... S 10^-1, which may be far below the tolerance of the
states: the error test of a method then takes steps in which the guard crosses and comes back. What a guard does has to
be found all the same. Kinds:

    alone   a spring and a mass that swing about S: x'' = -w^2 (x - S)
    apart   x and y drift together, and x swings about y: the guard is their difference
    creep   x drifts slowly through its threshold while it swings, and crosses it several times
    solved  as apart, the difference being an unknown of two linear equations

Error budget. A method keeps the error of a step in a guard below SHARE of the guard's swing in it. The errors of steps
at all phases of a swing have both signs: after n steps they are sqrt(n) SHARE A, or n times the tolerance where that is
less. The guard moves with `slope` where it crosses. Thresholds stand off the extremes by `depth`; where that is within
twice the budget nothing is asked of the number of events.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
import math

import numpy as np
from scipy.optimize import brentq

from lacuna import runtime

TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
KINDS = ("alone", "apart", "creep", "solved")
PERIODS = 12
SHARE = 1e-2
_HEAD = """model Swing{number} "{kind}"
  Real x(start={x0!r}, fixed=true){more};
  Integer up(start=0, fixed=true), down(start=0, fixed=true);
equation
"""
_EVENTS = """  when {guard} > {h!r} then
    up = pre(up) + 1;
  end when;
  when {guard} < {h!r} then
    down = pre(down) + 1;
  end when;
end Swing{number};
"""


@dataclass(frozen=True)
class Swing:
    """`text` of a model; (time (s), whether upwards) of its events; `stop` (s); size of the states and amplitude of the
    swing; smallest distance of an extreme from the threshold, and smallest slope (1/s) at a crossing, both in
    amplitudes."""

    text: str
    events: list[tuple[float, bool]]
    stop: float
    size: float
    amplitude: float
    depth: float
    slope: float


def draw(rng: np.random.Generator, number: int) -> Swing:
    kind = KINDS[number % len(KINDS)]
    size, w = 10 ** rng.uniform(-6, 6), 2 * math.pi * 10 ** rng.uniform(-2, 2)
    a = size * 10 ** rng.uniform(-9, -1)
    stop, phase = 2 * math.pi / w * PERIODS, rng.uniform(0, 2 * math.pi)
    drift = size / stop * rng.uniform(-1, 1) if kind != "alone" else 0.0
    level = a * rng.uniform(-0.8, 0.8)
    creep = 0.0
    if kind == "creep":
        creep, level = a / stop * rng.uniform(-4, 4), 0.0
    offset = -0.5 * creep * stop

    def guard(t: float) -> float:
        return offset + creep * t + a * math.sin(w * t + phase) - level

    text = _text(kind, number, size, w, a, phase, drift, creep, offset, level)
    turns = [(s * math.acos(max(-1, min(1, -creep / (a * w)))) - phase + 2 * math.pi * k) / w
             for k in range(-1, PERIODS + 3) for s in (-1, 1)]  # fmt: skip
    knots = [0.0, *sorted(t for t in turns if 0 < t < stop), stop]
    events = []
    for left, right in pairwise(knots):
        if guard(left) * guard(right) < 0:
            events.append((brentq(guard, left, right, xtol=1e-300, rtol=1e-15), guard(right) > 0))
    depth = min(abs(guard(t)) for t in knots) / a
    slope = min((abs(creep + a * w * math.cos(w * t + phase)) for t, _ in events), default=a * w) / a
    return Swing(text, events, stop, size, a, depth, slope)


def _text(kind, number, size, w, a, phase, drift, creep, offset, level) -> str:
    here, speed = float(a * math.sin(phase)), float(a * w * math.cos(phase))
    if kind == "alone":
        head = _HEAD.format(number=number, kind=kind, x0=size + here, more=f", v(start={speed!r}, fixed=true)")
        law = f"  der(x) = v;\n  der(v) = {float(-w * w)!r}*(x - {size!r});\n"
        return head + law + _EVENTS.format(number=number, guard="x", h=float(size + level))
    forced = f"{float(a * w)!r}*cos({float(w)!r}*time + {float(phase)!r})"
    if kind == "creep":
        head = _HEAD.format(number=number, kind=kind, x0=float(size + offset + here), more="")
        return head + f"  der(x) = {float(creep)!r} + {forced};\n" + _EVENTS.format(number=number, guard="x", h=size)
    more = f", y(start={size!r}, fixed=true)" + (", f, g" if kind == "solved" else "")
    head = _HEAD.format(number=number, kind=kind, x0=float(size + here), more=more)
    law = f"  der(x) = {drift!r} + {forced};\n  der(y) = {drift!r};\n"
    guard, h = "x - y", level
    if kind == "solved":
        law += "  2*f + g = 3*x;\n  f + 3*g = 4*y;\n"
        guard, h = "f - g", 2.4 * level
    return head + law + _EVENTS.format(number=number, guard=guard, h=float(h))


def wrong(model: runtime.Model, swing: Swing, solver: str, rtol: float) -> str:
    """ "" where the run is right; "error: ..." where it ended with one."""
    result = runtime.simulate(model, solver=solver, rtol=rtol, stop=swing.stop, outputs=["up", "down"], interval=0)
    if not result.complete:
        return f"error: {result.failure}"
    rounding = 1e-15 * swing.size / swing.amplitude
    steps = result.counters["steps"]
    error = math.sqrt(steps) * min(SHARE, 2 * rtol * swing.size / swing.amplitude * math.sqrt(steps)) + steps * rounding
    if swing.depth < 2 * error:
        return ""
    found = sorted(
        [
            (float(result.time[k]), way == "up")
            for way in ("up", "down")
            for k in np.flatnonzero(np.diff(result[way])) + 1
        ]
    )
    if [up for _, up in found] != [up for _, up in swing.events]:
        return f"{len(found)} events of {len(swing.events)}"
    off = max((abs(p - q) for (p, _), (q, _) in zip(found, swing.events, strict=True)), default=0.0)
    budget = 2 * (error + SHARE) / swing.slope + 1e-9 * swing.stop  # the polynomial that it lies on errs, too
    return f"an event {off:.3g} s off, budget {budget:.3g} s" if off > budget else ""
