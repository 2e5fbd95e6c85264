"""spatialDistribution() against closed forms: characteristics forward, backward and turned round, jumps, and a pipe
whose inflow follows its outflow."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.errors import Diagnostic
from tests.events.models import compiled, simulated

SOLVERS = ["ida", "dopri5", "rodas4", "rk4", "euler"]
STEPS = {"rk4": {"step": 1e-3}, "euler": {"step": 1e-4}}
ERROR = {"euler": 2e-3}  # of a method of first order with that step; the others are held to their tolerance
TURN = """model Turn
  Real x(start=2, fixed=true), v, a, b;
equation
  der(x) = v;
  v = 1 - 4*time;
  (a, b) = spatialDistribution(1 + time, 9, x, v >= 0, {0, 1}, {5, 6});
end Turn;
"""
LOOP = """model Loop
  Real x(start=0, fixed=true), T(start=1, fixed=true), b;
equation
  der(x) = 4;
  (, b) = spatialDistribution(T, 0, x, true, {0, 1}, {1, 1});
  der(T) = -b;
end Loop;
"""
STEP = """model Step
  parameter Real w = 2;
  Real x(start=0, fixed=true), b, c(start=0, fixed=true);
equation
  der(x) = w;
  (, b) = spatialDistribution(if time > 0.3 then 1 else 0, 0, x, true, {0, 0.5, 0.5, 1}, {0, 0, 2, 2});
  der(c) = b;
end Step;
"""


def run(tmp_path: Path, text: str, solver: str, **more: object) -> object:
    tolerance = {} if solver in STEPS else {"rtol": 1e-8}
    return simulated(tmp_path, text, solver=solver, interval=0.05, **tolerance, **STEPS.get(solver, {}), **more)


@pytest.mark.parametrize("solver", SOLVERS)
def test_what_has_gone_in_comes_out_again_when_the_velocity_turns(tmp_path: Path, solver: str) -> None:
    """x - 2 = t - 2 t^2: up to 0.5 s what went in at 0.5 - t comes out, then the initial distribution."""
    result = run(tmp_path, TURN, solver)
    time = result.time[~result.event]
    way = time - 2 * time**2
    out0 = np.where(time < 0.25, 1 + time, np.where(time < 0.5, 1.5 - time, 5 - way))
    inside = (np.abs(time - 0.5) > 1e-6) & (way > -0.875)
    assert result["a"][~result.event][inside] == pytest.approx(out0[inside], abs=ERROR.get(solver, 1e-6))
    forward = time < 0.25 - 1e-6
    assert result["b"][~result.event][forward] == pytest.approx(6 - way[forward], abs=ERROR.get(solver, 1e-6))


@pytest.mark.parametrize("solver", SOLVERS)
def test_an_inflow_that_follows_the_outflow(tmp_path: Path, solver: str) -> None:
    """T' = -T(t - 1/4), T = 1 before: the method of steps."""
    result = run(tmp_path, LOOP, solver)
    t = result.time[~result.event]
    d = [np.maximum(t - k / 4, 0) for k in range(4)]
    wanted = 1 - t + d[1] ** 2 / 2 - d[2] ** 3 / 6 + d[3] ** 4 / 24
    assert result["T"][~result.event] == pytest.approx(wanted, abs=ERROR.get(solver, 1e-6))


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4", "rk4"])
def test_jumps_arrive_as_events(tmp_path: Path, solver: str) -> None:
    """2 for a quarter of a second, then 0, from 0.8 s on 1: no step has smeared a jump."""
    result = run(tmp_path, STEP, solver)
    assert result["c"][-1] == pytest.approx(0.5 + 0.2, abs=1e-7)


def test_a_pipe_that_is_faster_than_the_steps_limits_them(tmp_path: Path) -> None:
    result = simulated(tmp_path, STEP.replace("w = 2", "w = 200").replace("if time > 0.3 then 1 else 0", "sin(5*time)"))
    assert result["b"][-1] == pytest.approx(np.sin(5 * (1 - 1 / 200)), rel=1e-5)


def test_initial_points_that_do_not_rise_are_refused(tmp_path: Path) -> None:
    with pytest.raises(Diagnostic) as refused:
        compiled(tmp_path, STEP.replace("{0, 0.5, 0.5, 1}", "{0, 0.6, 0.5, 1}"))
    assert (refused.value.code, refused.value.span.line) == ("R064", 6)


def test_initial_points_by_parameters_are_checked_at_the_start(tmp_path: Path) -> None:
    text = STEP.replace("{0, 0.5, 0.5, 1}", "{0, w, 0.5, 1}")
    result = simulated(tmp_path, text)
    assert not result.complete
    assert "initialPoints" in str(result.failure)


SLOPE = """model Slope
  Real x(start=0, fixed=true), b, y;
equation
  der(x) = 4 + 3*sin(5*time);
  (, b) = spatialDistribution(sin(3*x), 0, x, true, {0, 1}, {0, sin(-3)});
  y = der(b);
end Slope;
"""


def test_the_slope_of_what_comes_out_is_that_of_its_polynomial(tmp_path: Path) -> None:
    """b = sin(3 (x - 1)) to 1e-9; differences over a ten-thousandth of a segment erred by 1e-4 at its ends."""
    result = simulated(tmp_path, SLOPE, solver="rodas4", rtol=1e-10, stop=2.0, interval=0.003)
    arrived = result["x"] > 1 + 1e-6
    x, time = result["x"][arrived], result.time[arrived]
    assert result["b"][arrived] == pytest.approx(np.sin(3 * (x - 1)), abs=1e-8)
    slope = 3 * np.cos(3 * (x - 1)) * (4 + 3 * np.sin(5 * time))
    assert result["y"][arrived] == pytest.approx(slope, abs=1e-5)
