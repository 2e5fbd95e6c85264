"""How IDA starts after an event, and what its Newton method leaves of the tolerance."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from tests.events.models import compiled

MOTOR = Path(__file__).parents[1] / "models/SixStepMotor.mo"


def test_after_an_event_it_goes_on_with_order_and_step_of_a_smooth_run() -> None:
    """From order 1 it took 73 steps from commutation to commutation, with twice the tolerance: some thirty of orders 1
    to 4."""
    model = runtime.Model(compile_model(str(MOTOR)).path)
    result = runtime.simulate(model, solver="ida", rtol=1e-6, stop=0.1, interval=1e-3)
    assert result.complete, result.failure
    assert result.counters["restarts"] == 52
    assert result.counters["steps"] < 66 * result.counters["restarts"]


TURNS = """model Turns "Two states follow what moves, as fast as a direction that turns lets them"
  parameter Real k = 20, r = 3;
  Real a(start = 1, fixed = true), b(start = 0, fixed = true), off;
equation
  off = cos(r*time)*(a - cos(9*time)) + sin(r*time)*(b - sin(5*time));
  der(a) = -k*cos(r*time)*off;
  der(b) = -k*sin(r*time)*off;
end Turns;
"""


def test_a_matrix_that_gets_old_costs_no_accuracy(tmp_path: Path) -> None:
    """Steps of one size never asked for another matrix, nor measured how fast Newton's method still converged: errors
    were twice those of the steps."""
    model = compiled(tmp_path, TURNS)
    truth = runtime.simulate(model, solver="dopri5", rtol=1e-11, stop=10.0, interval=0.01)
    result = runtime.simulate(model, solver="ida", rtol=1e-6, stop=10.0, interval=0.01)
    assert max(np.abs(result[x] - truth[x]).max() for x in "ab") < 1.5e-6
    assert result.counters["newton_iterations"] < 1.1 * result.counters["steps"]


STIFF = """model Stiff "A fast state beside a slow one, thrown off its balance every now and then"
  parameter Real k = 1e7;
  Real slow(start = 1, fixed = true), fast(start = 1, fixed = true);
equation
  der(slow) = -slow + fast;
  der(fast) = -k*(fast - cos(time));
  when sample(0.5, 0.5) then
    reinit(fast, pre(fast) + 1e-3);
  end when;
end Stiff;
"""


@pytest.mark.parametrize("max_step", [None, 1e-3])
def test_where_an_explicit_start_is_no_good_it_starts_by_itself(tmp_path: Path, max_step: float | None) -> None:
    model = compiled(tmp_path, STIFF)
    result = runtime.simulate(model, solver="ida", rtol=1e-6, stop=3.0, interval=0, max_step=max_step)
    assert result.complete, result.failure
    assert result.counters["steps"] < 70 * result.counters["restarts"] or max_step
    assert np.diff(result.time).max() <= (max_step or 1) * (1 + 1e-9)
    settled = result.time % 0.5 > 1e-5
    assert np.abs(result["fast"] - np.cos(result.time))[settled].max() < 3e-6
