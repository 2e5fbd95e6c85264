"""The paper's map: how long it takes, and where the time goes."""

from __future__ import annotations

import os
from pathlib import Path
import tempfile
import time

from lacuna.analysis.map.maps import build_map
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.settings import Settings, load_settings
from lacuna.codegen.compile import compile_model

GOAL = 5.0  # s on two cores: simulation and analysis of the whole map, after set-up


def split(rounds: int) -> list[dict[str, object]]:
    """One row a part, times in s: the best of `rounds` // 3 maps drawn anew, then one with figures."""
    settings = load_settings()
    with tempfile.TemporaryDirectory() as cache, tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        compiled = compile_model(settings.model, cache_directory=cache)
        translated = time.perf_counter() - begin
        plant = ModelPlant(compiled.name, compiled.path, compiled.hash, settings, compiled.report.seconds)
        drawn = [_drawn(plant, settings, Path(folder)) for _ in range(max(1, rounds // 3))]
        illustrated = build_map(plant, settings, Path(folder))
    seconds, processor = min(drawn, key=lambda pair: pair[0]["sweep"])
    severities, cores = len(illustrated.rows), os.cpu_count()
    return [
        _row("translate and compile the model", translated),
        _row(f"simulate and analyse {severities} severities on {cores} cores", seconds["sweep"], GOAL),
        _row("processor time of it, all cores; what two idle cores need is half", processor),
        _row("of the elapsed time simulation, summed over cores", seconds["simulate_cpu"]),
        _row("of the elapsed time analysis, summed over cores", seconds["analyse_cpu"]),
        _row("figures and report", illustrated.seconds["figures"]),
    ]


def _drawn(plant: ModelPlant, settings: Settings, folder: Path) -> tuple[dict[str, float], float]:
    """Elapsed seconds by part, and processor seconds, of one map without figures."""
    begin = time.process_time()
    finished = build_map(plant, settings, folder, resume=False, figures=False)
    return finished.seconds, time.process_time() - begin


def _row(part: str, seconds: float, goal: float | None = None) -> dict[str, object]:
    return {"part": part, "seconds": seconds, "goal": goal}
