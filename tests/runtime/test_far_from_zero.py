"""Runs that begin far from time zero, where time is rounded to more than a small state moves, are as those at zero."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events.models import compiled

SOLVERS = ("ida", "dopri5", "rodas4")
BEGINS = (0.0, 1e3, 8.64e4, 1e7)

BRUSHES = """model Brushes "a speed known by a threshold alone, of which a current makes its size"
  input Real u;
  Real i(start=0, fixed=true), w(start=0, fixed=true);
  Boolean turns;
equation
  3.3e-3*der(i) = u - 3.6*i - 0.03*w;
  7.4e-6*der(w) = 0.03*i - 2e-5*w;
  turns = w > 1e-10;
end Brushes;
"""
TICKS = """model Ticks "a stiff state follows a cosine; a clock restarts the method"
  parameter Real t0 = 0;
  Real f(start=0, fixed=true);
  Integer n(start=0, fixed=true);
equation
  der(f) = -1e5*(f - cos(time - t0));
  when sample(0, 0.25) then
    n = pre(n) + 1;
  end when;
end Ticks;
"""


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("begin", BEGINS)
def test_a_ramp_from_rest(tmp_path: Path, solver: str, begin: float) -> None:
    """The first steps were refused far from zero: their error was that of time as it is rounded."""
    model = compiled(tmp_path, BRUSHES)
    runs = []
    for start in (0.0, begin):
        ramp = runtime.RecordedInput(start + np.array([0.0, 1.0]), np.array([0.0, 24.0]))
        run = runtime.simulate(
            model, solver=solver, start=start, stop=start + 1.0, rtol=1e-6, interval=0.1, inputs={"u": ramp},
            events=False,
        )  # fmt: skip
        assert run.complete, run.failure
        runs.append(run)
    np.testing.assert_allclose(runs[1]["w"], runs[0]["w"], rtol=1e-4, atol=1e-4)
    assert runs[1].counters["steps"] < 2 * runs[0].counters["steps"] + 50


@pytest.mark.parametrize("begin", BEGINS)
def test_a_stiff_state_restarted_by_a_clock(tmp_path: Path, begin: float) -> None:
    """Rosenbrock's derivative by time was a difference over what time is rounded to: 1.5 million steps at 1e7 s."""
    run = runtime.simulate(
        compiled(tmp_path, TICKS), solver="rodas4", start=begin, stop=begin + 3, parameters={"t0": begin}, interval=0.5,
        events=False,
    )  # fmt: skip
    assert run.complete, run.failure
    assert run.counters["steps"] < 500
    np.testing.assert_allclose(run["f"][1:], np.cos(run["time"][1:] - begin), atol=1e-4)


def test_a_size_that_a_threshold_tells_may_be_outgrown(tmp_path: Path) -> None:
    """Tolerances of a speed of 100 rad/s are not those of the 1e-10 that it is compared with: a run takes about as
    many steps as one that knows the size."""
    steps = []
    for text in (BRUSHES, BRUSHES.replace("w(start=0,", "w(nominal=100, start=0,").replace("i(st", "i(nominal=1, st")):
        (folder := tmp_path / str(len(steps))).mkdir()
        ramp = runtime.RecordedInput(np.array([0.0, 0.5, 0.501, 1.0]), np.array([0.0, 24.0, -24.0, 0.0]))
        run = runtime.simulate(compiled(folder, text), solver="dopri5", stop=1.0, rtol=1e-6, inputs={"u": ramp})
        assert run.complete, run.failure
        steps.append(run.counters["steps"])
    assert steps[0] < 1.5 * steps[1]
