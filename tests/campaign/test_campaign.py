"""A campaign ends with the same bytes whatever is lost on the way: a worker, the client, or nothing."""

from __future__ import annotations

import json
import os
from pathlib import Path
import signal
import subprocess
import sys
import time

import numpy as np
import pyarrow.parquet as pq
import pytest

from analysis.campaign.points import chunks, sobol_points
from analysis.campaign.run import run_campaign
from analysis.campaign.work import Work
from analysis.errors import AnalysisError
from analysis.plant import ModelPlant
from analysis.settings import PAPER, load_settings
from codegen.compile import compile_model

ROOT = Path(__file__).resolve().parents[2]
COUNT, CHUNK = 48, 4

CLIENT = """
import sys
from pathlib import Path
from tests.campaign.test_campaign import CHUNK, short_test
from analysis.campaign.run import run_campaign
work, points = short_test(Path(sys.argv[1]))
run_campaign(work, points, Path(sys.argv[1]), scheduler=sys.argv[2], chunk=CHUNK)
"""


def short_test(folder: Path) -> tuple[Work, dict[str, np.ndarray]]:
    """The paper's test with a quarter of its length, and a design over its fault and nuisances."""
    text = (
        PAPER.read_text(encoding="utf-8")
        .replace("duration = 1.0", "duration = 0.25")
        .replace("after = 0.3", "after = 0.1")
    )
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "settings.toml"
    path.write_text(text, encoding="utf-8")
    settings = load_settings(path)
    compiled = compile_model(settings.disturbed_model)
    plant = ModelPlant.of(compiled, settings)
    work = Work(compiled.name, Path(compiled.path).read_bytes(), compiled.hash, text, "dopri5")
    return work, sobol_points(settings, COUNT, plant)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("undisturbed")
    work, points = short_test(folder)
    return run_campaign(work, points, folder, chunk=CHUNK)


def test_design_fills_the_fault_axis_and_goes_on_where_a_shorter_one_ended():
    settings = load_settings()
    plant = ModelPlant.of(compile_model(settings.disturbed_model), settings)
    long, short = sobol_points(settings, 256, plant), sobol_points(settings, 100, plant)
    assert all(np.array_equal(long[name][:100], short[name]) for name in long)
    counts, _ = np.histogram(long["zeta"], bins=16, range=(0.0, 0.5))
    assert np.all(counts == 16)
    assert np.median(long["V"]) == pytest.approx(28.0, rel=1e-3)
    assert 0 <= long["backlash"].min() < 1e-4 and 1.9e-3 < long["backlash"].max() <= 2e-3


def test_chunks_keep_order_and_number():
    points = {"a": np.arange(10.0), "b": -np.arange(10.0)}
    pieces = chunks(points, 4)
    assert [len(p["a"]) for p in pieces] == [4, 4, 2]
    assert np.array_equal(np.concatenate([p["b"] for p in pieces]), points["b"])


def test_rows_are_those_of_single_simulations(undisturbed, tmp_path):
    _, points = short_test(tmp_path)
    table = pq.read_table(undisturbed)
    assert table.num_rows == COUNT
    assert table["failure"].null_count == COUNT
    settings = load_settings(tmp_path / "settings.toml")
    plant = ModelPlant.of(compile_model(settings.disturbed_model), settings, "dopri5")
    record = plant.run(points["zeta"][7], **{n: v[7] for n, v in points.items() if n != "zeta"})
    rms = np.sqrt(np.mean(record.currents**2, axis=1))
    assert [table[f"rms_{k + 1}"][7].as_py() for k in range(3)] == pytest.approx(rms, rel=1e-12)


def test_a_point_that_cannot_be_simulated_is_a_row_that_says_why(tmp_path):
    work, points = short_test(tmp_path)
    few = {name: values[:2].copy() for name, values in points.items()}
    few["zeta"][1] = 2.0
    table = pq.read_table(run_campaign(work, few, tmp_path))
    assert table["failure"][0].as_py() is None
    assert "zeta" in table["failure"][1].as_py()
    assert table["rms_mean"][1].as_py() is None


def test_no_scheduler_is_said_in_a_sentence(tmp_path):
    work, points = short_test(tmp_path)
    with pytest.raises(AnalysisError, match="no Dask scheduler answers at"):
        run_campaign(work, points, tmp_path, scheduler="tcp://127.0.0.1:1")


def test_killed_worker_and_killed_client_lose_nothing(undisturbed, tmp_path):
    environment = os.environ | {"PYTHONPATH": str(ROOT), "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "10"}
    started: list[subprocess.Popen] = []

    def start(*command: str) -> subprocess.Popen:
        process = subprocess.Popen(
            [sys.executable, *command], cwd=ROOT, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        started.append(process)
        return process

    address_file = tmp_path / "scheduler.json"
    folder = tmp_path / "campaign"
    start(
        "-m", "distributed.cli.dask_scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", str(address_file)
    )
    try:
        _wait(address_file.exists)
        address = json.loads(address_file.read_text())["address"]
        worker = ["-m", "distributed.cli.dask_worker", address, "--no-nanny", "--nthreads", "1", "--no-dashboard"]
        first = start(*worker)
        client = start("-c", CLIENT, str(folder), address)
        _wait(lambda: len(list(folder.glob("parts/*.parquet"))) >= 2)
        first.send_signal(signal.SIGKILL)
        start(*worker)
        _wait(lambda: len(list(folder.glob("parts/*.parquet"))) >= 5)
        client.send_signal(signal.SIGKILL)
        client.wait()
        finished_before = {p.name: p.stat().st_mtime_ns for p in folder.glob("parts/*.parquet")}
        assert 5 <= len(finished_before) < COUNT // CHUNK, "the client ended before it could be killed"
        assert start("-c", CLIENT, str(folder), address).wait(timeout=120) == 0
    finally:
        for process in started:
            process.kill()
            process.wait()
    for name, when in finished_before.items():
        assert (folder / "parts" / name).stat().st_mtime_ns == when, "a finished chunk was computed again"
    assert (folder / "results.parquet").read_bytes() == undisturbed.read_bytes()


def _wait(condition, seconds: float = 90.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited too long"
        time.sleep(0.02)
