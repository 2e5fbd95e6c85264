"""How a signature moves with what is not the fault: friction, temperature, supply, inertia, sensors.

Each nuisance is one standard normal number z. The signature is taken as s(z) = s0 + a z + c z^2, with a and c from two
simulations at z = +-1; its covariance about s0 is then a a' + 3 c c' (the fourth moment of z is 3).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from math import exp
import os

import numpy as np

from analysis.chain import Chain, signature
from analysis.errors import AnalysisError
from analysis.plant import Plant, Record
from analysis.settings import Settings


def conditions(settings: Settings) -> list[float]:
    """Levels of the first nuisance, as its normal number, over the whole range of a uniform one: +-sqrt(3)."""
    count = settings.table("assessment")["conditions"]
    return np.linspace(-np.sqrt(3), np.sqrt(3), count).tolist() if count > 1 else [0.0]


def at_level(plant: Plant, settings: Settings, level: float) -> dict[str, float]:
    """The model's parameters at a level of the first nuisance."""
    nuisances = settings.raw.get("nuisances", [])
    return moved(plant, nuisances[0], level) if nuisances else {}


def moved(plant: Plant, nuisance: dict, z: float) -> dict[str, float]:
    """The parameters of a nuisance at its normal number `z`."""
    spread = zip(nuisance["parameters"], nuisance["spread"], strict=True)
    return {name: plant.declared(name) * exp(z * sigma) for name, sigma in spread}


def nuisance_covariances(
    plant: Plant, settings: Settings, severities: Sequence[float], level: float, jobs: int | None = None
) -> np.ndarray:
    """Covariance [severities, n, n] of the signature under all nuisances, at a level of the first one.

    Columns a and c are simulated at every `assessment.every`-th severity and interpolated between.
    """
    chain, every = Chain(settings.text), settings.table("assessment")["every"]
    knots = sorted({*severities[::every], severities[-1]})
    with ThreadPoolExecutor(max_workers=jobs or os.cpu_count()) as pool:
        columns = np.array(list(pool.map(lambda knot: _columns(plant, settings, chain, level, knot), knots)))
    between = _interpolated(np.array(severities), np.array(knots), columns)
    floors = np.full(between.shape[2], settings.table("assessment")["floor"])
    floors[-1] = settings.table("assessment")["frequency_floor"]
    return np.einsum("mqi,mqj->mij", between, between) + np.diag(floors**2)


def _interpolated(at: np.ndarray, knots: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """[knots, q, n] linear in the severity -> [at, q, n]."""
    place = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, len(knots) - 2)
    weight = ((at - knots[place]) / (knots[place + 1] - knots[place]))[:, None, None]
    return (1 - weight) * columns[place] + weight * columns[place + 1]


def _columns(plant: Plant, settings: Settings, chain: Chain, level: float, severity: float) -> np.ndarray:
    """[q, n] columns of one severity: a and sqrt(3) c of each nuisance, then those of the sensors."""
    base = at_level(plant, settings, level)
    record = plant.run(severity, **base)
    centre = _signature(chain, record, record.currents)

    def pair(at: Callable[[int], np.ndarray]) -> list[np.ndarray]:
        plus, minus = at(+1), at(-1)
        return [(plus - minus) / 2, np.sqrt(3) * (plus + minus - 2 * centre) / 2]

    def simulated(nuisance: dict, z: float) -> np.ndarray:
        run = plant.run(severity, **(base | moved(plant, nuisance, z)))
        return _signature(chain, run, run.currents)

    def sensed(channel: int, z: int) -> np.ndarray:
        currents = record.currents.copy()
        currents[channel] += z * settings.table("assessment")["sensor_offset"]
        return _signature(chain, record, currents)

    columns: list[np.ndarray] = []
    for place, nuisance in enumerate(settings.raw.get("nuisances", [])):
        # The first one only has to reach half-way to the next level; the others vary by all of their spread.
        start, reach = (level, _half_step(settings)) if place == 0 else (0.0, 1.0)
        columns += pair(lambda z, nuisance=nuisance, start=start, reach=reach: simulated(nuisance, start + z * reach))
    per_channel = (len(centre) - 1) // len(settings.currents)
    for channel in range(len(settings.currents)):
        columns += pair(lambda z, channel=channel: sensed(channel, z))
        gain = np.zeros_like(centre)  # moves ln(rms) and ln(h1) of its channel, and nothing else
        gain[per_channel * channel : per_channel * channel + 2] = settings.table("assessment")["sensor_gain"]
        columns.append(gain)
    return np.array(columns)


def _half_step(settings: Settings) -> float:
    levels = conditions(settings)
    return (levels[1] - levels[0]) / 2 if len(levels) > 1 else 1.0


def _signature(chain: Chain, record: Record, currents: np.ndarray) -> np.ndarray:
    found = signature(chain.analyse(currents, record.angle))
    if found is None:
        raise AnalysisError("a nuisance leaves no peak in the spectrum of a current: make its spread smaller")
    return found
