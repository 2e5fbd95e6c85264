"""Every effect of the vocabulary attaches wherever it may sit on every bench, and vanishes when it is small."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from codegen.compile import compile_model
from codegen.flatten import flatten
from codegen.library import Library
from discovery import catalogue, places
from discovery.amend import Amendment, Attachment
from discovery.cases import Signal
from discovery.hypotheses import enumerate_attachments
from runtime import Model, RecordedInput, simulate

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
    """What the enumeration asks of a case: its outputs and the interval of its samples."""

    def __init__(self, bench: str) -> None:
        self.fit = [_Recording()]
        self.outputs = [Signal(n, "output", n, u, u, 1.0) for n, u in OUTPUTS[bench].items()]


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
    "DriveDelay": {"T_d": 1e-3},
    "TorqueDelay": {"T_d": 1e-3},
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
