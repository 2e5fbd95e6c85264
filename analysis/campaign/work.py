"""What a worker does with a chunk of points. It needs this package installed, and nothing else of the client's."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
import hashlib
from pathlib import Path
import tempfile

import numpy as np
import pyarrow as pa

from lacuna import runtime
from lacuna.analysis.campaign.points import Points
from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.settings import load_settings
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
    tools = _tools(work)
    names = list(points)
    rows = [_row(tools, dict(zip(names, map(float, p), strict=True))) for p in zip(*points.values(), strict=True)]
    return pa.Table.from_pylist(rows, schema=_schema(names, tools.chain.channels))


class _Tools:
    """Plant, chain and settings of `work`, in a folder that nobody else can write to: code is loaded from it."""

    def __init__(self, work: Work):
        self._folder = tempfile.TemporaryDirectory(prefix="lacuna-", ignore_cleanup_errors=True)
        library, text = Path(self._folder.name) / "model.so", Path(self._folder.name) / "settings.toml"
        library.write_bytes(work.library)
        text.write_text(work.settings, encoding="utf-8")
        self.settings = load_settings(text)
        self.plant = ModelPlant(work.name, library, work.model_hash, self.settings, solver=work.solver)
        self.chain = Chain(self.settings)


_tools = lru_cache(maxsize=4)(_Tools)  # set up once in a process


def _schema(parameters: list[str], channels: int) -> pa.Schema:
    numbers = [*parameters, *_feature_names(channels)]
    return pa.schema([(name, pa.float64()) for name in numbers] + [("failure", pa.string())])


def _feature_names(channels: int) -> list[str]:
    rms = [f"rms_{k + 1}" for k in range(channels)]
    return [*rms, "rms_mean", *(f"peak_hz_{k + 1}" for k in range(channels)), "speed_mean"]


def _row(tools: _Tools, point: dict[str, float]) -> dict[str, object]:
    plant, chain, settings = tools.plant, tools.chain, tools.settings
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
