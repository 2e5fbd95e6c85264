"""The rows of a map: one severity simulated and analysed, kept on disk under a hash of all that decides it."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
import hashlib
import json
from pathlib import Path
import re
from time import perf_counter
import zipfile

import numpy as np

from lacuna.analysis.map.plant import Plant
from lacuna.analysis.settings import Settings
from lacuna.analysis.spectra.chain import Chain
from lacuna.analysis.spectra.library import library_path
from lacuna.written import whole_file

TRACE_RATE = 5000.0  # Hz, of the signals kept for figures: 25 times the sixth harmonic of the commutation
_OURS = re.compile(r"[0-9a-f]{32}\.(npz|\d+\.\d+\.partial)")  # names of the rows that are kept, whole and begun
SPECTRUM_LIMIT = 400.0  # Hz, of the spectra kept for figures: three times the corner of the filters


@dataclass(frozen=True)
class Row:
    """Features at one severity, and what the figures draw of it."""

    severity: float
    rms: list[float]  # A, one a channel
    rms_mean: float  # A
    peak_hz: list[float | None]
    peak_bin: list[int | None]
    speed_mean: float | None  # rad/s
    counters: dict[str, int]
    seconds: dict[str, float]  # spent in "simulate" and "analyse"
    traces: dict[str, np.ndarray] = field(compare=False, repr=False)


def compute_row(plant: Plant, chain: Chain, settings: Settings, severity: float) -> Row:
    """Simulate and analyse one severity."""
    begin = perf_counter()
    record = plant.run(severity)
    simulated = perf_counter()
    features = chain.analyse(record.currents, record.angle)
    analysed = perf_counter()
    stride = max(1, round(settings.sampling_rate / TRACE_RATE))
    lines = min(features.held.shape[1], 1 + int(SPECTRUM_LIMIT / chain.resolution))
    return Row(
        severity=severity,
        rms=features.rms.tolist(),
        rms_mean=features.rms_mean,
        peak_hz=[None if np.isnan(hz) else float(hz) for hz in features.peak_hz],
        peak_bin=[None if k < 0 else int(k) for k in features.peak_bin],
        speed_mean=features.speed_mean if features.turns else None,
        counters=record.counters,
        seconds={"simulate": simulated - begin, "analyse": analysed - simulated},
        traces={
            "time": np.arange(0, settings.samples, stride) / settings.sampling_rate,
            "currents": record.currents[:, ::stride].astype(np.float32),
            "speed": record.speed[::stride].astype(np.float32),
            "angle": record.angle[::stride].astype(np.float32),
            "frequency": chain.resolution * np.arange(lines),
            "held": features.held[:, :lines].astype(np.float32),
        },
    )


class RowStore:
    """Rows as files named by the hash of model, settings, analysis library and severity, each written whole or not.

    A change to an equation or a setting changes the names, so that nothing stale is ever read.
    """

    def __init__(self, folder: Path, plant: Plant, settings: Settings):
        self._folder = folder
        everything = [plant.hash, settings.text, hashlib.sha256(library_path().read_bytes()).hexdigest()]
        self.key = json.dumps([*everything, TRACE_RATE, SPECTRUM_LIMIT])

    def _path(self, severity: float) -> Path:
        return self._folder / f"{hashlib.sha256(f'{self.key} {severity!r}'.encode()).hexdigest()[:32]}.npz"

    def load(self, severity: float) -> Row | None:
        """The row, or None where it was never computed (or its file is damaged, or of another row: then it is computed
        again)."""
        path = self._path(severity)
        try:
            with np.load(path, allow_pickle=False) as data:
                text = str(data["fields"])
                traces = {name: data[name] for name in data.files if name not in ("fields", "digest")}
                intact = str(data["digest"]) == _digest(path.stem, text, traces)
                return Row(**json.loads(text), traces=traces) if intact else None
        except (OSError, EOFError, ValueError, KeyError, TypeError, zipfile.BadZipFile):
            return None

    def save(self, row: Row) -> None:
        text = json.dumps({name: value for name, value in asdict(row).items() if name != "traces"})
        path = self._path(row.severity)
        with whole_file(path, lasting=False) as partial:  # what is damaged is seen by its digest
            np.savez(partial, fields=text, digest=_digest(path.stem, text, row.traces), **row.traces)

    def prune(self, severities: list[float]) -> None:
        """Remove the rows of other models and settings, and what an interrupted run left; nothing that is not ours."""
        keep = {self._path(severity) for severity in severities}
        for path in self._folder.glob("*"):
            if path not in keep and _OURS.match(path.name):
                path.unlink(missing_ok=True)


def _digest(name: str, fields: str, traces: dict[str, np.ndarray]) -> str:
    """Of what a row's file holds and what it is called."""
    found = hashlib.sha256(f"{name} {fields}".encode())
    for trace, values in sorted(traces.items()):
        found.update(trace.encode() + values.tobytes())
    return found.hexdigest()
