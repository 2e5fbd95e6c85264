"""Every effect of the vocabulary attaches wherever it may sit on every bench, and vanishes when it is small."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.signals import Signal
from lacuna.discovery.catalogue import catalogue, places
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.runtime import Model, RecordedInput, simulate

FRICTIONS = {
    f"friction.{law}" for law in ("viscous", "coulomb", "asymmetric", "stribeck", "presliding", "load", "position")
}
SHAFT = FRICTIONS | {
    "drag.quadratic", "backlash", "compliance", "end_stop", "stiffness",
    "load.constant", "load.gravity", "torque.cogging",
}  # fmt: skip
DC = {"torque.ripple", "motor.saturation", "motor.heating", "motor.iron_loss"} | {
    f"drive.{law}" for law in ("dead_time", "supply_sag", "saturation", "deadband", "delay")
}
STAR = {"motor.eccentricity", "motor.short_circuit", "motor.imbalance", "motor.heating", "torque.ripple"} | {
    "drive.dead_time", "drive.supply_sag",
}  # fmt: skip
SENSORS = {"sensor.offset", "sensor.gain", "sensor.lag"}
ANGLES = {"sensor.once_per_rev"}
OUTPUTS = {
    "DcServo": {"i": "A", "w": "rad/s", "theta": "rad"},
    "ScrewEma": {"u": "V", "i": "A", "thm": "rad", "ths": "rad"},
    "BldcDrive": {"ia": "A", "ib": "A", "ic": "A", "theta": "rad"},
    "FrictionDevice": {"F": "N"},
    "Joint": {"w": "rad/s", "theta": "rad"},
    "FlightControl": {"ia": "A", "thm": "rad", "ths": "rad"},
}
EXPECTED = {
    "DcServo": SHAFT | DC | SENSORS | ANGLES,
    "ScrewEma": SHAFT | DC | SENSORS | ANGLES,
    "BldcDrive": SHAFT | STAR | SENSORS | ANGLES,
    "FlightControl": SHAFT | STAR | SENSORS | ANGLES,
    "Joint": SHAFT | SENSORS | ANGLES | {"drive.saturation", "drive.deadband", "drive.delay"},
    "FrictionDevice": FRICTIONS - {"friction.viscous", "friction.load"}
    | {"drag.quadratic", "backlash", "end_stop", "stiffness", "load.constant", "sensor.gain", "sensor.lag"},
}


@dataclass(frozen=True)
class _Recording:
    interval: float = 1e-3


class _Case:
    """What the enumeration asks of a case: what it records and the interval of its samples."""

    def __init__(self, bench: str) -> None:
        self.fit = [_Recording()]
        self.outputs = [Signal(n, "output", n, u, u, 1.0) for n, u in OUTPUTS[bench].items()]
        self.signals = {s.column: s for s in self.outputs}


@pytest.fixture(scope="module")
def library() -> Library:
    return Library()


@pytest.fixture(scope="module")
def effects(library: Library) -> list[catalogue.Effect]:
    return catalogue.read(library)


def _attachments(library: Library, effects: list[catalogue.Effect], bench: str) -> tuple[Amendment, list[Attachment]]:
    plain = Amendment(places.read(library, f"Benches.{bench}"))
    found = enumerate_attachments(_Case(bench), plain.structure, effects, plain)
    return plain, list({(a.effect.name, a.location, a.signals): a for a in found}.values())


def _write(plain: Amendment, attachment: Attachment, folder: Path, number: int) -> Path:
    path = folder / f"Amended{number}.mo"
    path.write_text(Amendment(plain.structure, [attachment]).text(path.stem), encoding="utf-8")
    return path


@pytest.mark.parametrize("bench", EXPECTED)
def test_every_effect_attaches_wherever_it_may_sit(
    library: Library, effects: list[catalogue.Effect], bench: str, tmp_path: Path
) -> None:
    plain, attachments = _attachments(library, effects, bench)
    assert {a.effect.identifier for a in attachments} >= EXPECTED[bench]
    assert not [a.label for a in attachments if a.location == "load"], "a load is no drive"
    if bench == "FlightControl":  # its places are those of the smaller benches; a few suffice
        attachments = [a for a in attachments if a.effect.name in ("Compliance", "ShortCircuit", "BusResistance")]
    for number, attachment in enumerate(attachments):
        flat = flatten(library, str(_write(plain, attachment, tmp_path, number)))
        assert any(v.startswith(f"{attachment.component}.") for v in flat.variables), attachment.label


SMALL = {  # parameters with which an effect leaves hardly anything
    "Compliance": {"c": 1e3, "d": 1e-4, "share": 0.1},
    "ShaftBacklash": {"play": 0.0, "c": 1e3, "d": 1e-4, "share": 0.1},
    "DriveDelay": {"T_d": 0.0},
    "TorqueDelay": {"T_d": 0.0},
}


@pytest.mark.parametrize(
    ("bench", "name"),
    [("DcServo", "Compliance"), ("DcServo", "ShaftBacklash"), ("DcServo", "IronLoss"), ("DcServo", "DriveDelay"),
     ("Joint", "TorqueDelay"), ("FrictionDevice", "ImposedBand")],
)  # fmt: skip
def test_a_small_effect_leaves_the_bench_as_it_was(
    library: Library, effects: list[catalogue.Effect], bench: str, name: str, tmp_path: Path
) -> None:
    plain, attachments = _attachments(library, effects, bench)
    attachment = next(a for a in attachments if a.effect.name == name)
    values = attachment.effect.neutral | SMALL.get(name, {})
    parameters = {attachment.full_name(n): v for n, v in values.items()}
    before = _response(f"Benches.{bench}", bench, {})
    after = _response(str(_write(plain, attachment, tmp_path, 0)), bench, parameters)
    assert after == pytest.approx(before, abs=0.02 * float(np.ptp(before)))


@pytest.mark.parametrize("delay", [0.0, 0.4e-3, 1e-3, 3.3e-3])
def test_a_delayed_command_is_the_command_recorded_later(
    library: Library, effects: list[catalogue.Effect], delay: float, tmp_path: Path
) -> None:
    """Against the believed model, whose command is written that much later: exact between samples, and within one."""
    plain, attachments = _attachments(library, effects, "ScrewEma")
    attachment = next(a for a in attachments if a.effect.name == "CommandDelay")
    assert (attachment.effect.identifier, attachment.location) == ("drive.delay", "drive")
    time = np.arange(301) * 1e-3
    command = RecordedInput(time, 0.02 + 0.01 * np.sin(40 * time))
    later = RecordedInput(np.append(0.0, time + delay + 1e-12), np.append(0.02, command.values))
    values = {attachment.full_name("T_d"): delay, attachment.full_name("interval"): 1e-3}
    delayed = _surface(str(_write(plain, attachment, tmp_path, 0)), command, values)
    assert delayed == pytest.approx(_surface("Benches.ScrewEma", later, {}), abs=1e-6 * float(np.ptp(delayed)))


@pytest.mark.parametrize("delay", [0.0, 0.4e-3, 7.3e-3, 63e-3])
def test_a_late_sensor_reads_what_was(
    library: Library, effects: list[catalogue.Effect], delay: float, tmp_path: Path
) -> None:
    """Samples 1 ms apart of a sine of 30 rad/s: a straight line between two of them is off by (0.03)^2 / 8 = 1.1e-4."""
    reading, true, time = _read(library, effects, "SensorDelay", {"T_d": delay, "interval": 1e-3}, tmp_path)
    was = np.interp(np.maximum(time - delay, 0.0), time, true)
    assert reading == pytest.approx(was, abs=2 * 1.2e-4 * float(np.ptp(true)))


def test_a_sensor_is_not_later_than_what_it_keeps(
    library: Library, effects: list[catalogue.Effect], tmp_path: Path
) -> None:
    with pytest.raises(AssertionError, match="The delay is longer than what is kept"):
        _read(library, effects, "SensorDelay", {"T_d": 64e-3, "interval": 1e-3}, tmp_path)


def test_a_sensor_may_be_off_in_scale_and_zero(
    library: Library, effects: list[catalogue.Effect], tmp_path: Path
) -> None:
    """As one of a temperature that is right at 25 degC alone."""
    values = {"gain": 0.88, "offset": 0.12 * 298}
    reading, true, _ = _read(library, effects, "SensorCalibration", values, tmp_path)
    assert reading == pytest.approx(298 + 0.88 * (true - 298), rel=1e-12)


def _read(
    library: Library, effects: list[catalogue.Effect], name: str, values: dict[str, float], tmp_path: Path
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What a sensor of the servo reads with an error, what is there, and when (n,)."""
    plain, attachments = _attachments(library, effects, "DcServo")
    attachment = next(a for a in attachments if a.effect.name == name)
    assert attachment.location == f"sensor:{attachment.variable}"
    time = np.arange(501) * 1e-3
    values = {attachment.full_name(n): v for n, v in values.items()}
    result = simulate(
        Model(compile_model(str(_write(plain, attachment, tmp_path, 0))).path), solver="dopri5", parameters=values,
        stop=0.5, output_times=time, inputs={"u": RecordedInput(time, 6 * np.sin(30 * time))}, events=False, rtol=1e-9,
        outputs=[attachment.full_name("y"), attachment.variable],
    )  # fmt: skip
    assert result.complete, str(result.failure)
    return np.array(result[attachment.full_name("y")]), np.array(result[attachment.variable]), time


def _surface(model: str, command: RecordedInput, parameters: dict[str, float]) -> np.ndarray:
    """The surface of the servo (n,) as it follows a command, without load."""
    time = np.arange(301) * 1e-3
    result = simulate(
        Model(compile_model(model).path), solver="dopri5", parameters=parameters, stop=0.3, output_times=time,
        inputs={"theta_cmd": command, "T_aero": RecordedInput(time, np.zeros(301))}, outputs=["ths"], events=False,
        rtol=1e-9,
    )  # fmt: skip
    return np.array(result["ths"])


def _response(model: str, bench: str, parameters: dict[str, float]) -> np.ndarray:
    """The first output of a bench (n,) under slow sines on its inputs."""
    machine = Model(compile_model(model).path)
    time = np.arange(1000) * 1e-3
    sizes = {"DcServo": {"u": 6.0}, "Joint": {"tau": 0.01}, "FrictionDevice": {"x": 0.01, "v": 0.03}}[bench]
    inputs = {n: RecordedInput(time, a * np.sin(6 * time)) for n, a in sizes.items()}
    output = next(iter(OUTPUTS[bench]))
    result = simulate(
        machine, solver="dopri5", parameters=parameters, inputs=inputs, stop=0.999, output_times=time, outputs=[output],
        events=False,
    )  # fmt: skip
    return np.array(result[output])
