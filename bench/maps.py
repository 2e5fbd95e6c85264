"""The paper's map: how long it takes, and where the time goes."""

from __future__ import annotations

import os
from pathlib import Path
import tempfile
import time

from analysis.maps import build_map
from analysis.plant import ModelPlant
from analysis.settings import load_settings
from codegen.compile import compile_model

GOAL = 5.0  # s on two cores: simulation and analysis of the whole map, after set-up


def split(rounds: int) -> list[dict[str, object]]:
    """One row a part, times in s: the best of `rounds` // 3 maps drawn anew, the first one with figures."""
    settings, repeats = load_settings(), max(1, rounds // 3)
    with tempfile.TemporaryDirectory() as cache:
        begin = time.perf_counter()
        compiled = compile_model(settings.model, cache_directory=cache)
        rows = [_row("translate and compile the model", time.perf_counter() - begin)]
        plant = ModelPlant(compiled.name, compiled.path, compiled.hash, settings, compiled.report.seconds)
        with tempfile.TemporaryDirectory() as folder:
            maps = [build_map(plant, settings, Path(folder), resume=False, figures=k == 0) for k in range(repeats)]
    best = min((m.seconds for m in maps), key=lambda seconds: seconds["sweep"])
    severities, cores = len(maps[0].rows), os.cpu_count()
    rows += [
        _row(f"simulate and analyse {severities} severities on {cores} cores", best["sweep"], GOAL),
        _row("of it simulation, summed over cores", best["simulate_cpu"]),
        _row("of it analysis, summed over cores", best["analyse_cpu"]),
        _row("figures and report", maps[0].seconds["figures"]),
    ]
    return rows


def _row(part: str, seconds: float, goal: float | None = None) -> dict[str, object]:
    return {"part": part, "seconds": seconds, "goal": goal}
