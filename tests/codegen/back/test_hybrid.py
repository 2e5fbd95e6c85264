"""Relations, jumps, discrete equations and initial conditions, run: what is known in closed form must come out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model, translate
from tests.codegen.generated import write_model

SOLVERS = ("ida", "dopri5")


@pytest.fixture
def simulate(tmp_path: Path):
    def run(text: str, stop: float, solver: str, **options: object) -> runtime.Result:
        compiled = compile_model(write_model(tmp_path, text), cache_directory=str(tmp_path))
        options = {"interval": stop / 200, "rtol": 1e-9, "atol": 1e-11} | options
        result = runtime.simulate(runtime.Model(compiled.path), solver=solver, stop=stop, **options)
        assert result.complete, result.failure
        return result

    return run


TURNING = """model Turning "forth and back over many turns"
  constant Real pi = 3.141592653589793;
  parameter Real rate(unit = "1/s") = 3; parameter Real w0(unit = "1/s") = 50;
  Real phi(start = 0.1, fixed = true); Real e; Integer n; Real whole; Real up; Real left;
equation
  der(phi) = w0*cos(rate*time);
  e = mod(phi, 2*pi);
  n = integer(phi/(pi/3));
  whole = floor(phi/2);
  up = ceil(phi/2);
  left = rem(phi, pi);
end Turning;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_jumps_follow_the_angle_both_ways(simulate, solver: str) -> None:
    r = simulate(TURNING, 4.0, solver)
    phi = 0.1 + 50 / 3 * np.sin(3 * r.time)
    np.testing.assert_allclose(r["phi"], phi, atol=1e-6)
    away = np.all([np.abs(np.mod(phi / p + 0.5, 1) - 0.5) > 1e-5 for p in (np.pi / 3, 2, np.pi)], axis=0)
    phi = r["phi"]
    np.testing.assert_allclose(r["e"][away], np.mod(phi, 2 * np.pi)[away], atol=1e-9)
    np.testing.assert_array_equal(r["n"][away], np.floor(phi / (np.pi / 3))[away])
    np.testing.assert_array_equal(r["whole"][away], np.floor(phi / 2)[away])
    np.testing.assert_array_equal(r["up"][away], np.ceil(phi / 2)[away])
    np.testing.assert_allclose(r["left"][away], np.fmod(phi, np.pi)[away], atol=1e-9)


CORNERS = """model Corners
  parameter Real rate(unit = "1/s") = 5;
  Real s; Real a(start = 0, fixed = true); Real b(start = 0, fixed = true); Real c(start = 0, fixed = true);
equation
  s = sin(rate*time);
  der(a) = rate*abs(s);
  der(b) = rate*max(s, 0.5) + rate*min(s, -0.5);
  der(c) = rate*sign(s);
end Corners;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_corners_are_events(simulate, solver: str) -> None:
    """The integrals over one period of sin: abs 4, clipping odd so 0, sign 0; no step may run over a corner."""
    r = simulate(CORNERS, 2 * np.pi / 5, solver)
    assert r["a"][-1] == pytest.approx(4, abs=1e-7)
    assert r["b"][-1] == pytest.approx(0, abs=1e-7)
    assert r["c"][-1] == pytest.approx(0, abs=1e-7)
    assert r.counters["state_events"] >= 5


def test_no_events_where_none_are_wanted(tmp_path: Path) -> None:
    text = CORNERS.replace("abs(s)", "noEvent(abs(s))").replace("max(s, 0.5)", "smooth(0, if s > 0.5 then s else 0.5)")
    p = translate(write_model(tmp_path, text))[0]
    assert [str(r.left) for r in p.relations] == ["s", "0.0", "s"]  # of min and of sign


def test_opposite_relations_share_a_root(tmp_path: Path) -> None:
    text = "model Share Real x(start=0, fixed=true); Boolean a; Boolean b; Boolean c; Boolean d;\n" \
           "equation der(x) = 1; a = x > 2; b = 2 < x; c = x <= 2; d = not x > 2; end Share;"  # fmt: skip
    assert len(translate(write_model(tmp_path, text))[0].relations) == 1


CLOCKED = """model Clocked
  parameter Real T(unit = "s") = 0.3;
  Real u; Real x(start = 0, fixed = true); Real saw; Boolean late; discrete Real held(start = 0, fixed = true);
  Real speed(unit = "1/s") = 1;
equation
  u = if time < T then 0 elseif time < 2*T then 1 else -1;
  der(x) = u*speed;
  saw = mod(time, T);
  late = time >= 2.5*T;
  when sample(T/3, T/3) then
    held = time/T;
  end when;
end Clocked;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_time_events_are_met_exactly(simulate, solver: str) -> None:
    r = simulate(CLOCKED, 1.0, solver)
    assert r["x"][-1] == pytest.approx(0.3 - 0.4, abs=1e-12)
    times = [e.time for e in r.event_log if e.kind == "time"]
    assert set(np.round(times, 12)) == {0.3, 0.6, 0.75, 0.9}
    assert r.counters["state_events"] == 0
    assert r["saw"][-1] == pytest.approx(0.1, abs=1e-12)
    assert r["held"][-1] == pytest.approx(1.0 / 0.3, abs=1e-12)
    assert r["late"][-1] == 1


FRICTION = """model Friction "a mass on a surface, pulled by a slow sine: sticks, breaks away, slides, sticks"
  parameter Real m = 1; parameter Real f0 = 1; parameter Real fmax = 1.2; parameter Real A = 1.5;
  parameter Real rate(unit = "1/s") = 1; constant Real unit_a(unit = "1/s2") = 1;
  constant Real small(unit = "1/s") = 1e-10;
  constant Integer Free = 2, Forward = 1, Stuck = 0, Backward = -1, Unknown = 3;
  Real s(start = 0, fixed = true); Real v(start = 0, fixed = true); Real a; Real sa; Real f;
  Boolean startForward(start = false, fixed = true); Boolean startBackward(start = false, fixed = true);
  Boolean locked; Integer mode(start = Unknown, fixed = true);
equation
  v = der(s); a = der(v);
  m*a/unit_a = A*sin(rate*time) - f;
  startForward = pre(mode) == Stuck and (sa > fmax or pre(startForward) and sa > f0)
    or pre(mode) == Backward and v > small or initial() and v > 0;
  startBackward = pre(mode) == Stuck and (sa < -fmax or pre(startBackward) and sa < -f0)
    or pre(mode) == Forward and v < -small or initial() and v < 0;
  locked = not (pre(mode) == Forward or startForward or pre(mode) == Backward or startBackward);
  a/unit_a = if locked then 0 elseif startForward then sa - fmax elseif startBackward then sa + fmax
    elseif pre(mode) == Forward then sa - fmax else sa + fmax;
  f = if locked then sa elseif startForward then f0 elseif startBackward then -f0
    elseif pre(mode) == Forward then f0 else -f0;
  mode = if (pre(mode) == Forward or startForward) and v > 0 then Forward
    elseif (pre(mode) == Backward or startBackward) and v < 0 then Backward else Stuck;
end Friction;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_friction_element_sticks_and_slides(simulate, solver: str) -> None:
    """Closed form of the first slide: it begins where A sin t = fmax and ends where the speed is zero again."""
    r = simulate(FRICTION, 6.0, solver, max_step=0.1)  # at rest nothing else bounds the step
    begin = np.arcsin(1.2 / 1.5)
    sliding = np.flatnonzero(r["v"] > 1e-6)
    assert r.time[sliding[0]] == pytest.approx(begin, abs=0.05)
    first = (r.time > begin) & (r.time < 2.0)
    t = r.time[first]
    np.testing.assert_allclose(r["v"][first], 1.5 * (np.cos(begin) - np.cos(t)) - (t - begin), atol=1e-6)
    assert np.all(r["v"][r.time < begin] == 0)
    assert np.max(np.abs(r["f"])) <= 1.2 + 1e-6


BALL = """model Ball
  parameter Real g(unit = "m/s2") = 9.81; parameter Real e = 0.8;
  Real h(unit = "m", start = 1, fixed = true); Real v(unit = "m/s", start = 0, fixed = true);
  Integer n(start = 0, fixed = true); Boolean second;
equation
  v = der(h); der(v) = -g;
  second = n >= 2 and not n > 2;
  when h < 0 then
    reinit(v, -e*pre(v)); n = pre(n) + 1;
  end when;
  when h > 2 then
    terminate("it rose");
  end when;
end Ball;
"""


def test_bounces_at_the_instants_of_the_closed_form(simulate) -> None:
    r = simulate(BALL, 2.0, "ida")
    fall = np.sqrt(2 / 9.81)
    bounces = [e.time for e in r.event_log if e.kind == "state" and e.direction > 0]
    np.testing.assert_allclose(bounces, [fall, fall + 1.6 * fall, fall + 1.6 * fall + 1.28 * fall], atol=1e-7)
    assert r["n"][-1] == 3


INITIAL = """model Initial
  parameter Real a(unit = "1/s") = 2; parameter Real x0 = 1.5*b; parameter Real b = 2;
  parameter Real c(unit = "1/s") = 3;
  Real x(start = 5); Real y(start = x0); Real z; Integer n(start = 7);
  discrete Real first;
initial equation
  der(x) = 0;
equation
  der(x) = -a*x + c;
  der(y) = -a*y;
  z^3 + z = x + y;
  when initial() then
    first = x + b;
  end when;
  when y < 0.5 then
    n = pre(n) + 1;
  end when;
end Initial;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_initial_equations_starts_and_when_initial(simulate, tmp_path: Path, solver: str) -> None:
    r = simulate(INITIAL, 1.0, solver)
    np.testing.assert_allclose(r["x"], 1.5, atol=1e-9)
    np.testing.assert_allclose(r["y"], 3 * np.exp(-2 * r.time), atol=1e-7)
    np.testing.assert_allclose(r["z"] ** 3 + r["z"], r["x"] + r["y"], atol=1e-8)
    assert (r["n"][0], r["n"][-1], r["first"][-1]) == (7, 8, 3.5)
    warnings = translate(str(tmp_path / "Initial.mo"))[1].warnings
    assert [w.code for w in warnings if "y" in w.message.split()] == ["S021"]


FUNCTIONS = """package Functions
  function root "by Newton's method: a loop of unknown length"
    input Real a; output Real x; protected Real e;
  algorithm
    x := 1 + a; e := 1;
    while abs(e) > 1e-15*(1 + x) loop
      e := (x*x - a)/(2*x); x := x - e;
    end while;
  end root;
  function powers "sum and running products"
    input Real x[:]; output Real s; output Real p[size(x, 1)];
  algorithm
    s := 0;
    for i in 1:size(x, 1) loop
      s := s + x[i]; p[i] := if i == 1 then x[i] else p[i-1]*x[i];
      if s > 1e6 then
        return;
      end if;
    end for;
  end powers;
  model Constrained "the length of a string is a function: differentiated twice by index reduction"
    parameter Real k(unit = "1/s") = 1; constant Real one(unit = "s2") = 1;
    Real x(start = 1, fixed = true); Real v(start = 0, fixed = true); Real z; Real f; Real vz; Real s; Real p[3];
  equation
    v = der(x)/k; der(v) = k*(f - x);
    z = root(1 + x^2);
    vz = der(z)/k; der(vz) = -k*f;
    (s, p) = powers({x, 2, v + z});
  end Constrained;
end Functions;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_functions_and_their_derivatives(tmp_path: Path, solver: str) -> None:
    path = tmp_path / "Functions.mo"
    path.write_text(FUNCTIONS)
    compiled = compile_model("Functions.Constrained", search_path=[str(path)], cache_directory=str(tmp_path))
    r = runtime.simulate(runtime.Model(compiled.path), solver=solver, stop=1.0, rtol=1e-9, atol=1e-11, interval=0.01)
    assert r.complete, r.failure
    x, v, z = r["x"], r["v"], r["z"]
    np.testing.assert_allclose(z, np.sqrt(1 + x**2), rtol=1e-12)
    np.testing.assert_allclose(r["vz"], x * v / z, atol=1e-10)
    np.testing.assert_allclose(r["s"], x + 2 + v + z, rtol=1e-12)
    np.testing.assert_allclose(r["p[3]"], x * 2 * (v + z), rtol=1e-9, atol=1e-12)


LOOKUP = """package Lookup
  function find "linear interpolation with a search of unknown length"
    input Real x; input Real t[:]; input Real y[:]; output Real r; protected Integer k;
  algorithm
    assert(x <= t[size(t, 1)], "above the table");
    k := 1;
    while k < size(t, 1) - 1 and t[k+1] < x loop k := k + 1; end while;
    r := y[k] + (y[k+1] - y[k])*(x - t[k])/(t[k+1] - t[k]);
  end find;
  model Ramp
    parameter Real rate(unit = "1/s") = 1;
    Real x(start = 0, fixed = true); Real z;
  equation
    der(x) = rate;
    z = find(x, {-1, 1, 2, 4}, {0, 1, 4, 16});
  end Ramp;
end Lookup;
"""


def test_function_searches_a_table_and_its_assert_is_named(tmp_path: Path) -> None:
    path = tmp_path / "Lookup.mo"
    path.write_text(LOOKUP)
    compiled = compile_model("Lookup.Ramp", search_path=[str(path)], cache_directory=str(tmp_path))
    r = runtime.simulate(runtime.Model(compiled.path), stop=5.0, interval=0.25)
    assert not r.complete
    assert "above the table" in r.failure.message
    assert r.failure.line == 5
    np.testing.assert_allclose(r["z"], np.interp(r["x"], [-1, 1, 2, 4], [0, 1, 4, 16]), rtol=1e-12)
    assert 1 < r["x"][-1] <= 4


PENDULUM = """model Pendulum
  parameter Real L(unit = "m") = 1; parameter Real g(unit = "m/s2") = 9.81;
  Real x(unit = "m", start = 0.8, fixed = true); Real y(unit = "m", start = -0.6);
  Real vx(unit = "m/s", start = 0, fixed = true); Real vy(unit = "m/s"); Real F(unit = "1/s2");
equation
  vx = der(x); vy = der(y);
  der(vx) = -x*F; der(vy) = -y*F - g;
  x^2 + y^2 = L^2;
end Pendulum;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_index_three_pendulum_swings_with_the_right_state(simulate, solver: str) -> None:
    text = PENDULUM.replace("fixed = true)", "fixed = true, stateSelect = StateSelect.prefer)")
    r = simulate(text, 3.0, solver)
    assert np.min(r["x"]) == pytest.approx(-0.8, abs=1e-3)
    np.testing.assert_allclose(r["x"] ** 2 + r["y"] ** 2, 1, atol=1e-10)
    np.testing.assert_allclose((r["vx"] ** 2 + r["vy"] ** 2) / 2 + 9.81 * r["y"], -9.81 * 0.6, atol=1e-5)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_choice_of_states_that_ceases_to_hold_ends_the_run(tmp_path: Path, solver: str) -> None:
    """The height has to be the state, and at the bottom it is none."""
    always = ", stateSelect = StateSelect.always)"
    text = PENDULUM.replace(", fixed = true", "").replace("-0.6)", "-0.6" + always)
    text = text.replace('Real vy(unit = "m/s")', 'Real vy(unit = "m/s"' + always)
    compiled = compile_model(write_model(tmp_path, text), cache_directory=str(tmp_path))
    r = runtime.simulate(runtime.Model(compiled.path), solver=solver, stop=3.0, rtol=1e-9, atol=1e-11)
    assert not r.complete
    assert "stateSelect=StateSelect.prefer for x" in r.failure.message
    assert abs(r["x"][-1]) == pytest.approx(0.1, abs=0.15)


@pytest.mark.parametrize("solver", SOLVERS)
def test_friction_element_that_is_braked_hard_sticks(simulate, solver: str) -> None:
    """The path variable of sliding lies far outside the locked range: neither direction of starting is consistent."""
    text = FRICTION.replace("parameter Real m = 1", "parameter Real m = 0.05").replace("v(start = 0,", "v(start = 5,")
    r = simulate(text, 1.0, solver, max_step=0.1)
    stuck = (r.time > 0.34) & (r.time < np.arcsin(1.2 / 1.5))
    assert np.max(np.abs(r["v"][stuck])) < 1e-9
    assert np.all(r["mode"][stuck] == 0)
    assert r["v"][-1] > 0.1


@pytest.mark.parametrize("solver", SOLVERS)
def test_sample_in_an_equation_holds_at_its_instants_only(simulate, solver: str) -> None:
    """y is 1 at eleven instants, which have no length: x = time."""
    text = """model Ticks
  Real x(start = 0, fixed = true); Real y; discrete Real n(start = 0, fixed = true);
equation
  y = if sample(0, 0.1) then 1 else 0;
  der(x) = 1 + y;
  when sample(0, 0.1) then n = pre(n) + y; end when;
end Ticks;
"""
    r = simulate(text, 1.04, solver)
    assert r["x"][-1] == pytest.approx(1.04, rel=1e-9)
    assert r["n"][-1] == 11
    assert set(r["y"]) == {0.0}


EQUAL = """model Equal "Equal discrete variables, each with a value of its own before the start"
  parameter Integer earlier = 1;
  Integer a(start = earlier, fixed = true); Integer b(start = 2, fixed = true);
  Integer of_a; Integer of_b; Real x(start = 0, fixed = true);
equation
  when time > 1 then b = pre(b) + 3; end when;
  a = b;
  when {initial(), time > 2} then of_a = pre(a); of_b = pre(b); end when;
  der(x) = a;
end Equal;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_equal_discrete_variables_may_have_been_others_before(simulate, solver: str) -> None:
    """A fixed start is that of pre(v) (8.6): no contradiction, unlike that of states."""
    r = simulate(EQUAL, 3.0, solver)
    early, late = r.time < 1, r.time > 2
    np.testing.assert_array_equal(r["a"], r["b"])
    assert set(r["a"][early]) == {2} and set(r["a"][late]) == {5}
    assert set(r["of_a"][early]) == {1} and set(r["of_b"][early]) == {2}
    assert set(r["of_a"][late]) == set(r["of_b"][late]) == {5}
    assert r["x"][-1] == pytest.approx(2 + 2 * 5)
