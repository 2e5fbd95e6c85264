"""The whole actuator, with continuous control, against the clock."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from bench.generated import ATOL, LANES, RTOL, Lane, error_against
from bench.timing import take_turns
from lacuna import runtime
from lacuna.codegen.compile import compile_model

# Model, seconds simulated. The step saturates the drive, the slow sine sticks and slips, the reversal crosses the play.
SCENARIOS = {
    "step": ("Actuators.FlightControlEma", 0.5),
    "slow sine": ("Actuators.Scenarios.SlowSine", 2.0),
    "reversal": ("Actuators.Scenarios.Reversal", 0.5),
}
SIGNALS = ("rotor.w", "surface.phi")  # compared with a run at 1e-10
INTERVAL = 1e-3  # s, of the output
VARIABLE = tuple(lane for lane in LANES if lane.step is None)
GOAL = {"ida": 20.0, "dopri5": 100.0}  # seconds simulated over seconds of computing


def against_the_clock(rounds: int) -> list[dict[str, object]]:
    """One row a scenario and lane."""
    return [row for name in SCENARIOS for row in _scenario(name, rounds)]


def _scenario(name: str, rounds: int) -> list[dict[str, object]]:
    model_name, stop = SCENARIOS[name]
    model = runtime.Model(compile_model(model_name).path)
    reference = _run(model, stop, "ida", 1e-10, 1e-12)
    expected = {signal: reference[signal] for signal in SIGNALS}
    lanes: dict[Lane, Callable[[], runtime.Result]] = {
        lane: lambda lane=lane: _run(model, stop, lane.solver, RTOL, ATOL) for lane in VARIABLE
    }
    timings = take_turns({lane.label: run for lane, run in lanes.items()}, rounds)
    return [_row(name, stop, lane, run(), timings[lane.label].seconds, expected) for lane, run in lanes.items()]


def _run(model: runtime.Model, stop: float, solver: str, rtol: float, atol: float) -> runtime.Result:
    result = runtime.simulate(
        model, solver=solver, rtol=rtol, atol=atol, stop=stop, interval=INTERVAL, outputs=SIGNALS, events=False
    )
    if not result.complete:
        raise RuntimeError(f"{model.name} with {solver}: {result.failure}")
    return result


def _row(
    name: str, stop: float, lane: Lane, result: runtime.Result, seconds: float, expected: dict[str, np.ndarray]
) -> dict[str, object]:
    counters = result.counters
    return {
        "scenario": name,
        "lane": lane.solver,
        "times real time": stop / seconds,
        "goal": GOAL.get(lane.solver),
        "ms": 1e3 * seconds,
        "error": error_against(expected, {signal: result[signal] for signal in expected}),
        "steps": counters["steps"],
        "events": counters["state_events"] + counters["time_events"] + counters["sample_events"],
    }
