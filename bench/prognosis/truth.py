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


@dataclass(frozen=True)
class Life:
    """`time` at which `severity` (share of the limit) is reached; the limit is reached at time 1."""

    law: str
    time: np.ndarray
    severity: np.ndarray
    growth: object = None  # of the known laws: a function of severity, up to a factor


def draw(law: str, random: np.random.Generator) -> Life:
    """A part of this law: 1.5 to 9 % of the limit when new, wander of the rate 0.1 a life, scatter 2 %."""
    start = random.uniform(0.015, 0.09)
    x = np.linspace(start, TOP, POINTS)
    if law == "seasons":
        return _seasons(start, random)
    growth = _growth(law, random, start)
    middle, dx = (x[1:] + x[:-1]) / 2, np.diff(x)
    dt = dx / growth(middle)
    dt *= np.exp(0.1 * np.cumsum(random.standard_normal(len(dt)) * np.sqrt(dt / dt[middle < 1].sum())))
    scatter = 0.08 if law == "shocks" else 0.02
    shape = dx / scatter**2  # a gamma process: use that passes while the severity grows by dx
    dt *= random.gamma(shape) / shape
    time = np.concatenate([[0.0], np.cumsum(dt)])
    return Life(law, time / np.interp(1.0, x, time), x, growth if law in KNOWN else None)


def _growth(law: str, random: np.random.Generator, start: float):
    uniform = random.uniform
    if law == "steady wear" or law == "shocks":
        return lambda x: np.ones_like(x)
    if law == "in proportion":
        return lambda x: x
    if law == "power law":
        m = uniform(1.2, 2.2)
        return lambda x: x**m
    if law == "play":
        c = uniform(1.0, 12.0)
        return lambda x: 1 + c * x
    if law == "settling":
        level = uniform(1.2, 2.5)
        return lambda x: np.maximum(1 - x / level, 0.02)
    if law == "heated winding":
        rise = uniform(8.0, 35.0)
        return lambda x: np.exp(11600 / 373.15 - 11600 / (373.15 + rise * x))
    if law == "slow start":  # a logistic curve: in proportion to what there is and to what is left
        return lambda x: (0.02 + x) * (1.6 - x)
    knee, factor = uniform(0.25, 0.5), uniform(1.5, 3.0)
    return lambda x: np.where(x < knee, 1.0, factor)


def _seasons(start: float, random: np.random.Generator) -> Life:
    """Steady wear whose rate swings by a factor of up to 1.5 four times a life."""
    time = np.linspace(0, 3, POINTS)
    rate = np.exp(uniform_swing(random) * np.sin(2 * np.pi * (4 * time + random.random())))
    severity = start + np.concatenate([[0.0], np.cumsum(rate[1:] * np.diff(time))])
    keep = severity <= TOP + 0.05
    return Life("seasons", time[keep] / np.interp(1.0, severity, time), severity[keep])


def uniform_swing(random: np.random.Generator) -> float:
    return float(random.uniform(0.1, 0.4))
