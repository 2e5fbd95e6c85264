"""What the proof conceals: for each bench and effect, its place, its law and how large it may be."""

from tests.proof.effects.concealed import Concealed, Maker
from tests.proof.effects.drive import joint_drive, winding_and_drive
from tests.proof.effects.flight_control import flight_control
from tests.proof.effects.friction import frictions
from tests.proof.effects.laws import laws
from tests.proof.effects.loads import dc_only, loads, screw_only, stop
from tests.proof.effects.sensors import sensors
from tests.proof.effects.three_phase import three_phase

__all__ = ["Concealed", "Maker", "catalogue", "outside"]


def catalogue(bench: str) -> dict[str, Maker]:
    """Effects that may be concealed on a bench, by identifier."""
    if bench == "FlightControl":
        return flight_control()
    made = frictions(bench) | loads(bench) | sensors(bench)
    if bench == "BldcDrive":
        made |= three_phase()
        for absent in ("torque.ripple", "stiffness", "load.constant"):
            del made[absent]
    if bench in ("DcServo", "ScrewEma"):
        made |= winding_and_drive(bench)
    if bench in ("DcServo", "ScrewEma", "Joint"):
        made |= stop(bench)
    if bench == "DcServo":
        made |= dc_only()
    if bench == "ScrewEma":
        made |= screw_only()
    if bench == "Joint":
        made |= joint_drive()
    return made


def outside(bench: str) -> dict[str, Maker]:
    """Laws outside the catalogue that may be concealed on a bench, by name."""
    return {} if bench == "FlightControl" else laws(bench)
