"""One run of a random hybrid system against its closed form: right within its error budget, or an error."""

from __future__ import annotations

import math

import numpy as np

from lacuna import runtime
from tests.events.hybrid import System


def wrong(model: runtime.Model, system: System, solver: str, rtol: float) -> str:
    """ "" where the run is right; else what is wrong. A run that ends with an error is not wrong, and is returned as
    "error: ..."

    Budget of an event's time: each step adds sqrt(2) rtol of the size of x, and an error of x moves the event by
    `sensitivity`. A guard that passes its threshold by less than that error may be missed.
    """
    result = runtime.simulate(model, solver=solver, rtol=rtol, stop=system.stop, outputs=["mode", "second"], interval=0)
    if not result.complete:
        return f"error: {result.failure}"
    error = result.counters["steps"] * math.sqrt(2) * rtol
    if system.depth < 2 * error:
        return ""
    budget = error * system.sensitivity + 1e-9 * system.stop
    for name, expected in (("mode", system.switches), ("second", system.seconds)):
        found = result.time[np.flatnonzero(np.diff(result[name])) + 1]
        if len(found) != len(expected):
            return f"{name}: {len(found)} events of {len(expected)}"
        off = max((abs(a - b) for a, b in zip(found, expected, strict=True)), default=0.0)
        if off > budget:
            return f"{name}: an event {off:.3g} s off, budget {budget:.3g} s"
    return ""
