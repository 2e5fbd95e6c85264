"""What a concealed effect is made of.

A maker takes the random generator and a size (1 = nominal) and returns the concealed thing. Sizes are tuned by the
generator until the believed model's misfit is of the wanted order.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Concealed:
    """One piece of physics in the data and not in the model.

    `kernel` are parameters of the simulator, `parameters` those of the truth (value, unit, other names); the sensor
    fields name the signal that they spoil.
    """

    effect: str
    location: str
    kernel: Mapping[str, float] = field(default_factory=dict)
    parameters: Mapping[str, tuple] = field(default_factory=dict)
    accept_locations: tuple[str, ...] = ()
    accept_effects: tuple[str, ...] = ()
    law: str = ""
    outside_vocabulary: bool = False
    delay: float = 0.0
    lag: Mapping[str, float] = field(default_factory=dict)
    offset: Mapping[str, float] = field(default_factory=dict)
    gain: Mapping[str, float] = field(default_factory=dict)
    once_per_rev: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    needs: tuple[str, ...] = ()  # outputs without which the effect cannot be seen
    lacks: tuple[str, ...] = ()  # outputs that would drown it
    stop_share: float = 0.0  # where an end stop stands, over the farthest angle reached without it


Maker = Callable[[np.random.Generator, float], Concealed]

# Nominal sizes: of a torque (N.m or N), a speed and an angle of the place where a friction or load acts.
NOMINAL = {
    "DcServo": {"t": 0.0016, "w": 60.0, "a": 1.0},
    "Joint": {"t": 0.004, "w": 40.0, "a": 1.0},
    "ScrewEma": {"t": 0.03, "w": 60.0, "a": 1.0},
    "BldcDrive": {"t": 0.03, "w": 80.0, "a": 1.0},
    "FrictionDevice": {"t": 6000.0, "w": 0.08, "a": 0.01},
}


def value(size: float, unit: str, *aliases: str) -> tuple:
    """A parameter of the truth: its value, its unit and the other names that it may be found under."""
    return (size, unit, aliases)
