"""Nonlinear blocks where Newton's method alone gets nowhere, against closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events.models import compiled, simulated

SOLVERS = ["ida", "dopri5", "rodas4"]
LIMITED = """model Limited
  parameter Real G = 1e5, limit = 15, guess = 0;
  Real u(start=-20, fixed=true), y(start=guess);
equation
  der(u) = 40;
  y = noEvent(if G*(u - y) > limit then limit elseif G*(u - y) < -limit then -limit else G*(u - y));
end Limited;
"""


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("guess", [-15.0, 0.0, 3.0, 1e6])
def test_a_limited_gain_in_a_loop(tmp_path: Path, solver: str, guess: float) -> None:
    """y = G u/(1 + G) inside the limits: the linear range is 3e-4 of what Newton's steps jump over."""
    result = simulated(tmp_path, LIMITED, solver=solver, stop=1.0, interval=0.01, parameters={"guess": guess})
    assert result.complete, result.failure
    expected = np.clip(1e5 * result["u"] / (1 + 1e5), -15, 15)
    assert result["y"] == pytest.approx(expected, rel=1e-6, abs=1e-5)


SCHMITT = """model Schmitt
  parameter Real G = 1e4, limit = 10, k = 0.2;
  Real phase(start=0, fixed=true), u, y(start=limit), e;
equation
  der(phase) = 1;
  u = 5*sin(phase);
  e = k*y - u;
  y = noEvent(if G*e > limit then limit elseif G*e < -limit then -limit else G*e);
end Schmitt;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_branch_that_ends_jumps_to_the_other_one(tmp_path: Path, solver: str) -> None:
    """A comparator with feedback keeps its side until u passes k y - limit/G, and not before."""
    model = compiled(tmp_path, SCHMITT)
    result = runtime.simulate(model, solver=solver, stop=20.0, interval=0.01)
    assert result.complete, result.failure
    threshold = 0.2 * 10 - 10 / 1e4
    side, expected = 1.0, []
    for u in 5 * np.sin(result["phase"]):
        side = -1.0 if u > threshold else 1.0 if u < -threshold else side
        expected.append(10 * side)
    assert len(set(expected)) == 2
    assert result["y"] == pytest.approx(expected)


PAIR = """model Pair
  parameter Real G = 1e3;
  Real u(start=-3, fixed=true), y[2](start={0.9, -0.9});
equation
  der(u) = 6;
  for i in 1:2 loop
    0 = tanh(G*(u - 0.3*y[3 - i] - y[i]*(1 + 0.1*y[3 - i]^2))) - y[i];
  end for;
end Pair;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_two_unknowns_follow_the_path_to_the_solution(tmp_path: Path, solver: str) -> None:
    result = simulated(tmp_path, PAIR, solver=solver, stop=1.0, interval=0.01)
    assert result.complete, result.failure
    u, a, b = result["u"], result["y[1]"], result["y[2]"]
    for one, other in ((a, b), (b, a)):
        slack = np.tanh(1e3 * (u - 0.3 * other - one * (1 + 0.1 * other**2))) - one
        assert np.abs(slack).max() < 1e-3
    assert np.abs(a - b).max() < 1e-5


NONE = """model None_
  parameter Real c = 1;
  Real x(start=0, fixed=true), y(start=0.5);
equation
  der(x) = 1;
  {};
end None_;
"""


@pytest.mark.parametrize(
    "equation", ["y^2 + c = 0", "(if noEvent(y > 0) then 1 else -1)*(1 + y^2) = 0", "exp(y)*c = 0"]
)
def test_no_solution_is_an_error(tmp_path: Path, equation: str) -> None:
    """A residual of one sign, one that jumps over zero, one that only comes near it."""
    result = simulated(tmp_path, NONE.format(equation), stop=1.0)
    assert result.failure is not None
    assert result.failure.status == "initialisation" or "did not converge" in str(result.failure)


ORIFICES = """model Orifices
  parameter Real a = 1, b = 3;
  Real p(start=8, fixed=true), middle, q, r;
equation
  der(p) = -4*p;
  p - middle = a*q*noEvent(abs(q));
  middle = b*r*noEvent(abs(r));
  q = r + 0*middle^2;
end Orifices;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_singular_jacobian_at_the_start(tmp_path: Path, solver: str) -> None:
    """Two orifices in series, started at no flow, where dp = a q |q| has no slope: q = sqrt(p/(a + b))."""
    result = simulated(tmp_path, ORIFICES, solver=solver, stop=1.0, interval=0.01)
    assert result.complete, result.failure
    assert result["q"] == pytest.approx(np.sqrt(result["p"] / 4), rel=1e-6)


ROOTS = """model Roots
  Real p(start=8, fixed=true), middle(start=8, nominal=1), q, r;
equation
  der(p) = -4*p;
  q = noEvent(if p > middle then sqrt(p - middle) else -sqrt(middle - p));
  r = noEvent(if middle > 0 then sqrt(middle/3) else -sqrt(-middle/3));
  q = r;
end Roots;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_an_infinite_slope_at_the_start(tmp_path: Path, solver: str) -> None:
    """The same, the flows written as roots: middle = 3/4 p."""
    result = simulated(tmp_path, ROOTS, solver=solver, stop=1.0, interval=0.01)
    assert result.complete, result.failure
    assert result["middle"] == pytest.approx(0.75 * result["p"], rel=1e-6)


TWO_ROOTS = """model TwoRoots "A pulse that a long step meets unawares: its stages reach far, to another root"
  Real x(start = 1, fixed = true), y(start = 1);
equation
  (y - x)*(y + 10) = 0;
  der(x) = -100*exp(-((time - 1)/0.01)^2)*y;
end TwoRoots;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_rejected_step_leaves_no_root_behind(tmp_path: Path, solver: str) -> None:
    """x goes from 1 to exp(-100 * 0.01 * sqrt(pi)), wherever the stages of rejected steps have been."""
    result = simulated(tmp_path, TWO_ROOTS, solver=solver, rtol=1e-7, stop=2.0, max_step={"ida": 0.01}.get(solver, 0.1))
    assert result.complete, result.failure
    assert result["y"][-1] == pytest.approx(np.exp(-np.sqrt(np.pi)), rel=1e-4)
    assert result["y"] == pytest.approx(result["x"], rel=1e-9)


DIODES = """model Diodes "A bridge: a step takes it hundreds of thermal voltages away"
  parameter Real Is = 1e-12, Vt = 0.026, R = 100, RL = 1000, U = 12;
  Real u, a, b, p, d[4], i[4], is;
equation
  u = if time < 0.5 then 0 else U;
  u - a + b = R*is;
  d = {a - p, b - p, -a, -b};
  for k in 1:4 loop
    i[k] = Is*(exp(d[k]/Vt) - 1) + 1e-9*d[k];
  end for;
  is = i[1] - i[3];
  is + i[2] - i[4] = 0;
  i[1] + i[2] = p/RL;
end Diodes;
"""


@pytest.mark.parametrize("volts", [2.0, -12.0, 12.0, 50.0])
def test_a_bridge_of_exponential_diodes_follows_a_step(tmp_path: Path, volts: float) -> None:
    """Two of them conduct, in series with R and RL: |U| = (R + RL) i + 2 Vt log(i/Is), what the others leak aside."""
    result = simulated(tmp_path, DIODES, stop=1.0, parameters={"U": volts})
    assert result.complete, result.failure
    current = float(result["is"][-1]) * np.sign(volts)
    drop = 2 * 0.026 * np.log(current / 1e-12)
    assert (abs(volts) - drop) / 1100 == pytest.approx(current, rel=1e-5)


BRIDGE = """model Bridge "Four diodes that a square wave throws from one side to the other: e^1900 at the start values"
  parameter Real R=1, Is=1e-12, Vt=0.026, C=1e-3, load=100, leak=1e-8;
  Real u, a, v(start=0, fixed=true), is, d[4], i[4];
equation
  u = if sin(50*time) > 0 then 200 else -50;
  d = {a - v, a - u + R*is - v, -a, u - R*is - a};
  for k in 1:4 loop i[k] = Is*(exp(d[k]/Vt) - 1) + leak*d[k]; end for;
  is = i[1] - i[3]; is = i[4] - i[2];
  C*der(v) = i[1] + i[2] - v/load;
end Bridge;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_diodes_are_thrown_from_side_to_side(tmp_path: Path, solver: str) -> None:
    result = runtime.simulate(compiled(tmp_path, BRIDGE), solver=solver, stop=1.0, interval=0.01, rtol=1e-6)
    assert result.complete, result.failure
    for k in range(1, 5):
        current = 1e-12 * np.expm1(result[f"d[{k}]"] / 0.026) + 1e-8 * result[f"d[{k}]"]
        np.testing.assert_allclose(result[f"i[{k}]"], current, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(result["is"], result["i[1]"] - result["i[3]"], atol=1e-6)
    np.testing.assert_allclose(result["is"], result["i[4]"] - result["i[2]"], atol=1e-6)
    forward = 2 * 0.026 * np.log1p(np.maximum(result["is"], 0) / 1e-12)
    conducts = result["is"] > 0.01
    np.testing.assert_allclose((200 - result["is"] - forward - result["v"])[conducts], 0, atol=1e-4)
    assert conducts.any()
    assert 100 < result["v"][-1] < 198.4
