"""What a worker does with a chunk of points. It needs this package installed, and nothing else of the client's."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
import hashlib
import os
from pathlib import Path
import tempfile

import numpy as np
import pyarrow as pa

from lacuna import runtime
from lacuna.analysis.campaign.points import Points
from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.settings import Settings, load_settings
from lacuna.analysis.spectra.chain import Chain


@dataclass(frozen=True)
class Work:
    """A translated model and the settings of its test, as they travel to a worker."""

    name: str
    library: bytes  # the model's shared object
    model_hash: str
    settings: str  # text of the settings file
    solver: str

    @cached_property
    def key(self) -> str:
        parts = (self.library, self.settings.encode(), self.solver.encode())
        return hashlib.sha256(b"\0".join(parts)).hexdigest()


def run_chunk(work: Work, points: Points) -> pa.Table:
    """One row for each point: its parameters, features, and `failure` (null where the run completed)."""
    plant, chain, settings = _tools(work)
    names = list(points)
    rows = [
        _row(plant, chain, settings, dict(zip(names, map(float, p), strict=True)))
        for p in zip(*points.values(), strict=True)
    ]
    return pa.Table.from_pylist(rows, schema=_schema(names, chain.channels))


@lru_cache(maxsize=4)
def _tools(work: Work) -> tuple[ModelPlant, Chain, Settings]:
    """Plant, chain and settings of `work`, set up once in a process."""
    folder = Path(tempfile.gettempdir()) / f"lacuna-{os.getuid()}" / work.key
    library, text = folder / "model.so", folder / "settings.toml"
    folder.mkdir(parents=True, exist_ok=True)
    for path, content in ((library, work.library), (text, work.settings.encode())):
        if not path.exists():
            partial = path.with_suffix(f".{os.getpid()}")
            partial.write_bytes(content)
            partial.replace(path)
    settings = load_settings(text)
    return ModelPlant(work.name, library, work.model_hash, settings, solver=work.solver), Chain(settings), settings


def _schema(parameters: list[str], channels: int) -> pa.Schema:
    numbers = [*parameters, *_feature_names(channels)]
    return pa.schema([(name, pa.float64()) for name in numbers] + [("failure", pa.string())])


def _feature_names(channels: int) -> list[str]:
    rms = [f"rms_{k + 1}" for k in range(channels)]
    return [*rms, "rms_mean", *(f"peak_hz_{k + 1}" for k in range(channels)), "speed_mean"]


def _row(plant: ModelPlant, chain: Chain, settings: Settings, point: dict[str, float]) -> dict[str, object]:
    others = {name: value for name, value in point.items() if name != settings.fault.parameter}
    names = _feature_names(chain.channels)
    try:
        record = plant.run(point[settings.fault.parameter], **others)
        found = chain.analyse(record.currents, record.angle)
    except (AnalysisError, runtime.SimulationError) as error:
        return point | dict.fromkeys(names) | {"failure": str(error)}
    values = [*found.rms, found.rms_mean, *found.peak_hz, found.speed_mean]
    features = {n: None if np.isnan(v) else float(v) for n, v in zip(names, values, strict=True)}
    return point | features | {"failure": None}
