"""delay(e, T) against closed forms: the method of steps, echoes of jumps; and what is refused."""

from __future__ import annotations

from math import factorial
from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.errors import Diagnostic
from tests.events.models import compiled, simulated

STEPS = {"rk4": {"step": 1e-3}, "euler": {"step": 1e-4}}
ERROR = {"euler": 2e-3}  # of a method of first order with that step; the others are held to their tolerance
LAG = """model Lag
  parameter Real T = 0.25;
  Real x(start=1, fixed=true);
equation
  der(x) = -delay(x, T);
end Lag;
"""
ECHO = """model Echo
  Real u = if time > 0.1 then 1 else 0;
  Real y = delay(u + 0.5*delay(u, 0.2), 0.3);
  Real x(start=0, fixed=true);
equation
  der(x) = y;
end Echo;
"""


def lag(time: np.ndarray, delay: float) -> np.ndarray:
    """x' = -x(t - T), x = 1 up to the start: sum over k of (-1)^k (t - (k-1) T)^k/k! while t > (k-1) T."""
    terms = [(-1) ** k * np.maximum(time - (k - 1) * delay, 0.0 if k else 1.0) ** k / factorial(k) for k in range(12)]
    return sum(terms)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4", "rk4", "euler"])
def test_method_of_steps(tmp_path: Path, solver: str) -> None:
    tolerance = {} if solver in STEPS else {"rtol": 1e-8}
    result = simulated(tmp_path, LAG, solver=solver, stop=2.0, interval=0.05, **tolerance, **STEPS.get(solver, {}))
    assert result.complete, result.failure
    grid = ~result.event
    assert result["x"][grid] == pytest.approx(lag(result.time[grid], 0.25), abs=ERROR.get(solver, 1e-6))


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_a_jump_comes_back_as_an_event(tmp_path: Path, solver: str) -> None:
    """y jumps by 1 at 0.4 s and by 0.5 at 0.6 s, so that x(1) = 0.6 + 0.2: no step has smeared a jump."""
    result = simulated(tmp_path, ECHO, solver=solver, rtol=1e-9)
    assert result["x"][-1] == pytest.approx(0.8, abs=1e-8)
    assert result.counters["input_jumps"] >= 2


def test_a_shorter_delay_than_a_step_of_the_solver_limits_it(tmp_path: Path) -> None:
    text = LAG.replace("-delay(x, T)", "delay(cos(time), T)").replace("0.25", "1e-3")
    result = simulated(tmp_path, text)
    assert result.counters["steps"] >= 1000
    assert result["x"][-1] == pytest.approx(1 + 1e-3 + np.sin(1 - 1e-3), rel=1e-6)


@pytest.mark.parametrize("solver", ["ida", "dopri5"])
@pytest.mark.parametrize("state", ["", "Real x(start=0, fixed=true); equation der(x) = -x;"])
def test_what_turns_many_times_in_a_step_is_delayed_as_it_is(tmp_path: Path, solver: str, state: str) -> None:
    """No state follows the sine, so that nothing but what is kept of it limits a step, as long as the delay."""
    text = f"model Fast\n  Real y = delay(sin(100*time), 0.5);\n  {state}\nend Fast;\n"
    result = simulated(tmp_path, text, solver=solver, stop=2.0, interval=0.01)
    late = np.where(result.time > 0.5, np.sin(100 * (result.time - 0.5)), 0.0)
    assert result["y"] == pytest.approx(late, abs=2e-6)


@pytest.mark.parametrize("x", ["2*time", "time + 0.025*sin(40*time)"])
def test_what_turns_many_times_in_a_step_is_carried_as_it_is(tmp_path: Path, x: str) -> None:
    text = f"""model Pipe
  Real x = {x};
  Real out0, out1;
equation
  (out0, out1) = spatialDistribution(sin(30*x), 0, x, true, {{0, 1}}, {{0, 0}});
end Pipe;
"""
    result = simulated(tmp_path, text, stop=2.0, interval=0.01)
    carried = np.where(result["x"] > 1, np.sin(30 * (result["x"] - 1)), 0.0)
    assert result["out1"] == pytest.approx(carried, abs=2e-6)


def test_a_jump_without_an_event_is_one_and_what_is_too_fast_is_refused(tmp_path: Path) -> None:
    text = "model Hidden\n  Real y = delay(noEvent(if time > 0.3 then 1 else 0), 0.5);\nend Hidden;\n"
    result = simulated(tmp_path, text, stop=2.0, interval=0.0501)
    assert result["y"] == pytest.approx(np.where(result.time > 0.8, 1.0, 0.0), abs=0)
    text = text.replace("noEvent(if time > 0.3 then 1 else 0)", "sin(1e9*time)")
    assert "varies too fast" in str(simulated(tmp_path, text, stop=0.6).failure)


MATCHED = """model Matched
  parameter Real V = 310e3, Z = 258.2, T = 1.936e-4;
  Real v1, v2, es, er, i1, i2;
equation
  v1 = V*sin(314.16*time);
  v1 - es = Z*i1;
  v2 - er = Z*i2;
  es = 2*delay(v2, T) - delay(er, T);
  er = 2*delay(v1, T) - delay(es, T);
  v2 = -Z*i2;
end Matched;
"""


@pytest.mark.parametrize("scale", [1e-9, 1.0])
def test_what_cancels_is_delayed_to_a_thousandth_of_its_size(tmp_path: Path, scale: float) -> None:
    """Nothing comes back from a line that ends in its own resistance: a difference of equal voltages."""
    result = simulated(tmp_path, MATCHED.replace("310e3", str(310e3 * scale)), stop=0.01, interval=1e-4)
    assert result.complete, result.failure
    arrived = result.time >= 1.936e-4
    expected = np.where(arrived, 310e3 * scale * np.sin(314.16 * (result.time - 1.936e-4)), 0.0)
    assert result["v2"] == pytest.approx(expected, abs=1e-6 * 310e3 * scale)
    assert np.abs(result["es"]).max() < 1e-9 * 310e3 * scale


def test_the_longest_time_is_kept_to(tmp_path: Path) -> None:
    failure = simulated(tmp_path, LAG.replace("delay(x, T)", "delay(x, T, 0.1)")).failure
    assert "delayTime is longer than delayMax" in str(failure)
    negative = simulated(tmp_path, LAG.replace("0.25", "-0.25")).failure
    assert "the time of delay is positive" in str(negative)


def test_by_no_time_it_is_what_is_delayed(tmp_path: Path) -> None:
    """0 <= delayTime (3.7.4.1); a parameter that is 0 decides that nothing is kept, one that comes to be 0 is told."""
    result = simulated(tmp_path, LAG.replace("0.25", "0"), rtol=1e-9)
    assert result.complete
    assert result["x"] == pytest.approx(np.exp(-result.time), rel=1e-7)
    failure = simulated(tmp_path, LAG, parameters={"T": 0.0}).failure
    assert (failure.status, failure.line) == ("assert", 5)
    assert "the time of delay is positive" in failure.message


def test_no_sensitivities_through_a_delay(tmp_path: Path) -> None:
    with pytest.raises(Diagnostic, match="sensitivities of a model with delay"):
        compiled(tmp_path, LAG, sensitivities=True)


def test_a_delay_that_is_no_time_is_named_with_its_line(tmp_path: Path) -> None:
    result = simulated(tmp_path, LAG.replace("0.25", "1e-18"))
    assert not result.complete
    assert ":5: delay() number 1 is by 1e-18 s, which is no time" in str(result.failure)
