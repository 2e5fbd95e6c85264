"""What the whole actuator may hide: effects of the smaller benches, at the places of its own components."""

from dataclasses import replace

import numpy as np

from tests.proof.effects.concealed import Concealed, Maker
from tests.proof.effects.loads import loads, screw_only, stop
from tests.proof.effects.sensors import sensors
from tests.proof.effects.three_phase import three_phase

# Components that turn as one: an effect on one of them cannot be told from the same on another.
MOTOR = ("shaft", "motorBearing", "motorFriction", "gear", "winding")
SURFACE = ("surface", "hinge", "load", "transmission")
ELECTRICAL = ("drive", "drive.bridge", "winding", "supply")


def _at(maker: Maker, scale: float, location: str, accepted: tuple[str, ...]) -> Maker:
    def make(rng: np.random.Generator, size: float) -> Concealed:
        return replace(maker(rng, scale * size), location=location, accept_locations=accepted)

    return make


def _in_phase(maker: Maker, scale: float) -> Maker:
    def make(rng: np.random.Generator, size: float) -> Concealed:
        c = maker(rng, scale * size)
        phase = c.location.removeprefix("winding:")
        return replace(c, accept_locations=(c.location, f"winding.{phase}"))

    return make


def flight_control() -> dict[str, Maker]:
    """Makers by effect. Sizes are those of the small benches, scaled to this machine."""
    screw, phases = screw_only(), three_phase()
    return {
        "backlash": _at(screw["backlash"], 1.0, "transmission", ("transmission", "gear")),
        "friction.load": _at(screw["friction.load"], 1.0, "motorFriction", MOTOR),
        "load.constant": _at(loads("ScrewEma")["load.constant"], 1.0, "surface", SURFACE),
        "stiffness": _at(loads("ScrewEma")["stiffness"], 1.0, "surface", SURFACE),
        "torque.cogging": _at(loads("ScrewEma")["torque.cogging"], 0.5, "shaft", MOTOR),
        "end_stop": _at(stop("ScrewEma")["end_stop"], 1.0, "surface", SURFACE),
        "motor.short_circuit": _in_phase(phases["motor.short_circuit"], 1.5),
        "motor.imbalance": _in_phase(phases["motor.imbalance"], 0.5),
        "drive.dead_time": _at(phases["drive.dead_time"], 2.0, "drive", ELECTRICAL),
        "sensor.offset": sensors("BldcDrive")["sensor.offset"],
    }
