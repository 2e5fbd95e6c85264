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

from lacuna.analysis.map.plant import Plant
from lacuna.analysis.recording.recordings import Recording, Refusal
from lacuna.analysis.settings import Settings
from lacuna.analysis.severity.prepared import Prepared
from lacuna.analysis.severity.sensitivities import moved
from lacuna.analysis.spectra.chain import Chain
from lacuna.written import whole_file

CHUNK = 50  # tests
SEED = 2024


@dataclass(frozen=True)
class Results:
    """One entry a test; `z` [tests, nuisances]. A test without a reading has NaN, and is not covered."""

    severity: np.ndarray
    z: np.ndarray
    estimate: np.ndarray
    low: np.ndarray
    high: np.ndarray
    misfit: np.ndarray
    paper: np.ndarray
    covered: np.ndarray  # not refused
    warned: np.ndarray  # read with a warning


def run_tests(
    plant: Plant,
    prepared: Prepared,
    store: Path,
    count: int,
    *,
    stranger: dict | None = None,
    jobs: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Results:
    """Simulate and assess `count` tests (a power of two keeps the design balanced) with a prepared map.

    `stranger`: the tests are of an actuator that is not the map's, an entry of the settings' [[strangers]].
    """
    settings = prepared.settings
    nuisances = settings.nuisances
    plant = plant.with_solver(settings.table("assessment")["solver"])
    design = qmc.Sobol(1 + len(nuisances), seed=SEED).random(count)
    study = _Study(plant, prepared, Chain(settings), nuisances, stranger or {})
    everything = [plant.hash, settings.text, stranger, CHUNK, SEED, count]
    key = hashlib.sha256(json.dumps(everything).encode() + prepared.key).hexdigest()
    store.mkdir(parents=True, exist_ok=True)
    chunks: dict[int, np.ndarray] = {}

    def work(start: int) -> tuple[int, np.ndarray]:
        path = store / f"{key[:24]}-{start}.npy"
        if not path.exists():
            numbers = range(start, min(start + CHUNK, count))
            done = np.array([study.test(design[k], k) for k in numbers])
            with whole_file(path) as partial:
                np.save(partial, done)
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
    return Results(rows[:, 0], rows[:, 1 : 1 + q], *rows[:, 1 + q : -2].T, *rows[:, -2:].T.astype(bool))


@dataclass(frozen=True)
class _Study:
    plant: Plant
    prepared: Prepared
    chain: Chain
    nuisances: list[dict]
    stranger: dict

    def test(self, point: np.ndarray, k: int) -> list[float]:
        """One test: severity and nuisances from a point of the design, sensor errors from the test's own number."""
        settings = self.prepared.settings
        fault, z = settings.fault, np.sqrt(3) * (2 * point[1:] - 1)
        severity = fault.first + (fault.last - fault.first) * float(point[0])
        record = self.plant.run(severity, **self._parameters(z))
        recording = Recording(settings.currents, settings.sampling_rate, sensed(record.currents, settings, k))
        features = self.chain.analyse(recording.currents)
        found = self.prepared.table.estimate(features)
        try:
            self.prepared.check_start(recording)
            warned, covered = bool(self.prepared.check_estimate(features, found)), True
        except Refusal:
            warned, covered = False, False
        reading = [found.severity, found.low, found.high, found.misfit, found.paper] if found else [np.nan] * 5
        return [severity, *z, *reading, float(covered), float(warned)]

    def _parameters(self, z: np.ndarray) -> dict[str, float]:
        values: dict[str, float] = {}
        for nuisance, number in zip(self.nuisances, z, strict=True):
            values |= moved(self.plant, nuisance, float(number))
        names = self.stranger.get("parameters", [])
        for name, factor in zip(names, self.stranger.get("factor", []), strict=False):
            values[name] = factor * values.get(name, self.plant.undisturbed(name))
        return values | dict(zip(names, self.stranger.get("value", []), strict=False))


def sensed(currents: np.ndarray, settings: Settings, seed: int) -> np.ndarray:
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
    """For each nuisance, the share of the error's variance that its own value explains (a parabola in it)."""
    shares = []
    for z in results.z.T:
        fitted = np.polyval(np.polyfit(z, error, 2), z)
        shares.append(float(fitted.var() / error.var()))
    return shares
