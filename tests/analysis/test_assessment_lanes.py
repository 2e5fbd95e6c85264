"""Recordings by other solvers, rates and actuators of model/, assessed on a map of the hand-written simulation."""

from __future__ import annotations

import numpy as np
import pytest

from lacuna import runtime
from lacuna.analysis.recording.recordings import Refusal
from lacuna.analysis.severity.assessment import assess
from lacuna.codegen.compile import compile_model

CURRENTS = [f"filter[{k}].y" for k in (1, 2, 3)]
STEP = 20 / 2**12  # A, of a 12-bit converter over +-10 A


def recorded(path, model, solver, rate, seed=None, **parameters):
    """A CSV file of one second; with `seed`, noisy and converted."""
    step = {"step": 1e-5} if solver == "rk4" else {"rtol": 1e-6, "atol": 1e-8}
    result = runtime.simulate(
        runtime.Model(compile_model(model).path), solver=solver, parameters=parameters, stop=1.0,
        output_times=np.arange(rate) / rate, outputs=CURRENTS, events=False, **step,
    )  # fmt: skip
    currents = np.array([result[name] for name in CURRENTS])
    if seed is not None:
        noisy = currents + 0.02 * np.random.default_rng(seed).normal(size=currents.shape)
        currents = STEP * np.round(noisy / STEP)
    rows = np.vstack([np.arange(rate) / rate, currents]).T
    np.savetxt(path, rows, delimiter=",", fmt="%.9g", header=",".join(["time", *CURRENTS]), comments="")
    return path


@pytest.mark.parametrize("zeta", [0.08, 0.3])
@pytest.mark.parametrize("rate", [20000, 50000])
def test_rk4_noisy_and_12_bit_is_read_as_well_as_ida(tmp_path, map_folder, zeta, rate):
    model = "Lacuna.Actuators.EccentricBldc"
    by_ida = assess(recorded(tmp_path / "ida.csv", model, "ida", 100000, zeta=zeta), map_folder).estimate
    by_rk4 = assess(recorded(tmp_path / "rk4.csv", model, "rk4", rate, seed=7, zeta=zeta), map_folder).estimate
    assert by_ida.severity == pytest.approx(zeta, abs=0.005)
    assert by_rk4.severity == pytest.approx(zeta, abs=0.005)
    assert by_rk4.severity == pytest.approx(by_ida.severity, abs=0.003)


def test_play_and_transducer_that_the_map_lacks_are_read_within_their_interval(tmp_path, map_folder):
    path = recorded(tmp_path / "r.csv", "Lacuna.Actuators.PreflightEma", "dopri5", 20000, seed=3, zeta=0.3, offset=0.02)
    found = assess(path, map_folder).estimate
    assert found.severity == pytest.approx(0.3, abs=0.01)
    assert found.low <= 0.3 <= found.high


def test_the_second_actuator_is_refused(tmp_path, map_folder):
    path = recorded(tmp_path / "r.csv", "Lacuna.Actuators.BallScrewEma", "dopri5", 20000)
    with pytest.raises(Refusal, match=r"no severity of the map explains|not those of this test|no peak"):
        assess(path, map_folder)
