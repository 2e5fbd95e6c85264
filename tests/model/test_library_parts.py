"""Benches of ours rebuilt from parts of the Modelica Standard Library: the same trajectories."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.search_path import search_path
from lacuna.runtime.model import Model
from lacuna.runtime.simulation import Result, simulate

MODELS = Path(__file__).parents[1] / "models"
SERVO = {"ours.i": "inductor.i", "ours.w": "shaft.w", "ours.theta": "shaft.phi"}
MOTOR = {"ia": "inductor[1].i", "ib": "inductor[2].i", "w": "shaft.w", "th": "shaft.phi"}
ACTUATOR = {
    "ours.surface.phi": "surface.phi", "ours.surface.w": "surface.w", "ours.rotor.w": "rotor.w",
    "ours.winding.a.i": "inductor[1].i", "ours.winding.b.i": "inductor[2].i", "ours.controller.x": "integral.y",
    "ours.drive.x": "drive.x",
}  # fmt: skip


def of_parts(name: str, shared: Path) -> Model:
    library = shared / "msl"
    if not library.is_dir():
        pytest.skip(f"needs the Modelica Standard Library; not at {library}")
    return Model(compile_model(str(MODELS / "library" / f"{name}.mo"), search_path=search_path([library])).path)


def run(name: str, shared: Path) -> Result:
    """A model of parts, at even times: what happens at an event is another matter."""
    result = simulate(of_parts(name, shared), interval=0.001, events=False)
    assert result.complete, result.failure
    return result


def check(ours: Result, theirs: Result, pairs: dict[str, str]) -> None:
    """Each pair is the same to a millionth of its range."""
    for mine, other in pairs.items():
        size = np.ptp(theirs[other])
        assert size > 0
        assert np.max(np.abs(ours[mine] - theirs[other])) <= 1e-6 * size, mine


def test_a_servo_of_library_parts_moves_like_ours(shared: Path) -> None:
    result = run("DcServoOfParts", shared)
    check(result, result, SERVO)


def test_a_motor_of_library_parts_runs_like_t2(shared: Path) -> None:
    """Resistors, inductors and signal voltages in star, a torque on an inertia with a damper: 116 commutations."""
    theirs = run("SixStepMotorOfParts", shared)
    compiled = compile_model(str(MODELS / "SixStepMotor.mo"))
    ours = simulate(Model(compiled.path), stop=0.2, interval=0.001, rtol=1e-9, events=False)
    check(ours, theirs, MOTOR)


def test_an_actuator_of_library_parts_moves_like_ours(shared: Path) -> None:
    """Control of blocks, bus and windings of Analog, two masses of Rotational with friction that sticks. The inverter's
    averaged legs and the Hall sensor are ours: the library has none of that law. The friction of the reducer that
    grows with its load (mu) is left out on both sides, for the same reason."""
    result = run("FlightControlOfParts", shared)
    check(result, result, ACTUATOR)


def test_what_sticks_stands_still_at_any_tolerance(shared: Path) -> None:
    """The library's friction compares its speed with a limit of 1e10 rad/s that is switched off: it must not be the
    measure of the guards. Nor may rounding of its linear equations pass for a jump that restarts the solver."""
    model = of_parts("FlightControlOfParts", shared)
    restarts = simulate(model, solver="dopri5", rtol=1e-10).counters["restarts"]
    for rtol in (1e-9, 1e-10, 1e-11):
        result = simulate(model, rtol=rtol)
        assert result.complete, result.failure
        for part, speed in (("hingeFriction", 1), ("motorFriction", 160)):
            stuck = result[f"{part}.mode"] == 0
            assert stuck.sum() > 20
            assert np.abs(result[f"{part}.w"][stuck]).max() < 1e-9 * speed
        assert result.counters["restarts"] <= 1.05 * restarts
