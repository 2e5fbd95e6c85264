"""A variable as FMI has it."""

from __future__ import annotations

from dataclasses import dataclass
import math


@dataclass(frozen=True)
class FmiVariable:
    name: str
    reference: int
    causality: str  # independent | parameter | calculatedParameter | input | output | local
    variability: str  # tunable | discrete | continuous
    type: str = "Real"  # Real | Integer | Boolean
    initial: str = ""  # exact | calculated, "" where FMI has none
    start: float | tuple[float, ...] | None = None  # of an array, one for each element
    unit: str = ""
    quantity: str = ""
    description: str = ""
    min: float = -math.inf
    max: float = math.inf
    nominal: float = 0.0
    derivative_of: int | None = None  # the value reference of the state
    dimensions: tuple[int, ...] = ()  # of an array; () of a scalar
