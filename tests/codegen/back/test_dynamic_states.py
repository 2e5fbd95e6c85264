"""States that are chosen anew in the run, against the same mechanisms in coordinates that are good everywhere."""

from __future__ import annotations

from pathlib import Path
import re

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lacuna import runtime
from lacuna.codegen.compile import compile_model, translate
from tests.codegen.generated import write_model

SOLVERS = ("ida", "dopri5", "rodas4")
RTOL = 1e-9

PENDULUM = """model Pendulum
  parameter Real L(unit = "m") = 1; parameter Real g(unit = "m/s2") = 9.81; parameter Real m(unit = "kg") = 1;
  Real x(unit = "m", start = 0, fixed = true); Real y(unit = "m", start = -1);
  Real vx(unit = "m/s", start = 7, fixed = true); Real vy(unit = "m/s"); Real F(unit = "N");
equation
  der(x) = vx; der(y) = vy;
  m*der(vx) = -x/L*F; m*der(vy) = -y/L*F - m*g;
  x^2 + y^2 = L^2;
end Pendulum;
"""

DOUBLE = """model Double
  parameter Real g(unit = "m/s2") = 9.81;
  Real x1(unit = "m", start = 1, fixed = true), y1(unit = "m", start = 0.1);
  Real x2(unit = "m", start = 1, fixed = true), y2(unit = "m", start = 1);
  Real u1(unit = "m/s"), v1(unit = "m/s", start = 0, fixed = true);
  Real u2(unit = "m/s", start = 0, fixed = true), v2(unit = "m/s"); Real p(unit = "1/s2"), q(unit = "1/s2");
equation
  der(x1) = u1; der(y1) = v1; der(x2) = u2; der(y2) = v2;
  der(u1) = -p*x1 + q*(x2 - x1); der(v1) = -p*y1 + q*(y2 - y1) - g;
  der(u2) = -q*(x2 - x1); der(v2) = -q*(y2 - y1) - g;
  x1^2 + y1^2 = 1;
  (x2 - x1)^2 + (y2 - y1)^2 = 1;
end Double;
"""

SLIDER = """model Slider "the crank turns through both dead centres; coordinates are the ends of the rod"
  parameter Real r(unit = "m") = 0.1, l(unit = "m") = 0.3, J(unit = "kg.m2") = 1e-3, m(unit = "kg") = 0.5;
  Real s(unit = "m", start = 0.39), v(unit = "m/s"), x(unit = "m", start = 0.098, fixed = true), vx(unit = "m/s");
  Real y(unit = "m", start = 0.02), vy(unit = "m/s", start = 3, fixed = true);
  Real F(unit = "N"), G(unit = "N");
equation
  der(s) = v; der(x) = vx; der(y) = vy;
  m*der(v) = -F*(s - x)/l;
  J/r^2*der(vx) = F*(s - x)/l - G*x/r;
  J/r^2*der(vy) = -F*y/l - G*y/r;
  x^2 + y^2 = r^2;
  (s - x)^2 + y^2 = l^2;
end Slider;
"""


def run(folder: Path, text: str, stop: float, **settings: object) -> runtime.Result:
    model = runtime.Model(compile_model(write_model(folder, text), cache_directory=str(folder)).path)
    result = runtime.simulate(model, **{"stop": stop, "interval": stop / 400, "rtol": RTOL, "events": False} | settings)
    assert result.complete, result.failure
    return result


def reference(rates, start: list[float], t: np.ndarray) -> np.ndarray:
    found = solve_ivp(rates, (0, t[-1]), start, t_eval=t, method="DOP853", rtol=1e-12, atol=1e-13)
    assert found.success
    return found.y


@pytest.mark.parametrize("solver", SOLVERS)
def test_pendulum_turns_over_many_times(tmp_path: Path, solver: str) -> None:
    r = run(tmp_path, PENDULUM, 20.0, solver=solver)
    theta = reference(lambda t, q: [q[1], -9.81 * np.sin(q[0])], [0.0, 7.0], r["time"])[0]
    assert theta[-1] > 15 * 2 * np.pi
    # an error of the energy grows into one of the angle like the square of time; 1e-5 rad after 17 turns
    for name, exact in (("x", np.sin(theta)), ("y", -np.cos(theta))):
        np.testing.assert_allclose(r[name], exact, atol=1e5 * RTOL)
    np.testing.assert_allclose(r["x"] ** 2 + r["y"] ** 2, 1, atol=1e-9)


@pytest.mark.parametrize("settings", [{"solver": "rk4", "step": 1e-3}, {"solver": "euler", "step": 1e-4}])
def test_fixed_steps_turn_over(tmp_path: Path, settings: dict) -> None:
    r = run(tmp_path, PENDULUM, 2.0, **settings)
    theta = reference(lambda t, q: [q[1], -9.81 * np.sin(q[0])], [0.0, 7.0], r["time"])[0]
    np.testing.assert_allclose(r["x"], np.sin(theta), atol=1e-6 if settings["solver"] == "rk4" else 0.05)
    np.testing.assert_allclose(r["x"] ** 2 + r["y"] ** 2, 1, atol=1e-9)


@pytest.mark.parametrize("solver", SOLVERS)
def test_double_pendulum_turns_over(tmp_path: Path, solver: str) -> None:
    def rates(t, q):
        a, b, p, w = q
        c, s = np.cos(a - b), np.sin(a - b)
        mass = np.array([[2, c], [c, 1]])
        force = [-s * w * w - 2 * 9.81 * np.sin(a), s * p * p - 9.81 * np.sin(b)]
        return [p, w, *np.linalg.solve(mass, force)]

    r = run(tmp_path, DOUBLE, 3.0, solver=solver)
    a, b, _, _ = reference(rates, [np.pi / 2, np.pi, 0.0, 0.0], r["time"])
    assert np.ptp(a) > np.pi and np.ptp(b) > 1.5 * np.pi
    # chaotic: errors grow by e within about half a second
    np.testing.assert_allclose(r["x2"], np.sin(a) + np.sin(b), atol=1e6 * RTOL)
    np.testing.assert_allclose(r["y2"], -np.cos(a) - np.cos(b), atol=1e6 * RTOL)


@pytest.mark.parametrize("solver", SOLVERS)
def test_slider_crank_turns_through_its_dead_centres(tmp_path: Path, solver: str) -> None:
    r_, l_, inertia, mass = 0.1, 0.3, 1e-3, 0.5

    def slope(a):
        """ds/da and its derivative by a"""
        root = np.sqrt(l_**2 - (r_ * np.sin(a)) ** 2)
        first = -r_ * np.sin(a) - r_**2 * np.sin(a) * np.cos(a) / root
        second = -r_ * np.cos(a) - r_**2 * np.cos(2 * a) / root - r_**4 * (np.sin(a) * np.cos(a)) ** 2 / root**3
        return first, second

    def rates(t, q):
        first, second = slope(q[0])
        return [q[1], -mass * first * second * q[1] ** 2 / (inertia + mass * first**2)]

    r = run(tmp_path, SLIDER, 4.0, solver=solver)
    start = np.arccos(0.98)
    a = reference(rates, [start, 3 / (r_ * np.cos(start))], r["time"])[0]
    assert a[-1] > 5 * 2 * np.pi
    np.testing.assert_allclose(r["s"], r_ * np.cos(a) + np.sqrt(l_**2 - (r_ * np.sin(a)) ** 2), atol=1e5 * RTOL * l_)


def test_in_other_units_states_are_exchanged_at_the_same_times(tmp_path: Path) -> None:
    """Lengths in mm, times in s; and a slider-crank, whose coordinates have one unit, in um."""
    for text, factor, names in ((PENDULUM, 1e3, ("L", "g")), (SLIDER, 1e6, ("r", "l"))):
        scaled = text
        for name in names:
            scaled = re.sub(rf'(\b{name}\(unit = "[^"]*"\)) = ([\d.]+)', rf"\1 = {factor:g}*\2", scaled)
        scaled = re.sub(r"start = (-?[\d.]+)", rf"start = {factor:g}*(\1)", scaled)
        if text is SLIDER:
            scaled = scaled.replace('J(unit = "kg.m2") = 1e-3', f'J(unit = "kg.m2") = {factor**2 * 1e-3:g}')
        found = [run(tmp_path, t, 2.0, solver="dopri5", rtol=1e-6, events=True) for t in (text, scaled)]
        times = [np.unique(np.round(f["time"][f.event], 4)) for f in found]  # positions and speeds within rounding
        assert len(times[0]) == len(times[1]) > 5
        np.testing.assert_allclose(*times, atol=1.1e-4)


def test_sensitivities_go_through_the_exchange(tmp_path: Path) -> None:
    path = compile_model(write_model(tmp_path, PENDULUM), cache_directory=str(tmp_path), sensitivities=True).path
    model = runtime.Model(path)
    exact = runtime.simulate(model, solver="dopri5", stop=3.0, rtol=1e-10, sensitivities=["L"])
    assert exact.complete, exact.failure
    ends = [
        runtime.simulate(model, solver="dopri5", stop=3.0, rtol=1e-12, parameters={"L": length})["x"][-1]
        for length in (1 + 1e-5, 1 - 1e-5)
    ]
    assert exact.sensitivity("x", "L")[-1] == pytest.approx((ends[0] - ends[1]) / 2e-5, rel=1e-5)


def test_preference_is_kept_as_long_as_it_can_be(tmp_path: Path) -> None:
    """Of one kind, a state is exchanged at a slope of 2; a preferred one at 20, and it comes back at 1/5."""
    prefer = re.sub(r"(Real v?x\(.*?true)\)", r"\1, stateSelect = StateSelect.prefer)", PENDULUM)
    for text, slopes in ((PENDULUM, (2, 2)), (prefer, (20, 0.2))):
        r = run(tmp_path, text, 1.2, solver="dopri5", events=True)
        found = abs(r["y"][r.event] / r["x"][r.event])[::2]
        away = np.minimum(abs(np.log(found * slopes[0])), abs(np.log(found / slopes[1])))
        assert len(found) >= 3 and np.all(away < 1e-3), found


def test_nothing_is_chosen_where_a_pivot_never_varies(tmp_path: Path) -> None:
    text = """model Cam "the lift is a function of the angle, whose pivot is 1 at any angle"
  Real a(start = 0.3, fixed = true), w(start = 5, fixed = true), h, v, F;
equation
  der(a) = w; der(h) = v; h = 3*a^2; der(w) = -6*a*F; der(v) = F - 9.81;
end Cam;
"""
    prepared, _ = translate(write_model(tmp_path, text))
    assert set(prepared.system.states) == {"a", "w"} and not prepared.system.switches


FADING = """model Fading "An output in time that is a function of two states, one of the size 1e5 and one of 1e-5"
  Real a(start = 1e5), b(start = 1e-5), y(start = 0), slope;
initial equation
  a = 1e5; b = 1e-5;
equation
  der(a) = -a;
  der(b) = 1e-5;
  y = a*exp(-(1e-5 + 1e-6*time)/b);
  slope = der(y);
end Fading;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_slopes_are_no_unknowns_of_the_residual_form(tmp_path: Path, solver: str) -> None:
    """A choice of states whose residual form, torn, would amplify rounding: it leaves linear blocks whole."""
    model = runtime.Model(compile_model(write_model(tmp_path, FADING)).path)
    result = runtime.simulate(model, solver=solver, rtol=1e-8, stop=1.0)
    assert result.complete, result.failure
    t, b = result.time, 1e-5 * (1 + result.time)
    assert result["y"] == pytest.approx(1e5 * np.exp(-t) * np.exp(-(1e-5 + 1e-6 * t) / b), rel=1e-6)


LEVER = """model Lever "A slider in m by an angle in rad that stateSelect holds on to"
  parameter Real r(unit = "m") = 1, J(unit = "kg.m2") = 1, m(unit = "kg") = 1;
  Real phi(unit = "rad", start = 0, fixed = true, nominal = 100, stateSelect = StateSelect.always);
  Real w(unit = "rad/s", start = 1, fixed = true, nominal = 100, stateSelect = StateSelect.always);
  Real x(unit = "m", nominal = 1e-3), v(unit = "m/s", nominal = 1e-3), F(unit = "N");
equation
  der(phi) = w; der(x) = v;
  x*(2 + sin(phi)) = r*(1 + phi);
  J*der(w) = -F*(r - x*cos(phi)); m*der(v) = F*(2 + sin(phi));
end Lever;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_state_is_no_bad_one_for_sizes_in_several_units(tmp_path: Path, solver: str) -> None:
    """dx/dphi is near 1 m all the time, and 1e5 by what the nominal values say."""
    r = run(tmp_path, LEVER, 2.0, solver=solver)
    x, phi = r["x"], r["phi"]
    np.testing.assert_allclose(x * (2 + np.sin(phi)), 1 + phi, rtol=1e-7)
    energy = r["w"] ** 2 + r["v"] ** 2
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)


CRANK = """model Crank "The slider is held on to as the state, which it is none of in its dead centre"
  parameter Real L(unit = "m") = 1, J(unit = "kg.m2") = 1, m(unit = "kg") = 1;
  Real phi(unit = "rad", start = {start}, fixed = true), w(unit = "rad/s", start = 1, fixed = true), F(unit = "N");
  Real x(unit = "m", start = cos({start}), stateSelect = StateSelect.always);
  Real v(unit = "m/s", start = -sin({start}), stateSelect = StateSelect.always);
equation
  der(phi) = w; der(x) = v;
  x = L*cos(phi);
  J*der(w) = F*L*sin(phi); m*der(v) = F;
end Crank;
"""


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("start", [-1.0, -0.1, -0.01])
def test_a_state_in_another_unit_is_watched(tmp_path: Path, solver: str, start: float) -> None:
    compiled = compile_model(write_model(tmp_path, CRANK.format(start=start)), cache_directory=str(tmp_path))
    model = runtime.Model(compiled.path)
    r = runtime.simulate(model, solver=solver, stop=2.0, rtol=1e-6)
    assert not r.complete
    assert r.failure.time < 2 * abs(start)
