"""A mass on a moving belt that sticks and slips, against its closed form.

While it sticks, x grows by vBelt; it breaks away where k x + d v = Fs. While it slips, m x'' + d x' + k x = Fc is a
damped oscillation, until v is back at vBelt. At both instants a guard rests on its threshold: v on vBelt all the while
the mass sticks, and again where it breaks away.

Error budget of an event's time. Each step adds to x and to v at most the tolerance, sqrt(2) rtol of its own size in the
weighted root mean square of two states; the errors of all steps add up, and an error of x moves the next break-away by
1/vBelt of it: steps * sqrt(2) rtol max|x| / vBelt. (While it slips, the same with its amplitude and frequency, which is
less.) The absolute tolerance adds its hundredth of rtol for each unit, the states being drawn no smaller than that.
"""

from __future__ import annotations

from dataclasses import dataclass
import math
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from lacuna import runtime

MODEL = Path(__file__).with_name("Belt.mo")
SOLVERS = ("ida", "dopri5", "rodas4")
CYCLES = 8


@dataclass(frozen=True)
class Belt:
    """Mass m (kg), spring k (N/m), damper d (N s/m), belt at vBelt (m/s), friction Fs at rest and Fc slipping (N)."""

    m: float
    k: float
    d: float
    vBelt: float
    Fs: float
    Fc: float

    @property
    def break_away(self) -> float:
        """Position (m) at which the mass breaks away."""
        return (self.Fs - self.d * self.vBelt) / self.k

    def slip(self) -> tuple[float, float]:
        """(duration of a slip (s), position at its end (m)), from the break-away on."""
        a = self.d / (2 * self.m)
        w = math.sqrt(self.k / self.m - a * a)
        x0 = self.break_away - self.Fc / self.k  # about the rest position under Fc
        b = (self.vBelt + a * x0) / w  # x - Fc/k = exp(-a t) (x0 cos wt + b sin wt)
        c, s = b * w - a * x0, -(x0 * w + a * b)  # v = exp(-a t) (c cos wt + s sin wt)
        extreme = math.atan2(s * w - a * c, c * w + a * s)  # of v, where (sw - ac) cos wt = (cw + as) sin wt
        slowest, fastest = sorted(t for n in range(4) if (t := (extreme + n * math.pi) / w) > 0)[:2]

        def excess(t: float) -> float:
            return math.exp(-a * t) * (c * math.cos(w * t) + s * math.sin(w * t)) - self.vBelt

        end = brentq(excess, slowest, fastest, xtol=1e-300, rtol=4 * np.finfo(float).eps)
        x = math.exp(-a * end) * (x0 * math.cos(w * end) + b * math.sin(w * end))
        return end, x + self.Fc / self.k

    def events(self, cycles: int = CYCLES) -> tuple[list[tuple[float, bool]], float]:
        """((time (s), stuck from then on) of the events of so many cycles, a time halfway to the next event)."""
        duration, back = self.slip()
        rest = (self.break_away - back) / self.vBelt
        starts = [self.break_away / self.vBelt + n * (duration + rest) for n in range(cycles)]
        return [e for t in starts for e in ((t, False), (t + duration, True))], starts[-1] + duration + 0.5 * rest

    def reach(self) -> float:
        """Time (s) in which the belt covers the largest |x|."""
        w = math.sqrt(self.k / self.m)
        return (abs(self.Fc / self.k) + math.hypot(self.break_away - self.Fc / self.k, self.vBelt / w)) / self.vBelt


def draw(rng: np.random.Generator) -> Belt:
    """A belt on which the mass is back at the belt's speed within one oscillation: its amplitude after the break-away,
    sqrt(1 + jump^2) vBelt, is larger than vBelt even after a period of damping."""
    m, w = 10 ** rng.uniform(-1, 1), 2 * math.pi * 10 ** rng.uniform(-0.3, 0.7)
    k, d = m * w * w, 2 * rng.uniform(0.001, 0.01) * m * w
    belt, jump = 10 ** rng.uniform(-2, 0), 10 ** rng.uniform(-0.3, 0.7)
    slipping = k * belt / w * 10 ** rng.uniform(-0.5, 1)
    return Belt(m, k, d, belt, Fs=slipping + jump * k * belt / w + d * belt, Fc=slipping)


@dataclass(frozen=True)
class Verdict:
    """What a run made of a belt: why its sequence of events is wrong ("" where it is right), the largest error of an
    event's time (s), and that error over its budget."""

    wrong: str
    error: float
    share: float


def judge(model: runtime.Model, belt: Belt, solver: str, rtol: float) -> Verdict:
    expected, stop = belt.events()
    result = runtime.simulate(
        model, parameters=vars(belt), solver=solver, rtol=rtol, stop=stop, outputs=["stuck"], interval=0
    )
    if not result.complete:
        return Verdict(str(result.failure), math.inf, math.inf)
    stuck = result["stuck"]
    found = [(result.time[k], bool(stuck[k])) for k in np.flatnonzero(np.diff(stuck)) + 1]
    if [state for _, state in found] != [state for _, state in expected]:
        return Verdict(f"{len(found)} events of {len(expected)}", math.inf, math.inf)
    error = max(abs(a - b) for (a, _), (b, _) in zip(found, expected, strict=True))
    budget = result.counters["steps"] * math.sqrt(2) * rtol * belt.reach()
    return Verdict(
        "" if error <= budget else f"an event {error:.2g} s off, budget {budget:.2g} s", error, error / budget
    )
