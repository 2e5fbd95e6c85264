"""A run follows one solution of its nonlinear equations, and ends where that ends: at a fold. No fold is a steep
change, a jump or a corner of the equations, nor what only rounds differently in the two forms of a model."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events.models import compiled

SOLVERS = {"ida": {}, "dopri5": {}, "rodas4": {}, "rk4": {"step": 0.01}, "euler": {"step": 0.01}}
FOLD = """model Fold "z follows the lower branch until x = 2, at time 5/p, and ends there, at -1"
  parameter Real p = 1;
  Real x(start=-3, fixed=true), y(start=0, fixed=true), z(start=-2.1);
equation
  der(x) = p;
  der(y) = z;
  z^3 - 3*z = x;
end Fold;
"""
TRIGGER = """model Trigger "A limited amplifier with feedback: its branch ends at a corner of the equations"
  parameter Real p = 1, limit = 10;
  Real phase(start=0, fixed=true), s(start=0, fixed=true), y(start=limit), e;
equation
  der(phase) = p;
  der(s) = y;
  e = 0.2*y - 5*sin(phase);
  y = noEvent(if 1e4*e > limit then limit elseif 1e4*e < -limit then -limit else 1e4*e);
end Trigger;
"""
STEEP = """model Steep "z goes from -2 to 2 within a fiftieth of a second, and bends as sharply"
  parameter Real p = 1;
  Real x(start=-3, fixed=true), y(start=0, fixed=true), z(start=-2.1);
equation
  der(x) = p;
  der(y) = z;
  z^3 + z = 10*tanh(100*x);
end Steep;
"""


ALGEBRAIC = """model Algebraic "No state: y ends where 3 y^2 = 1, at time 0.8 + 2/sqrt(27)"
  parameter Real size = 1;
  Real y(start=-1.3*size, nominal=size);
equation
  (y/size)^3 - y/size = time - 0.8;
end Algebraic;
"""
THROUGH_ANOTHER = """model ThroughAnother "The first of two blocks ends; the second, which follows it, is regular"
  Real x(start=0, fixed=true), a(start=-1.3), b(start=-1);
equation
  der(x) = b;
  b + 0.1*b^3 = a*(1 + 0.1*a^2);
  a^3 - a = time - 0.8;
end ThroughAnother;
"""
TO_AND_FRO = """model ToAndFro "By the end of a step that takes all periods at once y has come back to where it was"
  Real y(start=-0.1);
equation
  y^3 - y = 0.8*sin(6.283185307179586*time);
end ToAndFro;
"""
GOES_ON = """model GoesOn "Jacobians vanish where the solution goes on, equations jump, and s is only steep"
  Real x(start=-1, fixed=true), q(start=-1), c(start=-1), d, e(start=-1), j(start=-1), s(start=-2.1);
equation
  der(x) = 1;
  q*noEvent(abs(q)) = x;
  c^3 = x;
  (10*sin(30*time) - d)/100 = 1e-12*(exp(d/0.026) - 1);
  e + 0.1*e^3 = noEvent(if x > 0 then 1 else -1);
  j + 0.1*j^3 = if x > 0.5 then 1 else -1;
  s^3 + s = 10*tanh(1e5*(x - 0.3));
end GoesOn;
"""


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-9])
def test_a_run_ends_at_a_fold(tmp_path: Path, solver: str, rtol: float) -> None:
    end = 0.8 + 2 / np.sqrt(27)
    cases = [(FOLD, 5.0, "z", {}), (ALGEBRAIC, end, "y", {}), (ALGEBRAIC, end, "y", {"size": 1e-9})]
    cases += [(THROUGH_ANOTHER, end, "a", {}), (TO_AND_FRO, np.arcsin(2 / np.sqrt(27) / 0.8) / 2 / np.pi, "y", {})]
    for text, at, unknown, parameters in cases:
        model = compiled(tmp_path, text)
        result = runtime.simulate(
            model, solver=solver, rtol=rtol, stop=7.0, interval=0.02, parameters=parameters, **SOLVERS[solver]
        )
        assert result.failure is not None
        assert result.failure.status == "singular"
        assert result.failure.time == pytest.approx(at, rel=0.1 * rtol + 1e-8)
        assert f"the Jacobian of the block of {unknown} is singular" in str(result.failure)
        assert result.time[-1] == pytest.approx(at, abs=0.02), "rows up to there are kept"


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-9])
def test_what_goes_on_does_not(tmp_path: Path, solver: str, rtol: float) -> None:
    model = compiled(tmp_path, GOES_ON)
    result = runtime.simulate(model, solver=solver, rtol=rtol, stop=2.0, interval=0.013, **SOLVERS[solver])
    assert result.complete, result.failure
    x = result["x"]
    assert result["q"] == pytest.approx(np.sign(x) * np.sqrt(np.abs(x)), abs=1e-4)
    assert result["c"] == pytest.approx(np.cbrt(x), abs=1e-4)
    assert result["s"] ** 3 + result["s"] == pytest.approx(10 * np.tanh(1e5 * (x - 0.3)), abs=1e-6)


@pytest.mark.parametrize("solver", ["dopri5", "ida"])
def test_sensitivities_hold_up_to_a_fold(tmp_path: Path, solver: str) -> None:
    model = compiled(tmp_path, FOLD, sensitivities=True)
    result = runtime.simulate(model, solver=solver, stop=7.0, interval=0.5, outputs=["y"], sensitivities=["p"])
    assert result.failure is not None
    assert result.failure.time == pytest.approx(5, abs=1e-5)
    assert result.flags == []
    assert np.isfinite(result.sensitivity("y", "p")).all()


@pytest.mark.parametrize("solver", ["dopri5", "ida"])
def test_a_jump_at_a_corner_ends_sensitivities_only(tmp_path: Path, solver: str) -> None:
    """y switches where 5 sin(phase) = 2 - 1e-3; the instant moves with p, and no guard tells how."""
    model = compiled(tmp_path, TRIGGER, sensitivities=True)
    result = runtime.simulate(model, solver=solver, stop=2.0, interval=0.1, outputs=["s"], sensitivities=["p"])
    assert result.complete, result.failure
    at = np.arcsin((2 - 1e-3) / 5)
    assert [(f.kind, f.time) for f in result.flags] == [("fold", pytest.approx(at, abs=1e-2))]
    assert np.isnan(result.sensitivity("s", "p")[result.time > at + 0.1]).all()
    assert result["s"][-1] == pytest.approx(10 * at - 10 * (2 - at), rel=1e-3)


@pytest.mark.parametrize("solver", ["dopri5", "ida"])
def test_what_is_only_steep_does_not(tmp_path: Path, solver: str) -> None:
    model = compiled(tmp_path, STEEP, sensitivities=True)
    for rtol in (1e-4, 1e-6, 1e-8):
        result = runtime.simulate(
            model, solver=solver, rtol=rtol, stop=7.0, interval=0.5, outputs=["y", "z"], sensitivities=["p"]
        )
        assert result.complete, result.failure
        assert result.flags == []
        assert result["z"][-1] == pytest.approx(2, rel=1e-3)
        # y(7) = -z (3/p) + z (7 - 3/p) but for what is symmetric: dy/dp = 6 z/p^2
        assert result.sensitivity("y", "p")[-1] == pytest.approx(12, rel=1e-2)


ROUGH = """model Rough "Two linear equations that nearly agree: what they give is rounded 1/(p - 1) times more than x"
  parameter Real p = 1;
  Real x(start=1, fixed=true), s(start=0, fixed=true), z1, z2;
equation
  der(s) = 1;
  der(x) = z1;
  p*z1 + cos(s)*z2 = (cos(s) - p)*x;
  z1 + cos(s)*z2 = (cos(s) - 1)*x;
end Rough;
"""


@pytest.mark.parametrize(("p", "rtols"), [(1.0001, (1e-8, 1e-9, 1e-10, 1e-11)), (1.000001, (1e-8, 1e-9))])
def test_rounding_of_linear_equations_restarts_nothing(tmp_path: Path, p: float, rtols: tuple[float, ...]) -> None:
    """z1 = -x, so that x = exp(-time). Restarts at every other step cost the order of the method, and the error more
    than the tolerance."""
    model = compiled(tmp_path, ROUGH)
    for rtol in rtols:
        result = runtime.simulate(model, solver="ida", parameters={"p": p}, rtol=rtol, stop=3.0, interval=0.1)
        assert result.complete, result.failure
        assert result.counters["restarts"] == 0
        assert np.abs(result["x"] - np.exp(-result.time)).max() < 10 * rtol


NEAR = """model Near "The branch of -x comes as near as 2 sqrt(e), and is no solution: it is never reached"
  parameter Real e = 1e-6;
  Real x(start=1), y(start=0, fixed=true);
equation
  x^2 = (time - 1)^2 + e;
  der(y) = x;
end Near;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize("e", [1e-4, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-8])
def test_no_step_strays_to_a_branch_that_comes_near(tmp_path: Path, rtol: float, e: float, solver: str) -> None:
    """The integral of sqrt(s^2 + e) from -1 to 1. Steps err by about their tolerance each, some 30 near the bend."""
    result = runtime.simulate(compiled(tmp_path, NEAR), solver=solver, stop=2.0, rtol=rtol, parameters={"e": e})
    assert result.complete, result.failure
    exact = np.sqrt(1 + e) + e * np.arcsinh(1 / np.sqrt(e))
    assert result["y"][-1] == pytest.approx(exact, abs=30 * rtol)
    assert np.all(result["x"] > 0)


CROSSED = """model Crossed "A weak acid: x > 0 follows s while that is above zero, and rests at -e/s below"
  parameter Real e = 1e-6, w = 5;
  Real s, x(start=2), y(start=0, fixed=true);
equation
  s = cos(w*time);
  x*(x - s) = e;
  der(y) = x;
end Crossed;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize("e", [1e-3, 1e-6])
@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_roots_that_change_places_are_told_apart(tmp_path: Path, rtol: float, e: float, solver: str) -> None:
    """From a root near zero Newton's method comes to the other one in steps that shrink: the two face opposite ways.
    Steps err by about their tolerance, some hundred in all."""
    result = runtime.simulate(compiled(tmp_path, CROSSED), solver=solver, stop=3.0, rtol=rtol, parameters={"e": e})
    assert result.complete, result.failure
    s = np.cos(5 * np.linspace(0, 3, 600_001))
    exact = np.trapezoid(0.5 * (s + np.sqrt(s**2 + 4 * e)), dx=5e-6)
    assert result["y"][-1] == pytest.approx(exact, abs=100 * rtol)
    assert np.all(result["x"] > 0)


ORIFICE = """model TwoWays "The law of a flow, turned round at an event: behind its crossing each branch ends"
  parameter Real p = 1;
  Real q(start=1), dp, V(start=0, fixed=true);
equation
  dp = p*cos(time);
  dp = if q > 0 then q^2 else -q^2;
  der(V) = q;
end TwoWays;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_a_branch_that_ends_behind_an_event_is_no_end(tmp_path: Path, solver: str) -> None:
    result = runtime.simulate(compiled(tmp_path, ORIFICE), solver=solver, stop=1.5, rtol=1e-6)
    assert result.complete, result.failure
    t = np.linspace(0, 1.5, 300_001)
    assert result["V"][-1] == pytest.approx(np.trapezoid(np.sqrt(np.cos(t)), t), abs=1e-5)


EMPTIED = """model Emptied "h = (1 - time/2)^2 until time 2, where the branch of v = sqrt(h) ends"
  Real h(start=1, fixed=true), v(start=1);
equation
  v^2 = {h};
  der(h) = -v;
end Emptied;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize("h", ["h", "max(h, 0)", "noEvent(max(h, 0))"])
@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-8])
def test_a_tank_does_not_fill_itself_from_the_other_root(tmp_path: Path, rtol: float, h: str, solver: str) -> None:
    """Both roots of v^2 = h meet where h touches zero. Behind that h may rest at what a step errs by, until the branch
    is known to have ended; it does not rise by the other root."""
    model = compiled(tmp_path, EMPTIED.format(h=h))
    result = runtime.simulate(model, solver=solver, stop=4.0, rtol=rtol, interval=0.0)
    assert result.complete or (result.failure.line == 4 and result.failure.time > 2 - 0.01)
    level = np.maximum(1 - result.time / 2, 0) ** 2
    assert result["h"] == pytest.approx(level, abs=10 * rtol)


PASSES = """model Passes "A product whose factor changes its sign: its root turns by itself, and no other is near"
  Real m, h(start=1), y(start=0, fixed=true), g(start=1);
equation
  m = cos(time);
  m*(h - sin(g)) = 0;
  g = 1 + 0.1*h^2;
  der(y) = h;
end Passes;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_a_root_that_turns_by_itself_goes_on(tmp_path: Path, solver: str) -> None:
    result = runtime.simulate(compiled(tmp_path, PASSES), solver=solver, stop=4.0, rtol=1e-6)
    assert result.complete, result.failure
    assert np.ptp(result["h"]) < 1e-9
    assert result["y"][-1] == pytest.approx(4 * result["h"][0], rel=1e-6)
