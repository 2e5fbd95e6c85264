"""Where a campaign simulates: severities and nuisances by a low-discrepancy design."""

from __future__ import annotations

import numpy as np
from scipy.stats import qmc

from lacuna.analysis.map.plant import Plant
from lacuna.analysis.settings import Settings
from lacuna.analysis.severity.sensitivities import moved

Points = dict[str, np.ndarray]  # parameter -> its value at every point


def sobol_points(settings: Settings, count: int, plant: Plant, seed: int = 1) -> Points:
    """`count` points: severity and nuisances of the settings uniform over their ranges.

    A scrambled Sobol sequence (Owen, J. Complexity 14, 1998), whose first n points are the same for every `count`
    of at least n. Raises AnalysisError where `plant` lacks a parameter of a nuisance.
    """
    nuisances = settings.nuisances
    sequence = qmc.Sobol(1 + len(nuisances), scramble=True, rng=np.random.default_rng(seed))
    unit = sequence.random_base2(max(0, int(np.ceil(np.log2(max(count, 1))))))[:count]
    fault = settings.fault
    points = {fault.parameter: fault.first + (fault.last - fault.first) * unit[:, 0]}
    for nuisance, share in zip(nuisances, unit[:, 1:].T, strict=True):
        points |= moved(plant, nuisance, np.sqrt(3) * (2 * share - 1))
    return points


def chunks(points: Points, size: int) -> list[Points]:
    """Consecutive pieces of at most `size` points."""
    count = len(next(iter(points.values())))
    return [{name: values[k : k + size] for name, values in points.items()} for k in range(0, count, size)]
