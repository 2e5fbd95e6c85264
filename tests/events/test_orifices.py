"""Two tanks joined by an orifice come to rest in finite time, where the root in the law of its flow ends."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events.models import compiled, simulated

LAWS = {
    "sign and abs": "q = sign(d)*sqrt(abs(d))",
    "branches": "q = if d > 0 then sqrt(d) else -sqrt(-d)",
    "turned round": "q = if 0 >= p[1] - p[2] then -(p[2] - p[1])^0.5 else sqrt(p[1] - p[2])",
    "power": "q = d*max(abs(d), 1e-9)^(-0.5)",
}
TANKS = """model Tanks
  parameter Real p0 = 2;
  Real p[2](start={{p0, 1}}, each fixed=true); Real d = p[1] - p[2]; Real q;
equation
  der(p) = {{-q, q}};
  {law};
end Tanks;"""


def tanks(folder: Path, law: str) -> runtime.Model:
    return compiled(folder, TANKS.format(law=LAWS[law]))


@pytest.mark.parametrize("solver", ("ida", "dopri5", "rodas4"))
@pytest.mark.parametrize("law", LAWS)
def test_the_fall_to_rest(tmp_path: Path, law: str, solver: str) -> None:
    """d' = -2 sqrt(d): d = (sqrt(d0) - t)^2, and at rest from t = 1 on."""
    result = runtime.simulate(tanks(tmp_path, law), solver=solver, stop=3.0, interval=0.1, rtol=1e-8)
    t = result["time"]
    if not result.complete:  # IDA's noise at rest may switch the branches to and fro: refused, and right until then
        assert solver == "ida" and "chattering" in result.failure.message and t[-1] > 0.9
    assert result["d"] == pytest.approx(np.maximum(1 - t, 0) ** 2, abs=2e-6)


@pytest.mark.parametrize("solver", ("ida", "dopri5", "rodas4"))
@pytest.mark.parametrize("law", LAWS)
def test_rest_from_the_start(tmp_path: Path, law: str, solver: str) -> None:
    """The slope of the root is infinite there: Newton's method goes on with one that is finite."""
    result = runtime.simulate(tanks(tmp_path, law), solver=solver, stop=3.0, parameters={"p0": 1.0})
    assert result.complete, result.failure
    assert result["p[1]"] == pytest.approx(np.ones_like(result["time"]), abs=1e-9)


def test_a_root_that_has_no_value_on_its_own_branch_is_refused(tmp_path: Path) -> None:
    law = "q = if d > 0 then sqrt(-d) else 0"
    result = runtime.simulate(compiled(tmp_path, TANKS.format(law=law)), solver="dopri5", stop=3.0)
    assert not result.complete
    assert "not a finite number" in result.failure.message


def test_a_sign_that_stands_by_itself_keeps_its_event(tmp_path: Path) -> None:
    """Dry friction beside an orifice of the same quantity."""
    text = """model Both
  Real v(start=1, fixed=true); Real drag; Real friction;
equation
  der(v) = -2 + 0*drag;
  drag = 3*sqrt(abs(v))*sign(v);
  friction = 0.1*sign(v);
end Both;"""
    result = runtime.simulate(compiled(tmp_path, text), solver="dopri5", stop=1.0)
    assert result.complete, result.failure
    assert [e.time for e in result.event_log if e.direction] == pytest.approx([0.5] * len(result.event_log), abs=1e-9)
    assert result.event_log
    assert result["friction"][-1] == -0.1


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize("unit", [1.0, 2.0**-30])
def test_pressure_by_flow_passes_through_zero(tmp_path: Path, solver: str, unit: float) -> None:
    """q abs(q) = cos(t): the volume returns to V(pi/2) = Gamma(3/4) sqrt(pi) / (2 Gamma(5/4)) times what each half turn
    gives and takes; at zero q has an infinite slope, where a step of h is wrong by h^1.5."""
    text = f"""model Orifice
  Real q(start = {unit!r}), dp, V(start = 0, fixed = true);
equation
  dp = {unit!r}^2*cos(time); q*abs(q) = dp; der(V) = q;
end Orifice;
"""
    r = simulated(tmp_path, text, solver=solver, stop=4.5 * np.pi, rtol=1e-7, interval=np.pi / 4, events=False)
    assert r.complete, r.failure
    quarter = math.gamma(0.75) * math.sqrt(math.pi) / (2 * math.gamma(1.25))
    exact = np.array([quarter, -quarter, quarter, -quarter, quarter])
    np.testing.assert_allclose(r["V"][2::4] / unit, exact, atol=2e-5)
    np.testing.assert_allclose(r["q"] * abs(r["q"]), r["dp"], atol=1e-9 * unit**2)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize("rtol", [1e-5, 1e-7, 1e-8])
def test_levels_that_come_to_equal_through_an_implicit_flow(tmp_path: Path, solver: str, rtol: float) -> None:
    """q' = -2 until the flow ends, and nothing moves from then on: what is left of the levels is rounding."""
    text = """model Levels
  Real h[2](start={2, 1}, each fixed=true), q;
equation
  der(h) = {-q, q}; h[1] - h[2] = 0.5*q*abs(q);
end Levels;"""
    r = simulated(tmp_path, text, solver=solver, stop=5, rtol=rtol, interval=0.25)
    assert r.complete, r.failure
    flow = np.maximum(math.sqrt(2) - 2 * r["time"], 0)
    np.testing.assert_allclose(r["h[1]"] - r["h[2]"], 0.5 * flow**2, atol=100 * rtol)
    assert r.counters["steps"] < 50_000


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-8])
def test_orifices_that_all_reverse_at_once(tmp_path: Path, solver: str, rtol: float) -> None:
    """Every flow is the same multiple of the root of what drives it, and so passes zero with it."""
    text = """model Network
  Real ps = cos(time), p[2], q[4], V(start=0, fixed=true);
equation
  ps - p[1] = q[1]*abs(q[1]); p[1] - p[2] = 2*q[2]*abs(q[2]); p[1] = 3*q[3]*abs(q[3]); p[2] = q[4]*abs(q[4]);
  q[1] = q[3] + q[2]; q[2] = q[4];
  der(V) = q[1];
end Network;"""
    r = simulated(tmp_path, text, solver=solver, stop=3 * np.pi, rtol=rtol, interval=np.pi, events=False)
    assert r.complete, r.failure
    branches = 2 / math.sqrt(3)  # of the same resistance each, 3: of the sum of the squares
    conductance = branches / math.sqrt(1 + branches**2)
    quarter = math.gamma(0.75) * math.sqrt(math.pi) / (2 * math.gamma(1.25))
    np.testing.assert_allclose(r["V"], 0 * r["V"], atol=200 * rtol * quarter)
    np.testing.assert_allclose(abs(r["q[1]"]), conductance, rtol=1e-6)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-8])
def test_a_cube_root_passes_through_zero(tmp_path: Path, solver: str, rtol: float) -> None:
    """The Jacobian vanishes there, and the unknown has an infinite slope, where a step of h is wrong by h^(4/3),
    of which its estimate sees a part; over a half turn nothing is left."""
    text = """model Cube
  Real x(start=1), z(start=0, fixed=true);
equation
  x^3 = cos(time); der(z) = x;
end Cube;"""
    r = simulated(tmp_path, text, solver=solver, stop=3 * np.pi, rtol=rtol, interval=np.pi / 2, events=False)
    assert r.complete, r.failure
    quarter = math.sqrt(math.pi) / 2 * math.gamma(2 / 3) / math.gamma(7 / 6)
    exact = quarter * np.array([0, 1, 0, -1, 0, 1, 0])
    np.testing.assert_allclose(r["z"], exact, atol=1000 * rtol)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-8, 1e-9])
def test_two_orifices_in_series_come_to_rest(tmp_path: Path, solver: str, rtol: float) -> None:
    """Half of the difference drives each: d' = -2 sqrt(d/2), so d = (1 - t/sqrt(2))^2, and rest from sqrt(2) on. There
    an explicit step is as long as the root of the tolerance; IDA's steps, which solve the law at their ends, grow."""
    text = """model Series
  Real p1(start=2, fixed=true), p2(start=1, fixed=true), pm(start=1.5), v(start=0.7), w;
equation
  v*abs(v) = p1 - pm; w*abs(w) = pm - p2; v = w; der(p1) = -v; der(p2) = w;
end Series;"""
    r = simulated(tmp_path, text, solver=solver, stop=5, rtol=rtol, interval=0.1)
    assert r.complete, r.failure
    exact = np.maximum(1 - r["time"] / math.sqrt(2), 0) ** 2
    np.testing.assert_allclose(r["p1"] - r["p2"], exact, atol=20 * rtol)
    if solver == "ida":
        assert r.counters["steps"] < 200
