"""Dry friction as a machine of modes, against its closed form, at tolerances down to rounding: what sticks, stands.

A force P sin(2 pi t) pulls at a mass, as the difference of two large ones, so that its acceleration is rounded. Its
speed is compared with a limit that is switched off."""

from __future__ import annotations

from math import asin, cos, pi
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from lacuna import runtime
from tests.events.models import compiled

STICK = """model Stick "The machine of modes that libraries give a bearing with dry friction"
  parameter Real m = 2.5e-5, P = 0.02, Fc = 0.015, Fs = 0.018, off = 1e10;
  Real v(start=0, fixed=true), load(start=1e3, fixed=true), a, sa, f;
  Boolean forward(start=false, fixed=true), backward(start=false, fixed=true), locked(start=true);
  Integer mode(start=0, fixed=true);
equation
  der(load) = 0;
  der(v) = a;
  m*a = (load + P*sin(2*3.141592653589793*time)) - load - f;
  forward = pre(mode) == 0 and (sa > Fs or pre(forward) and sa > Fc) or pre(mode) == -1 and v > off;
  backward = pre(mode) == 0 and (sa < -Fs or pre(backward) and sa < -Fc) or pre(mode) == 1 and v < -off;
  locked = not (pre(mode) == 1 or forward or pre(mode) == -1 or backward);
  a = if locked then 0 elseif forward then sa - Fs elseif backward then sa + Fs
    elseif pre(mode) == 1 then sa - Fs else sa + Fs;
  f = if locked then sa elseif forward then Fc elseif backward then -Fc elseif pre(mode) == 1 then Fc else -Fc;
  mode = if (pre(mode) == 1 or forward) and v > 0 then 1 elseif (pre(mode) == -1 or backward) and v < 0 then -1 else 0;
end Stick;
"""
STOP = 3.0


def changes() -> np.ndarray:
    """When it breaks away and comes to rest again, in turns: each half wave has both."""
    P, Fc, Fs = 0.02, 0.015, 0.018
    away = asin(Fs / P) / (2 * pi)

    def momentum(t: float) -> float:
        return P / (2 * pi) * (cos(2 * pi * away) - cos(2 * pi * t)) - Fc * (t - away)

    rest = brentq(momentum, 0.3, 0.6, xtol=1e-15)
    first = [away, rest]
    return np.array([t + 0.5 * k for k in range(int(2 * STOP)) for t in first if t + 0.5 * k < STOP])


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_what_sticks_stands_still(tmp_path: Path, solver: str) -> None:
    """All that the events may be off is the hysteresis of a guard, 1e-10 of its size."""
    model = compiled(tmp_path, STICK)
    expected = changes()
    for rtol in (1e-5, 1e-6, 1e-8) if solver == "rodas4" else (1e-5, 1e-6, 1e-8, 1e-10, 1e-11):
        result = runtime.simulate(model, solver=solver, rtol=rtol, stop=STOP, interval=0.001)
        assert result.complete, result.failure
        locked = result["locked"] == 1
        found = result.time[np.flatnonzero(np.diff(locked)) + 1]
        assert len(found) == len(expected)
        assert np.abs(found - expected).max() < 10 * rtol + 1e-9
        assert np.abs(result["v"][locked]).max() < 1e-9 * np.abs(result["v"]).max()
        assert result.counters["restarts"] <= 50
