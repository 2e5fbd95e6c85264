"""Sensitivities of the machines against extrapolated centred differences of whole runs at frozen event order.

Both perturbed runs must have the events of the nominal one, in its order; where they do not, the perturbation shrinks.
Rows between the two perturbed instants of an event are left out: there a difference mixes both sides of a jump.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model

ROOT = Path(__file__).parents[2]
BOUND = 1e-5  # of the largest value of each sensitivity
RTOL, REFERENCE_RTOL = 1e-9, 1e-13
ROWS = 300
EMA = ["R", "L", "Ke", "Jm", "bm", "tau_m", "V", "Js", "bs", "tau_s", "k", "controller.Kp"]
CASES = {
    "T1": ("tests/models/SquareWaveServo.mo", ["R", "L", "Ke", "J", "b", "tauc", "U"], ("i", "w"), 0.5),
    "T2": ("tests/models/SixStepMotor.mo", ["R", "L", "Ke", "J", "B", "V"], ("ia", "w", "th"), 0.03),
    "FlightControlEma": ("Actuators.FlightControlEma", EMA, ("rotor.w", "surface.phi"), 0.1),
}


@lru_cache(maxsize=4)
def model(name: str) -> runtime.Model:
    return runtime.Model(compile_model(str(ROOT / name) if name.endswith(".mo") else name, sensitivities=True).path)


def order(result: runtime.Result) -> list[tuple]:
    assert result.complete, result.failure
    return [(e.kind, e.index, e.direction) for e in result.event_log]


class Differences:
    """d output / d parameter by whole runs."""

    def __init__(self, name: str, outputs: Sequence[str], stop: float, nominal: runtime.Result):
        self._model, self._stop, self._nominal = model(name), stop, nominal
        self._session = runtime.Session(
            self._model, solver="dopri5", rtol=REFERENCE_RTOL, outputs=outputs, output_times=nominal.time, events=False
        )
        self._order = order(nominal)

    def _pair(self, parameter: str, step: float) -> list[runtime.Result] | None:
        value = self._model.variables[parameter].start
        pair = [self._session.run({parameter: value + sign * step}, stop=self._stop) for sign in (1, -1)]
        return pair if all(order(r) == self._order for r in pair) else None

    def __call__(self, parameter: str) -> tuple[runtime.Result, runtime.Result, runtime.Result, runtime.Result, float]:
        step = 1e-3 * abs(self._model.variables[parameter].start)
        for _ in range(10):
            wide, narrow = self._pair(parameter, step), self._pair(parameter, step / 2)
            if wide and narrow:
                return (*wide, *narrow, step)
            step /= 4
        raise AssertionError(f"the events change their order with the smallest change of {parameter}")

    def between_events(self, parameter: str, output: str) -> tuple[np.ndarray, np.ndarray]:
        """(extrapolated difference, whether the row is clear of events)."""
        up, down, up_half, down_half, step = self(parameter)
        instants = [np.array([e.time for e in r.event_log]) for r in (up, down)]
        clear = np.ones(len(up.time), dtype=bool)
        for first, last in zip(np.minimum(*instants), np.maximum(*instants), strict=True):
            clear &= (up.time < first - 1e-12) | (up.time > last + 1e-12)
        wide, narrow = ((a[output] - b[output]) / h for a, b, h in ((up, down, 2 * step), (up_half, down_half, step)))
        return (4 * narrow - wide) / 3, clear


@pytest.mark.parametrize("solver", ["dopri5", "ida"])
@pytest.mark.parametrize("case", CASES)
def test_between_events_they_equal_extrapolated_differences(case: str, solver: str) -> None:
    name, parameters, outputs, stop = CASES[case]
    result = runtime.simulate(
        model(name), solver=solver, rtol=RTOL, stop=stop, interval=stop / ROWS, outputs=outputs, events=False,
        sensitivities=parameters,
    )  # fmt: skip
    assert result.flags == []
    differences = Differences(name, outputs, stop, result)
    assert sum(kind == "state" for kind, _, _ in order(result)) >= 3  # jumps are in it
    for parameter in parameters:
        for output in outputs:
            expected, clear = differences.between_events(parameter, output)
            error = np.abs(result.sensitivity(output, parameter) - expected)[clear].max()
            assert clear.sum() > 0.8 * ROWS
            assert error <= BOUND * np.abs(expected[clear]).max(), (parameter, output)
