"""Random hybrid systems with closed-form switching times.

The state x follows, mode by mode, laws whose solution is known: a ramp x' = a, a relaxation x' = -(x - c)/T towards c,
a parabola (x' = v, v' = g). At a switch the mode moves on to the next, x and v may jump (reinit), and thresholds may
move with the mode. Kinds, each an event that has been lost by somebody:

    sweep     x runs from threshold to threshold; each next one is crossed from where the last event left x
    rest      x rests exactly on its threshold after the jump, then leaves to either side
    touch     a parabola that passes its threshold by a small depth and comes back within a moment
    together  two guards cross at the same instant, or a known moment apart
"""

from __future__ import annotations

from dataclasses import dataclass
import math

import numpy as np

KINDS = ("sweep", "rest", "touch", "together")
STAGES = 6
_HEAD = """model Hybrid{number} "{kind}"
  Real x(start={x0!r}, fixed=true), v(start={v0!r}, fixed=true);
  Integer mode(start=1, fixed=true);
  Integer second(start=0, fixed=true);
equation
  der(x) = {xdot};
  der(v) = {vdot};
"""


@dataclass(frozen=True)
class System:
    """`text` of a model; `switches` (s) of its mode, `seconds` (s) of its second guard; `stop` (s); `depth` is the
    smallest margin by which a guard passes its threshold, of the size of x: below the tolerance nothing is asked."""

    text: str
    switches: list[float]
    seconds: list[float]
    stop: float
    depth: float
    sensitivity: float  # largest |d switch time / d x| times the size of x (s)


def draw(rng: np.random.Generator, number: int) -> System:
    return {"touch": _touch, "together": _together}.get(KINDS[number % 4], _stages)(rng, number)


def _by_mode(values: list[str]) -> str:
    text = values[-1]
    for k in range(len(values) - 1, 0, -1):
        text = f"if mode == {k} then {values[k - 1]} else {text}"
    return text


def _stages(rng: np.random.Generator, number: int) -> System:
    """Ramps and relaxations in turn between thresholds; for "rest" each stage starts on the threshold that it left."""
    rest, size = KINDS[number % 4] == "rest", 10 ** rng.uniform(-6, 6)
    scale = 10 ** rng.uniform(-2, 2)
    x = x0 = size * rng.uniform(-1, 1)
    laws, thresholds, ups, jumps, times, t, slope = [], [], [], [], [], 0.0, math.inf
    for _ in range(STAGES):
        up = bool(rng.integers(2))
        goal = x + (1 if up else -1) * size * rng.uniform(0.05, 1)
        if rng.integers(2):
            rate = (goal - x) / (scale * rng.uniform(0.1, 1))
            laws.append(repr(float(rate)))
            t += (goal - x) / rate
        else:
            beyond, tau = goal + (goal - x) * rng.uniform(0.1, 2), scale * rng.uniform(0.1, 1)
            laws.append(f"({beyond!r} - x)/{tau!r}")
            rate = (beyond - goal) / tau
            t += tau * math.log((beyond - x) / (beyond - goal))
        times.append(t)
        slope = min(slope, abs(rate))
        thresholds.append(goal)
        ups.append(up)
        x = goal if rest else goal + size * rng.uniform(-0.5, 0.5)
        jumps.append(x)
    conditions = [f"{'x >' if u else 'x <'} {g!r}" for u, g in zip(ups, thresholds, strict=True)]
    text = _HEAD.format(number=number, kind=KINDS[number % 4], x0=x0, v0=0.0, xdot=_by_mode([*laws, "0"]), vdot="0")
    for k, condition in enumerate(conditions, 1):
        text += f"  {'when' if k == 1 else 'elsewhen'} pre(mode) == {k} and {condition} then\n    mode = {k + 1};\n"
    text += "  end when;\n  second = 0;\n"
    for k, (condition, jump) in enumerate(zip(conditions, () if rest else jumps, strict=False), 1):
        text += (
            f"  {'when' if k == 1 else 'elsewhen'} pre(mode) == {k} and {condition} then\n    reinit(x, {jump!r});\n"
        )
    text += "" if rest else "  end when;\n"
    return System(text + f"end Hybrid{number};\n", times, [], 1.2 * t, 0.05, size / slope)


def _touch(rng: np.random.Generator, number: int) -> System:
    """x = x0 + v0 t - g t^2/2 passes h at its top by `depth`."""
    size, scale, depth = 10 ** rng.uniform(-6, 6), 10 ** rng.uniform(-2, 2), 10 ** rng.uniform(-3, -0.5)
    g = 2 * size / scale**2
    v0, top = g * scale, size  # at time `scale`
    h = top * (1 - depth)
    half = math.sqrt(2 * (top - h) / g)
    text = _HEAD.format(number=number, kind="touch", x0=0.0, v0=v0, xdot="v", vdot=repr(-g))
    text += f"  when x > {h!r} then\n    mode = pre(mode) + 1;\n  end when;\n"
    text += f"  when x < {h!r} then\n    second = pre(second) + 1;\n  end when;\nend Hybrid{number};\n"
    return System(text, [scale - half], [scale + half], scale + 1.5 * half, depth, size / (g * half))


def _together(rng: np.random.Generator, number: int) -> System:
    """Two ramps reach their thresholds at one instant, or `apart` from each other."""
    size, other, scale = 10 ** rng.uniform(-6, 6), 10 ** rng.uniform(-6, 6), 10 ** rng.uniform(-2, 2)
    apart = 0.0 if rng.integers(2) else scale * 10 ** rng.uniform(-5, -1)
    text = _HEAD.format(number=number, kind="together", x0=0.0, v0=0.0, xdot=repr(size), vdot=repr(other))
    text += f"  when x > {size * scale!r} then\n    mode = pre(mode) + 1;\n  end when;\n"
    text += f"  when v > {other * (scale + apart)!r} then\n    second = pre(second) + 1;\n  end when;\n"
    text += f"end Hybrid{number};\n"
    return System(text, [scale], [scale + apart], 1.5 * (scale + apart), 1.0, 2 * scale)
