"""How a signature moves with what is not the fault: friction, temperature, supply, inertia, play, sensors.

Each nuisance is one number z of mean 0 and variance 1, uniform over +-sqrt(3). The signature is taken as quadratic,

    s(z) = s0 + sum_i (a_i z_i + c_i z_i^2) + sum_{i<j} d_ij z_i z_j,

with the columns a, c, d from simulations at z = +-1 and at the corners z_i = z_j = 1. As 1, z_i, z_i^2 - 1 and z_i z_j
are uncorrelated and the fourth moment of z is 9/5, the mean square of s(z) about s0, which is called its covariance, is

    sum a a' + 4/5 sum c c' + sum d d' + (sum c)(sum c)'.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import combinations
import os

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.map.plant import Plant
from lacuna.analysis.settings import Settings
from lacuna.analysis.spectra.chain import Chain, signature


def conditions(count: int) -> list[float]:
    """Levels of the first nuisance over its whole range, each in the middle of an equal share of it."""
    return (np.sqrt(3) * (2 * np.arange(count) + 1 - count) / count).tolist()


def moved(plant: Plant, nuisance: dict, z):
    """Parameters by name at a nuisance's number `z`, or an array of them: `spread` of their logarithms, or `shift`."""
    if "shift" in nuisance:
        steps = zip(nuisance["parameters"], nuisance["shift"], strict=True)
        return {name: plant.undisturbed(name) + z * step for name, step in steps}
    spread = zip(nuisance["parameters"], nuisance["spread"], strict=True)
    return {name: plant.undisturbed(name) * np.exp(z * sigma) for name, sigma in spread}


def require_nuisances(plant: Plant, settings: Settings) -> None:
    """Raises AnalysisError, before anything is simulated, where one moves what it cannot."""
    for nuisance in settings.nuisances:
        moved(plant, nuisance, 0.0)


@dataclass(frozen=True)
class Surroundings:
    """The nuisances and sensors of a test of `plant`; the first nuisance within a share of its range about a level."""

    plant: Plant
    settings: Settings
    chain: Chain
    nuisances: list[dict]
    level: float = 0.0
    share: float = 1.0

    def parameters(self, z: Sequence[float] = ()) -> dict[str, float]:
        """Of the plant; the first z is measured from the level."""
        values: dict[str, float] = {}
        for k, nuisance in enumerate(self.nuisances):
            own = z[k] if k < len(z) else 0.0
            values |= moved(self.plant, nuisance, self.level + self.share * own if k == 0 else own)
        return values

    def signature(self, fault: dict[str, float], z: Sequence[float] = ()) -> np.ndarray:
        return self.of(self.currents(fault, z))

    def currents(self, fault: dict[str, float], z: Sequence[float] = ()) -> np.ndarray:
        values = self.parameters(z) | fault
        return self.plant.run(values.pop(self.settings.fault.parameter), **values).currents

    def of(self, currents: np.ndarray) -> np.ndarray:
        found = signature(self.chain.analyse(currents))
        if found is None:
            raise AnalysisError("a nuisance leaves no peak in the spectrum of a current: make its spread smaller")
        return found

    def covariance(self, fault: dict[str, float]) -> np.ndarray:
        """[n, n] about the undisturbed signature, by 1 + 2 q + q (q - 1)/2 simulations for q nuisances."""
        currents, unit = self.currents(fault), np.eye(len(self.nuisances))
        centre = self.of(currents)
        plus, minus = (
            np.reshape([self.signature(fault, side * z) for z in unit], (-1, len(centre))) for side in (1, -1)
        )
        odd, even = (plus - minus) / 2, (plus + minus) / 2 - centre
        pairs = list(combinations(range(len(unit)), 2))
        joint = [self.signature(fault, unit[i] + unit[j]) - plus[i] - plus[j] + centre for i, j in pairs]
        curved = [*(np.sqrt(0.8) * even), even.sum(axis=0)]
        columns = np.array([*odd, *curved, *joint, *self._sensors(currents, centre)])
        table = self.settings.table("assessment")
        floors = np.full(len(centre), table["floor"])
        floors[-1] = table["frequency_floor"]
        return columns.T @ columns + np.diag(floors**2)

    def _sensors(self, currents: np.ndarray, centre: np.ndarray) -> list[np.ndarray]:
        """Columns of the offset and the gain of each channel."""
        table, columns = self.settings.table("assessment"), []
        per_channel = (len(centre) - 1) // len(currents)
        for channel in range(len(currents)):
            offset = np.zeros((len(currents), 1))
            offset[channel] = table["sensor_offset"]
            plus, minus = self.of(currents + offset), self.of(currents - offset)
            gain = np.zeros_like(centre)  # moves ln(rms) and ln(h1) of its channel, and nothing else
            gain[per_channel * channel : per_channel * channel + 2] = table["sensor_gain"]
            columns += [(plus - minus) / 2, np.sqrt(1.8) * ((plus + minus) / 2 - centre), gain]
        return columns


def covariances(about: Surroundings, severities: Sequence[float], jobs: int | None = None) -> np.ndarray:
    """[severities, n, n] of the signature under all nuisances and sensors, simulated at every `assessment.every`-th
    severity and interpolated between."""
    every, fault = about.settings.table("assessment")["every"], about.settings.fault.parameter
    knots = sorted({*severities[::every], severities[-1]})
    with ThreadPoolExecutor(max_workers=jobs or os.cpu_count()) as pool:
        found = np.array(list(pool.map(lambda knot: about.covariance({fault: knot}), knots)))
    return _interpolated(np.array(severities), np.array(knots), found)


def _interpolated(at: np.ndarray, knots: np.ndarray, values: np.ndarray) -> np.ndarray:
    """[knots, ...] linear in the severity -> [at, ...]."""
    place = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, len(knots) - 2)
    weight = ((at - knots[place]) / (knots[place + 1] - knots[place])).reshape(-1, *(1,) * (values.ndim - 1))
    return (1 - weight) * values[place] + weight * values[place + 1]
