"""How well two faults at once are read: simulated tests over both and all other nuisances, and the map's own limits."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
import os

import numpy as np
from scipy.stats import qmc

from lacuna.analysis.map.plant import Plant
from lacuna.analysis.map.sweep import Progress
from lacuna.analysis.severity.combined.estimate import JointEstimate, JointEstimator
from lacuna.analysis.severity.combined.grid import Grid, other_nuisances
from lacuna.analysis.severity.robustness import sensed
from lacuna.analysis.severity.sensitivities import moved
from lacuna.analysis.severity.severity_table import Estimate, SeverityTable
from lacuna.analysis.spectra.chain import Chain, signature

SEED = 11


@dataclass(frozen=True)
class Test:
    first: float
    second: float
    joint: JointEstimate | None  # None: no signature
    alone: Estimate | None  # by the map of the first fault alone


@dataclass(frozen=True)
class Limits:
    """[x, y] on the grid's nodes: what can be known of both severities there at best."""

    half_first: np.ndarray  # half width of the 95 % interval
    half_second: np.ndarray
    correlation: np.ndarray
    readable: np.ndarray  # the second


@dataclass(frozen=True)
class Study:
    grid: Grid
    limits: Limits
    tests: list[Test]


def run_study(plant: Plant, grid: Grid, alone: SeverityTable, count: int, progress: Progress | None = None) -> Study:
    """`count` tests (a power of two keeps the design balanced); `alone`: the table of the map over the first fault."""
    settings, other, estimator = grid.settings, grid.other, JointEstimator(grid)
    plant, chain = plant.with_solver(settings.table("assessment")["solver"]), Chain(settings)
    nuisances = other_nuisances(settings, other)
    design = qmc.Sobol(2 + len(nuisances), seed=SEED).random(count)

    def test(k: int) -> Test:
        first, second = (
            fault.first + (fault.last - fault.first) * float(share)
            for fault, share in zip((settings.fault, other), design[k], strict=False)
        )
        values: dict[str, float] = {}
        for nuisance, share in zip(nuisances, design[k, 2:], strict=True):
            values |= moved(plant, nuisance, np.sqrt(3) * (2 * share - 1))
        record = plant.run(first, **(values | {other.parameter: second}))
        features = chain.analyse(sensed(record.currents, settings, k))
        vector = signature(features)
        joint = None if vector is None else estimator.estimate(vector)
        return Test(first, second, joint, alone.estimate(features))

    tests = []
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        for done in pool.map(test, range(count)):
            tests.append(done)
            if progress:
                progress(len(tests), count)
    return Study(grid, limits(estimator), tests)


def limits(estimator: JointEstimator) -> Limits:
    """What the estimate says of signatures that lie on the map, at the middle level of the first nuisance."""
    middle = estimator.grid.mean[len(estimator.grid.mean) // 2]
    found = [[estimator.estimate(vector) for vector in row] for row in middle]

    def each(what) -> np.ndarray:
        return np.array([[what(estimate) for estimate in row] for row in found])

    return Limits(
        half_first=each(lambda e: (e.first.high - e.first.low) / 2),
        half_second=each(lambda e: (e.second.high - e.second.low) / 2),
        correlation=each(lambda e: e.correlation),
        readable=each(lambda e: e.second.readable),
    )
