"""The program over IDAS, written by hand, is a second witness of T1's sensitivities, jumps included."""

from __future__ import annotations

import numpy as np
import pytest

from bench.by_hand import T1
from bench.by_hand.sensitive import PARAMETERS, with_idas
from bench.generated import model_file
from lacuna import runtime
from lacuna.codegen.compile import compile_model

RTOL = 1e-8
# BDF adds up the errors of its steps: at this tolerance, some hundred times it over the 200 events of the run.
BOUND = 1e-5


@pytest.fixture(scope="module")
def by_hand() -> np.ndarray:
    """[points, parameters, states]"""
    return with_idas(RTOL, 0.01 * RTOL)[1]


@pytest.mark.parametrize("solver", ["dopri5", "ida"])
def test_generated_and_by_hand_agree_through_two_hundred_events(solver: str, by_hand: np.ndarray) -> None:
    model = runtime.Model(compile_model(str(model_file(T1)), sensitivities=True).path)
    result = runtime.simulate(
        model, solver=solver, rtol=RTOL, stop=T1.stop, interval=T1.interval, outputs=T1.states, events=False,
        sensitivities=PARAMETERS,
    )  # fmt: skip
    assert result.complete, result.failure
    assert result.flags == []
    # Rows at a reversal of the supply, where a grid point is on either side of the event.
    instants = np.array([e.time for e in result.event_log])
    clear = np.array([np.abs(instants - t).min() > 1e-6 for t in result.time])
    for k, parameter in enumerate(PARAMETERS):
        for j, state in enumerate(T1.states):
            expected, found = by_hand[clear, k, j], result.sensitivity(state, parameter)[clear]
            assert np.abs(found - expected).max() <= BOUND * np.abs(expected).max(), (parameter, state)
