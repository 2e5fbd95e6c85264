"""A sweep in this process against the same sweep on two Dask workers, and what that means for a million tests."""

from __future__ import annotations

from pathlib import Path
import tempfile
import time

from distributed import LocalCluster

from lacuna.analysis.campaign.points import sobol_points
from lacuna.analysis.campaign.run import run_campaign
from lacuna.analysis.campaign.work import Work, run_chunk
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.settings import load_settings
from lacuna.codegen.compile import compile_model

TESTS, CHUNK, MILLION = 192, 16, 1e6


def scale(rounds: int) -> list[dict[str, object]]:
    """One row for each way of running TESTS tests, once whatever `rounds` says; times in s, bytes for one test."""
    settings = load_settings()
    compiled = compile_model(settings.disturbed_model)
    plant = ModelPlant.of(compiled, settings)
    work = Work(compiled.name, Path(compiled.path).read_bytes(), compiled.hash, settings.text, "dopri5")
    points = sobol_points(settings, TESTS, plant)
    begin = time.perf_counter()
    run_chunk(work, points)
    alone = time.perf_counter() - begin
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        run_campaign(work, points, Path(folder, "threads"), chunk=CHUNK)
        threads = time.perf_counter() - begin
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=40) as cluster:
            begin = time.perf_counter()
            results = run_campaign(
                work, points, Path(folder, "workers"), scheduler=cluster.scheduler_address, chunk=CHUNK
            )
            workers = time.perf_counter() - begin
        size = results.stat().st_size / TESTS
    ways = {"one thread, no Dask": alone, "embedded, a thread a core": threads, "two Dask workers": workers}
    return [_row(name, seconds, alone, size) for name, seconds in ways.items()]


def _row(name: str, seconds: float, alone: float, size: float) -> dict[str, object]:
    return {
        "run": name,
        "time ratio": seconds / alone,
        "ms a test": 1e3 * seconds / TESTS,
        "hours for 1e6": MILLION * seconds / TESTS / 3600,
        "GB for 1e6": MILLION * size / 1e9,
    }
