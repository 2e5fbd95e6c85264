"""How well severities are read when friction, temperature, supply, inertia and sensors are not the map's.

Simulated pre-flight tests over a low-discrepancy design: severity and every nuisance of the settings uniform over their
ranges, sensor errors drawn for each test. Chunks of tests are kept by content, so that a long study goes on where it
stopped.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
import hashlib
import json
import os
from pathlib import Path

import numpy as np
from scipy.stats import qmc

from analysis.chain import Chain
from analysis.errors import AnalysisError
from analysis.plant import Plant
from analysis.sensitivities import moved
from analysis.settings import Settings
from analysis.severity_table import SeverityTable

CHUNK = 50  # tests
SEED = 2024


@dataclass(frozen=True)
class Results:
    """One entry a test; `z` [tests, nuisances] in normal numbers. A test without a reading has NaN, not covered."""

    severity: np.ndarray
    z: np.ndarray
    estimate: np.ndarray
    low: np.ndarray
    high: np.ndarray
    misfit: np.ndarray
    paper: np.ndarray
    covered: np.ndarray


def run_tests(
    plant: Plant,
    settings: Settings,
    table: Path,
    store: Path,
    count: int,
    *,
    jobs: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Results:
    """Simulate and assess `count` tests (a power of two keeps the design balanced) with the severity table `table`."""
    nuisances = settings.raw.get("nuisances", [])
    plant = plant.with_solver(settings.table("assessment")["solver"])
    design = qmc.Sobol(1 + len(nuisances), seed=SEED).random(count)
    reader, chain = SeverityTable(table), Chain(settings.text)
    key = hashlib.sha256(json.dumps([plant.hash, settings.text, CHUNK, SEED]).encode() + table.read_bytes()).hexdigest()
    store.mkdir(parents=True, exist_ok=True)
    chunks: dict[int, np.ndarray] = {}

    def work(start: int) -> tuple[int, np.ndarray]:
        path = store / f"{key[:24]}-{count}-{start}.npy"
        if not path.exists():
            numbers = range(start, min(start + CHUNK, count))
            done = np.array([_test(plant, settings, reader, chain, nuisances, design[k], k) for k in numbers])
            partial = path.with_suffix(".partial")
            with partial.open("wb") as file:
                np.save(file, done)
            partial.replace(path)
        return start, np.load(path)

    pool = ThreadPoolExecutor(max_workers=jobs or os.cpu_count())
    try:
        for future in as_completed([pool.submit(work, start) for start in range(0, count, CHUNK)]):
            start, rows = future.result()
            chunks[start] = rows
            if progress:
                progress(sum(map(len, chunks.values())), count)
    finally:
        pool.shutdown(cancel_futures=True)
    rows = np.concatenate([chunks[start] for start in sorted(chunks)])
    q = len(nuisances)
    return Results(rows[:, 0], rows[:, 1 : 1 + q], *rows[:, 1 + q : -1].T, rows[:, -1].astype(bool))


def _test(
    plant: Plant, settings: Settings, reader: SeverityTable, chain: Chain, nuisances: list, point: np.ndarray, k: int
) -> list[float]:
    """One test: severity and nuisances from a point of the design, sensor errors from the test's own number."""
    fault, z = settings.fault, np.sqrt(3) * (2 * point[1:] - 1)
    severity = fault.first + (fault.last - fault.first) * float(point[0])
    parameters: dict[str, float] = {}
    for nuisance, number in zip(nuisances, z, strict=True):
        parameters |= moved(plant, nuisance, float(number))
    record = plant.run(severity, **parameters)
    try:
        found = reader.estimate(chain.analyse(_sensed(record.currents, settings, k)))
    except AnalysisError:
        found = None
    if found is None:
        return [severity, *z, *[np.nan] * 5, 0.0]
    return [severity, *z, found.severity, found.low, found.high, found.misfit, found.paper, float(found.covered)]


def _sensed(currents: np.ndarray, settings: Settings, seed: int) -> np.ndarray:
    """What sensors and converter make of the currents: gain, offset, noise, steps."""
    sensor, random = settings.table("assessment"), np.random.default_rng(seed)
    per_channel = (len(currents), 1)
    gain = 1 + sensor["sensor_gain"] * random.standard_normal(per_channel)
    offset = sensor["sensor_offset"] * random.standard_normal(per_channel)
    noisy = gain * currents + offset + sensor["sensor_noise"] * random.standard_normal(currents.shape)
    step = sensor["converter_step"]
    return step * np.round(noisy / step)


@dataclass(frozen=True)
class Rate:
    """A share of cases with its 95 % interval (Wilson)."""

    hits: int
    cases: int

    @property
    def value(self) -> float:
        return self.hits / self.cases if self.cases else float("nan")

    @property
    def interval(self) -> tuple[float, float]:
        if not self.cases:
            return (0.0, 1.0)
        n, p, z2 = self.cases, self.value, 1.96**2
        centre, half = p + z2 / (2 * n), 1.96 * np.sqrt(p * (1 - p) / n + z2 / (4 * n * n))
        low, high = (centre - half) / (1 + z2 / n), (centre + half) / (1 + z2 / n)
        return (max(0.0, float(low)), min(1.0, float(high)))


def rate(condition: np.ndarray) -> Rate:
    return Rate(int(condition.sum()), len(condition))


def roc(positive: np.ndarray, score: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """False-alarm share, hit share, and the area under their curve, over all thresholds of `score`."""
    order = np.argsort(-score)
    hits = np.concatenate([[0.0], np.cumsum(positive[order]) / positive.sum()])
    alarms = np.concatenate([[0.0], np.cumsum(~positive[order]) / (~positive).sum()])
    return alarms, hits, float(np.trapezoid(hits, alarms))


def error_shares(results: Results, error: np.ndarray) -> list[float]:
    """For each nuisance, the share of the squared error that its own value explains (a parabola in it)."""
    shares = []
    for z in results.z.T:
        fitted = np.polyval(np.polyfit(z, error, 2), z)
        shares.append(float((fitted**2).mean() / (error**2).mean()))
    return shares
