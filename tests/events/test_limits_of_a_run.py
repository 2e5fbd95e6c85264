"""A run ends: settings that get nowhere are refused, and Ctrl-C is heard."""

from __future__ import annotations

import math
import os
from pathlib import Path
import signal
import threading
import time

import pytest

from lacuna import runtime
from tests.events.models import compiled, simulated

CLOCK = """model Clock
  parameter Real first = 0, interval = 1;
  discrete Real n(start=0, fixed=true);
  Boolean late(start=false, fixed=true);
equation
  when sample(first, interval) then
    n = pre(n) + 1;
  end when;
  late = time > first + 2.5*interval;
end Clock;
"""
FAST = "model Fast\n  Real x(start=1, fixed=true);\nequation\n  der(x) = 1e300*x;\nend Fast;\n"


@pytest.mark.parametrize("epoch", [0.0, 1.7e9])
def test_seconds_since_1970_are_no_different(tmp_path: Path, epoch: float) -> None:
    settings = {"parameters": {"first": epoch, "interval": 1e-4}, "start": epoch, "stop": epoch + 1.00005}
    result = simulated(tmp_path, CLOCK, **settings)
    assert result.complete, result.failure
    assert result["n"][-1] == 10001
    late = [e.time - epoch for e in result.event_log if e.kind == "time"]
    assert late == pytest.approx([2.5e-4], abs=1e-6)


def test_a_clock_faster_than_the_resolution_of_time_is_refused(tmp_path: Path) -> None:
    failure = simulated(tmp_path, CLOCK, parameters={"interval": 1e-300}).failure
    assert failure.status == "argument"
    assert "lost in the rounding of time" in str(failure)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_what_explodes_ends(tmp_path: Path, solver: str) -> None:
    assert simulated(tmp_path, FAST, solver=solver).failure is not None


@pytest.mark.parametrize("rate", [1e3, 1e14, 1e17, 1e20, 1e24])
def test_rodas4_follows_what_is_stiff_beyond_all_digits(tmp_path: Path, rate: float) -> None:
    """Its dF/dy' was lost beside a dF/dy of 1e16: the state stood still, and the run was complete."""
    text = f"""model Stiff
  Real x(start=0, fixed=true);
equation
  der(x) = {rate!r}*(sin(time) + 1 - x);
end Stiff;
"""
    result = simulated(tmp_path, text, solver="rodas4", stop=1.0)
    assert result.complete, result.failure
    assert result["x"][-1] == pytest.approx(1 + math.sin(1), abs=1.1 / rate + 1e-6)


def test_steps_and_intervals_that_get_nowhere_are_refused(tmp_path: Path) -> None:
    model = compiled(tmp_path, CLOCK)
    assert "does not get through" in str(runtime.simulate(model, solver="rk4", step=1e-300).failure)
    assert "makes 1e+09 rows" in str(runtime.simulate(model, interval=1e-9).failure)
    for interval in (-1.0, float("nan"), float("inf")):
        with pytest.raises(runtime.SimulationError, match="interval"):
            runtime.Session(model, interval=interval)


def test_ctrl_c_ends_a_run(tmp_path: Path) -> None:
    text = "model Long\n  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\nend Long;\n"
    model = compiled(tmp_path, text)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # servers in this process may have taken it
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    began = time.monotonic()
    try:
        with pytest.raises(KeyboardInterrupt):
            runtime.simulate(model, solver="rk4", step=1e-6, stop=1e3, interval=1.0)
    finally:
        signal.signal(signal.SIGINT, before)
    assert time.monotonic() - began < 5


SLOW = "model Slow\n  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\nend Slow;\n"


def test_a_run_tells_how_far_it_is_and_stops_where_the_listener_raises(tmp_path: Path) -> None:
    model = compiled(tmp_path, SLOW)
    told: list[float] = []

    def watch(reached: float) -> None:
        told.append(reached)
        if len(told) == 3:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        runtime.simulate(model, solver="rk4", step=1e-6, stop=1e3, interval=1.0, watch=watch)
    assert told == sorted(told)
    assert 0 < told[0] < told[2] < 1e3


def test_a_run_without_progress_ends(tmp_path: Path) -> None:
    settings = {"parameters": {"interval": 1e-7}, "stop": 1e6, "interval": 1e5, "patience": 0.3}
    failure = runtime.simulate(compiled(tmp_path, CLOCK), **settings).failure
    assert failure is not None
    assert failure.status == "step_collapse"
    assert "0.3 s of computing brought" in str(failure)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_a_guard_that_jumps_right_behind_time_zero_is_found(tmp_path: Path, solver: str) -> None:
    """There is no shortest time behind zero: a bracket that shrinks in proportion to it does so for ever."""
    model = """model Behind
      Real y = noEvent(if time > 0 then -1 else 1);
      Real z(start=0, fixed=true);
    equation
      der(z) = if y > 0 then 1 else -1;
    end Behind;
    """
    result = simulated(tmp_path, model, solver=solver, stop=1.0)
    assert result.complete, result.failure
    assert result["z"][-1] == pytest.approx(-1, abs=1e-12)


@pytest.mark.parametrize(
    ("text", "parameter", "line", "why"),
    [
        (CLOCK, "interval", 6, "the interval of sample is positive"),
        ("model Late\n  parameter Real T = 1;\n  Real x = delay(time, T);\nend Late;\n", "T", 3,
         "the time of delay is positive"),
    ],
)  # fmt: skip
def test_a_parameter_that_no_operator_takes_is_told_with_its_line(
    tmp_path: Path, text: str, parameter: str, line: int, why: str
) -> None:
    failure = simulated(tmp_path, text, parameters={parameter: -1.0}, stop=3.0).failure
    assert failure.line == line and why in failure.message


def test_chattering_that_gets_somewhere_ends(tmp_path: Path) -> None:
    """Steps of 1e-12 s bring 1e-6 of the run in seconds, and would bring all of it in weeks."""
    text = """model Chatter
      Real x(start=0.5, fixed=true);
    equation
      der(x) = noEvent(if x > 0 then -1 else 1);
    end Chatter;
    """
    failure = runtime.simulate(compiled(tmp_path, text), stop=1.0, interval=0.1, patience=1.0).failure
    assert failure is not None
    assert (failure.status, failure.variable, failure.line) == ("step_collapse", "x", 4)
    assert "1 s of computing brought" in str(failure)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_a_run_that_is_lost_in_the_rounding_of_time_is_refused(tmp_path: Path, solver: str) -> None:
    """Milliseconds since 1970: steps and the time that they lead to part company, x ends at 1.0002."""
    text = "model M\n  Real x(start=0, fixed=true);\nequation\n  der(x) = 1;\nend M;\n"
    failure = simulated(tmp_path, text, solver=solver, start=1.7e12, stop=1.7e12 + 1).failure
    assert failure.status == "argument"
    assert "time is rounded to 0.000755 s" in str(failure)
