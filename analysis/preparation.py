"""Prepare a finished map for assessment: the severity table, and what a recording's start must look like."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
import os

import numpy as np
from scipy.stats import chi2

from analysis.chain import Chain, Features, signature
from analysis.errors import AnalysisError
from analysis.files import published_together
from analysis.maps import Map
from analysis.plant import Plant
from analysis.sensitivities import nuisance_covariances
from analysis.settings import Settings
from analysis.severity_table import TableContents, table_bytes

TABLE_FILE, START_FILE = "severity.table", "start.npz"
START = 0.03  # s, of a test: long enough for all three currents to show their sign and order
START_RATE = 5000.0  # Hz


def prepare_assessment(plant: Plant, settings: Settings, finished: Map, *, jobs: int | None = None) -> None:
    """Write severity.table and start.npz beside the map's files.

    Simulates the map's severities again, for their full signature, and the nuisances of the settings: about three
    times the work of the map itself. Raises AnalysisError where a severity has no complete signature.
    """
    chain, severities = Chain(settings.text), settings.fault.severities
    with ThreadPoolExecutor(max_workers=jobs or os.cpu_count()) as pool:
        features = list(pool.map(lambda severity: _features(plant, chain, severity), severities))
    signatures = [signature(found) for found in features]
    lost = [severity for severity, found in zip(severities, signatures, strict=True) if found is None]
    if lost:
        raise AnalysisError(
            f"no first peak at {settings.fault.symbol} = {lost[0]:g}: the map cannot be read back there"
        )
    contents = _contents(settings, chain, np.array(signatures), [found.rms_mean for found in features])
    covariance = nuisance_covariances(plant, settings, severities, jobs)
    with published_together(finished.folder) as scratch:
        (scratch / TABLE_FILE).write_bytes(table_bytes(TableContents(**contents, covariance=covariance)))
        np.savez(scratch / START_FILE, rate=START_RATE, currents=_starts(plant, settings, severities))


def _features(plant: Plant, chain: Chain, severity: float) -> Features:
    record = plant.run(severity)
    return chain.analyse(record.currents, record.angle)


def _starts(plant: Plant, settings: Settings, severities: list[float]) -> np.ndarray:
    """[severities, channels, samples] of the first instants of tests at some severities."""
    stride, samples = round(settings.sampling_rate / START_RATE), round(START * settings.sampling_rate)
    chosen = severities[:: max(1, len(severities) // 5)]
    return np.array([plant.run(severity).currents[:, :samples:stride] for severity in chosen])


def _contents(settings: Settings, chain: Chain, signatures: np.ndarray, rms_mean: list[float]) -> dict:
    rule, hop = settings.raw["first_peak"], np.diff(chain.section_starts[:2])
    sections = (chain.samples, chain.section_length, int(hop[0]) if len(hop) else chain.samples, 2 * (chain.lines - 1))
    freedom = signatures.shape[1] - 1
    return {
        "channels": chain.channels,
        "sections": sections,
        "sampling_rate": settings.sampling_rate,
        "peak_rule": (rule["above"], rule["threshold"]),
        "speed_after": settings.speed_after,
        "misfit_limit": float(chi2.isf(settings.raw["assessment"]["improbable"], freedom)),
        "severity": np.array(settings.fault.severities),
        "rms_mean": np.array(rms_mean),
        "signature": signatures,
        "bands": [(band.name, band.first, band.last) for band in settings.bands],
    }
