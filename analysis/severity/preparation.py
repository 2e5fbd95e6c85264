"""Prepare a finished map for assessment: the severity table, and what a recording's start must look like."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
import hashlib
import os
from pathlib import Path

import numpy as np
from scipy.stats import chi2

from lacuna.analysis.map.maps import Map
from lacuna.analysis.map.plant import Plant
from lacuna.analysis.settings import Settings
from lacuna.analysis.severity.sensitivities import Surroundings, conditions, covariances
from lacuna.analysis.severity.severity_table import TableContents, table_bytes
from lacuna.analysis.spectra.chain import Chain
from lacuna.written import whole_files

TABLE_FILE, MODEL_FILE = "severity.table", "expected.npz"
START = 0.03  # s, of a test: long enough for all three currents to show their sign and order
START_RATE = 5000.0  # Hz


def prepare_assessment(plant: Plant, settings: Settings, finished: Map, *, jobs: int | None = None) -> None:
    """Write severity.table and expected.npz beside the map's files.

    `plant` gives the map's signals and has the parameters of the settings' nuisances. Simulates the map's severities at
    every level of the first nuisance, and around them the other nuisances. Raises AnalysisError where a severity has no
    complete signature.
    """
    chain, severities = Chain(settings), settings.fault.severities
    plant = plant.with_solver(settings.table("assessment")["solver"])
    nuisances = settings.nuisances
    signatures, covariance = [], []
    levels = conditions(settings.table("assessment")["conditions"])
    for level in levels:
        about = Surroundings(plant, settings, chain, nuisances, level, 1 / len(levels))
        signatures.append(_signatures(about, severities, jobs))
        covariance.append(covariances(about, severities, jobs))
    rms_mean = [row.rms_mean for row in finished.rows]
    contents = _contents(settings, chain, rms_mean, np.array(signatures), np.array(covariance))
    with whole_files(finished.folder) as scratch:
        (scratch / TABLE_FILE).write_bytes(table_bytes(contents))
        chosen = severities[:: max(1, len(severities) // 5)]
        starts = np.array([start_of(plant, settings, severity) for severity in chosen])
        np.savez(
            scratch / MODEL_FILE,
            map=fingerprint(finished.folder),
            starts=starts,
            mean=contents.signature,
            covariance=contents.covariance,
        )


def fingerprint(folder: Path) -> str:
    """Of the map in `folder`, so that what was prepared for another one is not used with it."""
    digest = hashlib.sha256()
    for name in ("map.csv", "settings.toml"):
        digest.update((folder / name).read_bytes())
    return digest.hexdigest()


def _signatures(about: Surroundings, severities: list[float], jobs: int | None) -> np.ndarray:
    """[severities, n] at the level of the first nuisance."""
    fault = about.settings.fault.parameter
    with ThreadPoolExecutor(max_workers=jobs or os.cpu_count()) as pool:
        return np.array(list(pool.map(lambda severity: about.signature({fault: severity}), severities)))


def start_of(plant: Plant, settings: Settings, severity: float) -> np.ndarray:
    """[channels, samples] of the first instants of a test, at START_RATE."""
    stride, samples = round(settings.sampling_rate / START_RATE), round(START * settings.sampling_rate)
    return plant.run(severity).currents[:, :samples:stride]


def _contents(
    settings: Settings, chain: Chain, rms_mean: list[float], signatures: np.ndarray, covariance: np.ndarray
) -> TableContents:
    rule, hop = settings.raw["first_peak"], np.diff(chain.section_starts[:2])
    sections = (chain.samples, chain.section_length, int(hop[0]) if len(hop) else chain.samples, 2 * (chain.lines - 1))
    freedom = signatures.shape[-1] - 1
    return TableContents(
        channels=chain.channels,
        sections=sections,
        sampling_rate=settings.sampling_rate,
        peak_rule=(rule["above"], rule["threshold"]),
        speed_after=settings.speed_after,
        misfit_limit=float(chi2.isf(settings.table("assessment")["improbable"], freedom)),
        severity=np.array(settings.fault.severities),
        rms_mean=np.array(rms_mean),
        signature=signatures,
        covariance=covariance,
        bands=[(band.name, band.first, band.last) for band in settings.bands],
    )
