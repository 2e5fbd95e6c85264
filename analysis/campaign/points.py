"""Where a campaign simulates: severities and nuisances by a low-discrepancy design."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.stats import norm, qmc

from analysis.settings import Settings

Points = dict[str, np.ndarray]  # parameter -> its value at every point


def sobol_points(settings: Settings, count: int, declared: Callable[[str], float], seed: int = 1) -> Points:
    """`count` points: the severity uniform over the fault axis, each nuisance of the settings log-normal.

    A scrambled Sobol sequence (Owen, J. Complexity 14, 1998), whose first n points are the same for every `count`
    of at least n. `declared` gives the declared value of a parameter.
    """
    nuisances = settings.raw.get("nuisances", [])
    sequence = qmc.Sobol(1 + len(nuisances), scramble=True, rng=np.random.default_rng(seed))
    with_power = sequence.random_base2(max(0, int(np.ceil(np.log2(max(count, 1))))))
    unit = with_power[:count]
    fault = settings.fault
    points = {fault.parameter: fault.first + (fault.last - fault.first) * unit[:, 0]}
    for k, nuisance in enumerate(nuisances, start=1):
        z = norm.ppf(np.clip(unit[:, k], 1e-12, 1 - 1e-12))
        for name, spread in zip(nuisance["parameters"], nuisance["spread"], strict=True):
            points[name] = points.get(name, declared(name)) * np.exp(spread * z)
    return points


def chunks(points: Points, size: int) -> list[Points]:
    """Consecutive pieces of at most `size` points."""
    count = len(next(iter(points.values())))
    return [{name: values[k : k + size] for name, values in points.items()} for k in range(0, count, size)]
