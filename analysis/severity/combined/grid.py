"""A map over two faults: the signature and its covariance on a grid of both, at levels of the first nuisance."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
import hashlib
from itertools import product
import os
from pathlib import Path

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.files import load_arrays
from lacuna.analysis.map.plant import Plant
from lacuna.analysis.map.sweep import Progress
from lacuna.analysis.settings import Fault, Settings, load_settings
from lacuna.analysis.severity.preparation import start_of
from lacuna.analysis.severity.sensitivities import Surroundings, conditions
from lacuna.analysis.spectra.chain import Chain
from lacuna.written import whole_files

GRID_FILE, SETTINGS_FILE = "combined.npz", "settings.toml"
STEP = 0.05  # of the severity of the map's own fault, from node to node
CORNERS = 3  # knots of the covariance along each axis
LEVELS = 3  # of the first nuisance


@dataclass(frozen=True)
class Grid:
    """Axes x (the map's fault) and y (the other one); l levels of the first nuisance, n features."""

    settings: Settings
    other: Fault
    x: np.ndarray
    y: np.ndarray
    mean: np.ndarray  # [l, x, y, n]
    covariance: np.ndarray  # [l, x, y, n, n]
    starts: np.ndarray  # A, [x, channels, samples], first instants without the other fault


def other_fault(settings: Settings, symbol: str) -> Fault:
    """An entry of [[combined]] by its symbol. Raises AnalysisError with the symbols that there are."""
    entries = {entry["symbol"]: entry for entry in settings.raw.get("combined", [])}
    if symbol not in entries:
        raise AnalysisError(f"{settings.path}: no [[combined]] fault {symbol}; there is {', '.join(entries) or 'none'}")
    other = Fault(**entries[symbol])
    if other.parameter == settings.fault.parameter:
        raise AnalysisError(f"{settings.path}: [[combined]] {symbol} is the map's own fault, {other.parameter}")
    return other


def other_nuisances(settings: Settings, other: Fault) -> list[dict]:
    """Those that do not move the other fault's parameter."""
    return [nuisance for nuisance in settings.nuisances if other.parameter not in nuisance["parameters"]]


def build_grid(
    plant: Plant, settings: Settings, other: Fault, folder: Path, *, jobs: int | None = None,
    progress: Progress | None = None,
) -> Grid:  # fmt: skip
    """Simulate the grid and write combined.npz and settings.toml into `folder`."""
    plant = plant.with_solver(settings.table("assessment")["solver"])
    x = np.arange(settings.fault.first, settings.fault.last + STEP / 2, STEP)
    y, every = np.array(other.severities), settings.nuisances
    nuisances = other_nuisances(settings, other)
    levels = conditions(LEVELS) if nuisances and nuisances[0] is every[0] else [0.0]
    share = 1 / len(levels)
    surroundings = [Surroundings(plant, settings, Chain(settings), nuisances, level, share) for level in levels]
    knots = [np.linspace(axis[0], axis[-1], CORNERS) for axis in (x, y)]
    total, done = len(levels) * (len(x) * len(y) + CORNERS**2), 0

    def over(axes: list[np.ndarray], what: Callable[[Surroundings, dict], np.ndarray]) -> np.ndarray:
        """[levels, *axes, ...]"""
        nonlocal done

        def at(case: tuple) -> np.ndarray:
            about, first, second = case
            return what(about, {settings.fault.parameter: float(first), other.parameter: float(second)})

        values = []
        with ThreadPoolExecutor(max_workers=jobs or os.cpu_count()) as pool:
            for value in pool.map(at, product(surroundings, *axes)):
                values.append(value)
                done += 1
                if progress:
                    progress(done, total)
        return np.reshape(values, (len(levels), *map(len, axes), *values[0].shape))

    mean = over([x, y], lambda about, fault: about.signature(fault))
    corners = over(knots, lambda about, fault: about.covariance(fault))
    nodes = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    covariance = np.array([RegularGridInterpolator(knots, level)(nodes) for level in corners])
    starts = np.array([start_of(plant, settings, float(severity)) for severity in x])
    arrays = {"x": x, "y": y, "mean": mean, "covariance": covariance, "starts": starts}
    with whole_files(folder) as scratch:
        np.savez(scratch / GRID_FILE, other=other.symbol, settings=_digest(settings), **arrays)
        (scratch / SETTINGS_FILE).write_text(settings.text, encoding="utf-8")
    return Grid(settings, other, **arrays)


def load_grid(folder: Path) -> Grid:
    """Raises AnalysisError where a file is missing or damaged, or the settings are no longer those of the map."""
    settings = load_settings(folder / SETTINGS_FILE)
    arrays = load_arrays(folder / GRID_FILE, ("other", "settings", "x", "y", "mean", "covariance", "starts"))
    if str(arrays.pop("settings")) != _digest(settings):
        raise AnalysisError(f"{settings.path} was changed since the map was made: undo that, or make the map again")
    other = other_fault(settings, str(arrays.pop("other")))
    return Grid(settings, other, **arrays)


def _digest(settings: Settings) -> str:
    return hashlib.sha256(settings.text.encode()).hexdigest()
