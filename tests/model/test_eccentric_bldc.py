"""The pre-flight test of the paper: the consistent parameter set gives the numbers it is known for."""

from __future__ import annotations

import numpy as np
import pytest

PHASES = ("a", "b", "c")
OUTPUTS = ["filter[1].y", "filter[2].y", "filter[3].y", "rotor.w", "winding.a.i", "winding.b.i", "winding.c.i"]

# eccentricity: mean RMS (mA), mean speed over the whole second (rad/s)
KNOWN = {0.0: (295.9, 105.19), 0.10: (311.9, None), 0.20: (366.2, None), 0.33: (485.4, 104.10), 0.50: (693.3, 101.84)}


@pytest.mark.parametrize("zeta", KNOWN)
def test_known_currents_and_speeds(run, zeta: float) -> None:
    result = run(
        "Actuators.EccentricBldc",
        parameters={"zeta": zeta},
        solver="dopri5",
        rtol=1e-7,
        outputs=OUTPUTS,
        events=False,
        interval=1e-5,
    )
    rms = {x: 1e3 * np.sqrt(np.mean(result[f"filter[{k}].y"] ** 2)) for k, x in enumerate(PHASES, 1)}
    mean, speed = KNOWN[zeta]
    assert np.mean(list(rms.values())) == pytest.approx(mean, abs=0.06)
    assert rms["a"] < rms["c"] < rms["b"] or zeta == 0
    if speed:
        assert result["rotor.w"].mean() == pytest.approx(speed, abs=0.01)
    total = sum(result[f"winding.{x}.i"] for x in PHASES)
    assert np.abs(total).max() < 1e-9


def test_two_paths_through_the_equations_agree(run) -> None:
    """Residual form by IDA and explicit form by RK4 with located events: every phase RMS to 1e-6."""
    options = {"parameters": {"zeta": 0.33}, "outputs": OUTPUTS, "events": False, "stop": 0.3, "interval": 1e-5}
    ida = run("Actuators.EccentricBldc", rtol=1e-8, **options)
    rk4 = run("Actuators.EccentricBldc", solver="rk4", step=1e-5, **options)
    for name in OUTPUTS[:3]:
        rms = [np.sqrt(np.mean(result[name] ** 2)) for result in (ida, rk4)]
        assert rms[0] == pytest.approx(rms[1], rel=1e-6)


def test_stator_fixed_eccentricity_makes_the_current_of_phase_a_fall(run) -> None:
    """What the paper's figure describes but its equation does not: phase a has the narrow gap."""
    rms = []
    for zeta in (0.0, 0.3):
        parameters = {"zeta": zeta, "convention": 2}
        result = run(
            "Actuators.EccentricBldc",
            parameters=parameters,
            solver="dopri5",
            rtol=1e-7,
            outputs=OUTPUTS,
            events=False,
            interval=1e-5,
        )
        rms.append(np.sqrt(np.mean(result["filter[1].y"] ** 2)))
    assert rms[1] < rms[0]
