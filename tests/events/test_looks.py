"""Guards that come and go inside a step of slow states: the events of closed forms, whatever the step."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import translate
from tests.codegen.generated import write_model
from tests.events.models import compiled

SOLVERS = ("ida", "dopri5", "rodas4")
COUNTED = """
  Boolean above; Integer n(start=0, fixed=true);
equation
  {equations}
  when edge(above) then n = pre(n) + 1; end when;
"""
SLOW = "model Slow Real x(start=1, fixed=true);" + COUNTED.format(
    equations="der(x) = -0.1*x; above = sin(10*time) > 0.5;") + "end Slow;"  # fmt: skip
STATELESS = "model Stateless" + COUNTED.format(equations="above = cos(2*time) > 0.99;") + "end Stateless;"
COASTING = (
    """model Coasting "Hall sensor on a free rotor"
  parameter Real p = 8; Real phi(start=0, fixed=true); Real w(start=10, fixed=true); Real hall;
"""
    + COUNTED.format(equations="der(phi) = w; der(w) = -0.01*w; hall = sin(p*phi + 0.1); above = hall > 0.2;")
    + "end Coasting;"
)
PULSES = """model Pulses "as often as results are wanted"
  Real x(start=1, fixed=true);""" + COUNTED.format(
    equations="der(x) = -0.1*x; above = exp(-((time - 7.03)/0.05)^2) + exp(-((time - 12.21)/0.05)^2) > 0.5;"
) + "end Pulses;"  # fmt: skip


def switchings(result: runtime.Result) -> list[float]:
    assert result.complete, result.failure
    return [e.time for e in result.event_log]


def crossings(rate: float, level: float, stop: float) -> list[float]:
    """Of sin(rate t) through `level` up to `stop`."""
    up, down, turn = np.arcsin(level), np.pi - np.arcsin(level), 2 * np.pi
    k = np.arange(int(rate * stop / turn) + 1)
    times = np.sort(np.concatenate([up + turn * k, down + turn * k])) / rate
    return list(times[times < stop])


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_guard_of_time_crosses_while_the_state_hardly_moves(tmp_path: Path, solver: str) -> None:
    result = runtime.simulate(compiled(tmp_path, SLOW), solver=solver, stop=20.0)
    assert switchings(result) == pytest.approx(crossings(10, 0.5, 20), abs=1e-9)
    assert result["n"][-1] == 32


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_model_without_states_has_its_events_too(tmp_path: Path, solver: str) -> None:
    """Narrow peaks: cos is above 0.99 during a twenty-second of its turn."""
    result = runtime.simulate(compiled(tmp_path, STATELESS), solver=solver, stop=100.0)
    half = np.arccos(0.99) / 2
    assert switchings(result) == pytest.approx([t for k in range(32) for t in (k * np.pi - half, k * np.pi + half)
                                                if 0 < t < 100], abs=1e-9)  # fmt: skip


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("pairs", (1.0, 8.0, 50.0))
def test_a_hall_sensor_counts_the_turns_of_a_coasting_rotor(tmp_path: Path, solver: str, pairs: float) -> None:
    result = runtime.simulate(compiled(tmp_path, COASTING), solver=solver, stop=20.0, parameters={"p": pairs},
                              rtol=1e-8)  # fmt: skip
    angle = np.array([t for t in crossings(1, 0.2, 1e5) if 0.1 < t < pairs * 1000 * (1 - np.exp(-0.2)) + 0.1])
    expected = -np.log1p(-(angle - 0.1) / pairs / 1000) / 0.01
    assert switchings(result) == pytest.approx(list(expected), abs=1e-5)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("level", (0.999, 0.9999, 0.999999))
def test_peaks_far_narrower_than_a_look_are_found_each(tmp_path: Path, solver: str, level: float) -> None:
    """One place tried in each piece of a step found a third of those of a hundredth of a turn."""
    model = compiled(tmp_path, COASTING.replace("hall > 0.2", f"hall > {level}"))
    result = runtime.simulate(model, solver=solver, stop=20.0, rtol=1e-8)
    tops = int((8 * 1000 * (1 - np.exp(-0.2)) + 0.1 - np.pi / 2) / (2 * np.pi)) + 1
    assert result["n"][-1] == tops
    assert len(switchings(result)) == 2 * tops


@pytest.mark.parametrize("solver", SOLVERS)
def test_any_other_guard_is_looked_at_as_often_as_results_are_wanted(tmp_path: Path, solver: str) -> None:
    model, half = compiled(tmp_path, PULSES), 0.05 * np.sqrt(np.log(2))
    result = runtime.simulate(model, solver=solver, stop=20.0, interval=0.05)
    assert switchings(result) == pytest.approx([7.03 - half, 7.03 + half, 12.21 - half, 12.21 + half], abs=1e-9)


def test_sensitivities_survive_a_step_in_pieces(tmp_path: Path) -> None:
    text = SLOW.replace("model Slow ", "model Slow parameter Real a = 0.1;").replace("-0.1*x", "-a*x")
    model = compiled(tmp_path, text, sensitivities=True)
    for solver in ("ida", "dopri5"):
        result = runtime.simulate(model, solver=solver, stop=20.0, interval=1.0, rtol=1e-8, sensitivities=["a"])
        assert result.complete, result.failure
        t = result["time"]
        assert result.sensitivity("x", "a") == pytest.approx(-t * np.exp(-0.1 * t), abs=1e-5)


def test_phases_are_told_apart_by_what_turns(tmp_path: Path) -> None:
    """Three phases of a machine are one; an affine guard needs nothing."""
    text = """model Three
  parameter Real s = 2; Real phi(start=0, fixed=true); Boolean b[3]; Boolean c;
equation
  der(phi) = 1;
  for k in 1:3 loop b[k] = sin(s*phi - 2*k) > 0; end for;
  c = 3*phi > 1;
end Three;"""
    prepared, _ = translate(write_model(tmp_path, text))
    assert [str(e) for e in prepared.guards.phases] == ["s * phi"]
    assert not prepared.guards.curved


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("interval", [0.0, 0.25])
def test_a_look_that_goes_too_far_is_shortened(tmp_path: Path, solver: str, interval: float) -> None:
    """z^2 + z = x ends at x = -1/4, soon behind where max(x, 0) switches; a look of a second passes both."""
    text = """model Halves
  Real x, z(start=0.5);
equation
  x = sin(3*time + 0.7); z^2 + z = max(x, 0);
end Halves;"""
    r = runtime.simulate(compiled(tmp_path, text), solver=solver, stop=4.0, interval=interval)
    np.testing.assert_allclose(switchings(r), (np.pi * np.arange(1, 5) - 0.7) / 3, atol=1e-9)
    np.testing.assert_allclose(r["z"], -0.5 + np.sqrt(0.25 + np.maximum(r["x"], 0)), atol=1e-9)


@pytest.mark.parametrize("solver", SOLVERS)
def test_an_equation_without_a_value_behind_its_relation_says_so(tmp_path: Path, solver: str) -> None:
    """z^2 = x has none behind x = 0, and abs(x) is x until it has switched there."""
    text = """model Root
  Real x, z(start=0.5), y(start=0, fixed=true);
equation
  x = sin(time + 0.7); z^2 = {}; der(y) = z;
end Root;"""
    r = runtime.simulate(compiled(tmp_path, text.format("abs(x)")), solver=solver, stop=4.0)
    assert r.failure.line == 4 and "the relation 0.0 > x in abs(x) is at zero there" in str(r.failure)
    r = runtime.simulate(compiled(tmp_path, text.format("noEvent(abs(x))")), solver=solver, stop=4.0)
    assert r.complete, r.failure
