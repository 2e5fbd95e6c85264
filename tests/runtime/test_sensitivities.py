"""Forward sensitivities against closed forms, through every kind of event; what is refused, and what is flagged."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import lacuna
from lacuna import runtime
from lacuna.codegen.compile import compile_model
from tests.runtime.closed_forms import ALL, BALL, ClosedForm

RTOL = 1e-9
# Error of a sensitivity over its largest value: the run's own error, amplified by the events (a bounce adds its share).
BOUND = 1e3 * RTOL
SOLVERS = ("dopri5", "ida")


def compiled(tmp_path: Path, text: str, **options) -> runtime.Model:
    file = tmp_path / f"{text.split()[1]}.mo"
    file.write_text(text)
    return runtime.Model(compile_model(str(file), sensitivities=True, **options).path)


def run(model: runtime.Model, **options) -> runtime.Result:
    result = runtime.simulate(model, **{"solver": "dopri5", "rtol": RTOL, "events": False, **options})
    assert result.complete, result.failure
    return result


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("case", ALL, ids=[c.name for c in ALL])
def test_closed_forms(case: ClosedForm, solver: str, tmp_path: Path) -> None:
    model = compiled(tmp_path, case.text)
    asked = [case.states.get(p, p) for p in case.parameters]
    result = run(model, solver=solver, stop=case.stop, interval=case.stop / 400, sensitivities=asked)
    instants = np.real(np.array(case.instants(**case.parameters), dtype=complex))
    clear = np.array([np.all(abs(instants - t) > 1e-6) for t in result.time])
    for parameter, column in zip(case.parameters, asked, strict=True):
        for output in case.outputs:
            expected = case.derivative(output, parameter, result.time)[clear]
            found = result.sensitivity(output, column)[clear]
            size = max(
                np.abs(expected).max(), 1e-3 * abs(result[output]).max() / (abs(case.parameters[parameter]) or 1)
            )
            assert np.abs(found - expected).max() <= BOUND * size, (parameter, output)
    assert result.flags == []


def test_an_algebraic_output_a_derivative_and_a_parameter_have_sensitivities_too(tmp_path: Path) -> None:
    """A nonlinear block, a linear one and a function of the model, all solved inside the explicit form."""
    text = """model Blocks
  parameter Real a = 2;
  parameter Real b = 0.5;
  parameter Real twice = 2*a;
  function f
    input Real u;
    input Real p;
    output Real y;
  algorithm
    y := u*u + p*u;
  end f;
  Real x(start = 1, fixed = true);
  Real z(start = 1);
  Real u, v;
  Real w;
equation
  der(x) = -x;
  z + b*z^3 = f(x, a);
  u + a*v = x;
  b*u - v = z;
  w = der(x) + twice;
end Blocks;"""
    model = compiled(tmp_path, text)
    result = run(model, stop=1.0, interval=0.1, sensitivities=["a", "b"])
    x, z, a, b = np.exp(-result.time), result["z"], 2.0, 0.5
    dz_da, dz_db = x / (1 + 3 * b * z**2), -(z**3) / (1 + 3 * b * z**2)
    np.testing.assert_allclose(result.sensitivity("z", "a"), dz_da, rtol=1e-7)
    np.testing.assert_allclose(result.sensitivity("z", "b"), dz_db, rtol=1e-7)
    # v = (b x - z) / (1 + a b)
    v = (b * x - z) / (1 + a * b)
    np.testing.assert_allclose(result.sensitivity("v", "a"), (-dz_da - b * v) / (1 + a * b), rtol=1e-7)
    np.testing.assert_allclose(result.sensitivity("v", "b"), (x - dz_db - a * v) / (1 + a * b), rtol=1e-7)
    np.testing.assert_allclose(result.sensitivity("w", "a"), 2.0, rtol=1e-12)


def test_recorded_inputs(tmp_path: Path) -> None:
    """A guard that a recorded ramp passes: the instant moves by the input's slope; a held input jumps where it does."""
    text = """model Driven
  input Real u;
  input Real h;
  parameter Real c = 0.3;
  Real x(start = 0, fixed = true);
equation
  der(x) = (if u > c then 2 else 1)*c + c*h;
end Driven;"""
    model = compiled(tmp_path, text)
    inputs = {
        "u": runtime.RecordedInput([0.0, 1.0], [0.0, 0.5]),
        "h": runtime.RecordedInput([0.0, 0.25], [1.0, 3.0], "hold"),
    }
    t, c = np.linspace(0, 1, 21), 0.3
    result = run(model, inputs=inputs, stop=1.0, output_times=t, sensitivities=["c"])
    crossing = c / 0.5
    held = np.where(t < 0.25, t, 0.25 + 3 * (t - 0.25))
    expected = np.where(t < crossing, t, 2 * t - crossing - c / 0.5) + held
    clear = abs(t - crossing) > 1e-9
    np.testing.assert_allclose(result.sensitivity("x", "c")[clear], expected[clear], atol=1e-9)


def test_rows_at_an_event_are_one_before_and_one_after_it(tmp_path: Path) -> None:
    """The jump of the speed's sensitivity at the first impact: s+ - s- = (1 + e) (g dt/dg + t) - ... in closed form."""
    model = compiled(tmp_path, BALL.text)
    result = run(model, stop=0.6, interval=0.1, events=True, sensitivities=["g"])
    before, after = np.flatnonzero(result.event)[:2]
    e, g, t1 = 0.8, 9.81, np.sqrt(2 / 9.81)
    dt = -t1 / (2 * g)
    assert result.sensitivity("v", "g")[before] == pytest.approx(-t1, rel=1e-7)
    # v+ = e g t1 and v' = -g on both sides: at fixed time, d(e g t1)/dg + g dt
    assert result.sensitivity("v", "g")[after] == pytest.approx(e * t1 + e * g * dt + g * dt, rel=1e-7)


def test_a_set_initial_value_does_not_follow_parameters(tmp_path: Path) -> None:
    model = compiled(tmp_path, BALL.text)
    result = runtime.simulate(
        model, solver="dopri5", stop=0.2, interval=0.1, initial={"h": 2.0}, sensitivities=["h0", "h"], rtol=RTOL
    )
    np.testing.assert_array_equal(result.sensitivity("h", "h0"), 0.0)
    np.testing.assert_allclose(result.sensitivity("h", "h"), 1.0)


def test_sensitivities_leave_the_run_within_its_tolerance(tmp_path: Path) -> None:
    """The error test of the columns may shorten steps, but what is computed is the same run."""
    model = compiled(tmp_path, BALL.text)
    plain, with_them = run(model, stop=2.0, interval=0.01), run(model, stop=2.0, interval=0.01, sensitivities=["e"])
    np.testing.assert_allclose(plain["h"], with_them["h"], atol=1e-8)


REFUSED = """model Refused
  parameter Integer n = 3;
  parameter Real limit = 2.5;
  parameter Real a = 1;
  parameter Real dependent = 2*a;
  final parameter Real fixed_one = 2;
  Real x(start = 0, fixed = true);
  discrete Real count(start = 0, fixed = true);
  Boolean full(start = false, fixed = true);
equation
  der(x) = a + n + dependent + fixed_one;
  when sample(0.1, 0.1) then
    count = pre(count) + 1;
    full = count > limit;
  end when;
end Refused;"""


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("n", "not Real"),
        ("limit", "only in conditions and discrete equations"),
        ("dependent", "given by other parameters"),
        ("count", "neither a parameter nor a state"),
    ],
)
def test_what_has_no_derivative_is_refused_by_name(name: str, reason: str, tmp_path: Path) -> None:
    model = compiled(tmp_path, REFUSED)
    with pytest.raises(runtime.SimulationError, match=f"with respect to {name}: .*{reason}"):
        run(model, stop=1.0, sensitivities=[name])


def test_an_unknown_parameter_is_answered_with_the_nearest(tmp_path: Path) -> None:
    with pytest.raises(runtime.UnknownNameError, match="limit"):
        run(compiled(tmp_path, REFUSED), stop=1.0, sensitivities=["limt"])


def test_solver_and_model_must_have_them(tmp_path: Path) -> None:
    model = compiled(tmp_path, BALL.text)
    with pytest.raises(runtime.SimulationError, match="solver rodas4 has no sensitivities"):
        run(model, solver="rodas4", stop=1.0, sensitivities=["e"])
    plain = runtime.Model(compile_model(str(tmp_path / "Ball.mo")).path)
    with pytest.raises(runtime.SimulationError, match="translated without derivatives"):
        run(plain, stop=1.0, sensitivities=["e"])


def test_a_grazed_guard_ends_them_with_a_flag(tmp_path: Path) -> None:
    """A parabola that touches its threshold to within the tolerance: whether it switches depends on the last digit."""
    text = """model Graze
  parameter Real top = 0.99999999;
  Real x(start = 0, fixed = true);
  Real y(start = 0, fixed = true);
equation
  der(x) = 2 - 2*time;
  der(y) = if x > top then 1 else 0;
end Graze;"""
    result = run(compiled(tmp_path, text), stop=2.0, interval=0.1, rtol=1e-6, max_step=0.05, sensitivities=["top"])
    assert any(e.kind == "state" for e in result.event_log)
    assert [f.kind for f in result.flags] == ["grazing"]
    assert "x > top" in str(result.flags[0])
    assert np.all(np.isfinite(result.sensitivity("y", "top")[result.time < 0.99]))
    assert np.all(np.isnan(result.sensitivity("y", "top")[result.time > 1.01]))


def test_two_events_that_are_about_to_change_their_order_are_flagged(tmp_path: Path) -> None:
    """Two guards that are passed at one instant, of which only one moves with c: the derivative is one-sided."""
    text = """model Order
  parameter Real c = 1;
  Real x(start = 0, fixed = true);
  Real y(start = 0, fixed = true);
  Real z(start = 0, fixed = true);
equation
  der(x) = 1;
  der(y) = 1;
  der(z) = (if x > c then 1 else 0) + (if y > 1 then 2 else 0);
end Order;"""
    model = compiled(tmp_path, text)
    together = run(model, stop=2.0, interval=0.5, sensitivities=["c"])
    assert {f.kind for f in together.flags} == {"order"}
    apart = run(model, stop=2.0, interval=0.5, parameters={"c": 1.25}, sensitivities=["c"])
    assert apart.flags == []
    assert apart.margins["c"] == pytest.approx(0.25, rel=1e-6)


def test_an_infinite_derivative_is_flagged_and_no_number(tmp_path: Path) -> None:
    text = """model Root
  parameter Real p = 0;
  Real x(start = sqrt(p), fixed = true);
equation
  der(x) = 1;
end Root;"""
    result = run(compiled(tmp_path, text), stop=1.0, interval=0.5, sensitivities=["p"])
    assert [f.kind for f in result.flags] == ["non_finite"]
    assert np.all(np.isnan(result.sensitivity("x", "p")))


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_column_without_a_known_size_is_under_error_control_too(solver: str, tmp_path: Path) -> None:
    """At rest the run could take any step; the sensitivity by an initial value of zero is as stiff as ever."""
    text = """model Stiff
  parameter Real k = 1e4;
  Real x(start = 0, fixed = true);
equation
  der(x) = -k*x;
end Stiff;"""
    result = run(compiled(tmp_path, text), solver=solver, stop=0.01, interval=1e-4, rtol=1e-7, sensitivities=["x"])
    np.testing.assert_allclose(result.sensitivity("x", "x"), np.exp(-1e4 * result.time), atol=1e-4)


def test_through_the_public_face(tmp_path: Path) -> None:
    file = tmp_path / "Ball.mo"
    file.write_text(BALL.text)
    result = lacuna.load(file).simulate(
        stop=1.0, interval=0.1, rtol=1e-8, parameters={"g": 5.0}, solver="dopri5", sensitivities=["g"]
    )
    assert result.sensitivities == ("g",)
    assert result.flags == []
    falling = result.time < np.sqrt(2 / 5)
    np.testing.assert_allclose(result.sensitivity("h", "g")[falling], -(result.time[falling] ** 2) / 2, rtol=1e-6)


def test_rounding_at_events_is_flagged(tmp_path: Path) -> None:
    """A converter: between two of its steps the held value does not change; a difference of runs would see steps."""
    text = """model Converter
  parameter Real a = 1;
  Real x(start = 0, fixed = true);
  discrete Real y(start = 0, fixed = true);
equation
  der(x) = a;
  when sample(0.1, 0.1) then
    y = 0.01*floor(x/0.01 + 0.5);
  end when;
end Converter;"""
    result = run(compiled(tmp_path, text), stop=1.0, interval=0.25, sensitivities=["a"])
    assert [f.kind for f in result.flags] == ["rounding"]
    np.testing.assert_array_equal(result.sensitivity("y", "a"), 0.0)
    np.testing.assert_allclose(result.sensitivity("x", "a"), result.time)


def test_what_was_on_arrival_has_no_sensitivities_where_it_follows_the_event(tmp_path: Path) -> None:
    text = """model Arrival
  parameter Real k = 2;
  discrete Real a(start=0, fixed=true);
  discrete Real b(start=0, fixed=true);
  Real y = a + k*time;
  Real x(start=0, fixed=true);
equation
  der(x) = y + b;
  when time >= 0.5 then
    a = pre(y) + 1;
    %s
  end when;
end Arrival;"""
    result = run(compiled(tmp_path, text % "b = y;"), sensitivities=["k"])
    assert [(f.kind, f.time) for f in result.flags] == [("arrival", pytest.approx(0.5))]
    assert (result["a"][-1], result["b"][-1]) == (2, 3)
    plain = run(compiled(tmp_path, text % "b = 0;"), sensitivities=["k"])
    assert plain.flags == []
    assert plain.sensitivity("a", "k")[-1] == pytest.approx(0.5)
