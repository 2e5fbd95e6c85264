"""Lives of parts, by laws that are written here once more: some as in the catalogue, some that it lacks.

A life is the time at which each severity is reached, as a share of the life: severity x (share of the limit) rises
by dx in dt = dx / growth(x), times a factor that wanders and scatters.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

POINTS = 3000
TOP = 1.35  # of the limit, where the simulation of a part ends
KNOWN = ("steady wear", "in proportion", "power law", "play", "settling", "heated winding")
UNKNOWN = ("slow start", "knee", "seasons", "shocks")
SHAPES: dict[str, tuple[tuple[float, float], ...]] = {  # of the laws that have any: ranges, each shape drawn evenly
    "power law": ((1.2, 2.2),),
    "play": ((1.0, 12.0),),
    "settling": ((1.2, 2.5),),
    "heated winding": ((8.0, 35.0),),
    "knee": ((0.25, 0.5), (1.5, 3.0)),
}
NEW = (0.015, 0.09)  # severity of a new part
WANDER = 0.1  # of the logarithm of the rate, over a life
USUAL, SCATTER = 0.02, {"shocks": 0.08}  # of the severity, over growth from 0 to 1
SWING, SWINGS = (0.1, 0.4), 4  # of the logarithm of the rate, and how often a life


@dataclass(frozen=True)
class Life:
    """`time` at which `severity` (share of the limit) is reached; the limit is reached at time 1."""

    law: str
    time: np.ndarray
    severity: np.ndarray
    shape: tuple[float, ...] = ()


def draw(law: str, random: np.random.Generator) -> Life:
    """A part of this law: 1.5 to 9 % of the limit when new, wander of the rate 0.1 a life, scatter 2 %."""
    start = random.uniform(*NEW)
    if law == "seasons":
        return _seasons(start, random)
    x = np.linspace(start, TOP, POINTS)
    shape = tuple(float(random.uniform(*bounds)) for bounds in SHAPES.get(law, ()))
    middle, dx = (x[1:] + x[:-1]) / 2, np.diff(x)
    dt = dx / growth(law, middle, *shape)
    dt *= np.exp(WANDER * np.cumsum(random.standard_normal(len(dt)) * np.sqrt(dt / dt[middle < 1].sum())))
    scale = dx / SCATTER.get(law, USUAL) ** 2  # a gamma process: use that passes while the severity grows by dx
    dt *= random.gamma(scale) / scale
    time = np.concatenate([[0.0], np.cumsum(dt)])
    return Life(law, time / np.interp(1.0, x, time), x, shape)


def growth(law: str, x: np.ndarray, *shape) -> np.ndarray:
    """Of a law at severities x, up to a factor; `shape` as in SHAPES, numbers or arrays like x."""
    if law == "in proportion":
        return x
    if law == "power law":
        return x ** shape[0]
    if law == "play":
        return 1 + shape[0] * x
    if law == "settling":
        return np.maximum(1 - x / shape[0], 0.02)
    if law == "heated winding":
        return np.exp(11600 / 373.15 - 11600 / (373.15 + shape[0] * x))
    if law == "slow start":  # a logistic curve: in proportion to what there is and to what is left
        return np.maximum((0.02 + x) * (1.6 - x), 0.0)
    if law == "knee":
        return np.where(x < shape[0], 1.0, shape[1])
    return np.ones_like(x)  # steady wear and shocks; seasons but for its swing


def _seasons(start: float, random: np.random.Generator) -> Life:
    """Steady wear whose rate swings by a factor of up to 1.5 four times a life."""
    time = np.linspace(0, 3, POINTS)
    rate = np.exp(random.uniform(*SWING) * np.sin(2 * np.pi * (SWINGS * time + random.random())))
    severity = start + np.concatenate([[0.0], np.cumsum(rate[1:] * np.diff(time))])
    keep = severity <= TOP + 0.05
    return Life("seasons", time[keep] / np.interp(1.0, severity, time), severity[keep])
