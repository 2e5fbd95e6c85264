"""A campaign ends with the same bytes whatever is lost on the way: a worker, the client, or nothing."""

from __future__ import annotations

from functools import partial
import json
import os
from pathlib import Path
import signal
import socket
import subprocess
import sys
import time
from urllib.parse import urlsplit

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from lacuna.analysis.campaign.clients import client_of
from lacuna.analysis.campaign.points import chunks, sobol_points
from lacuna.analysis.campaign.run import run_campaign
from lacuna.analysis.campaign.work import Work
from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.files import has_part, write_part
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.settings import PAPER, load_settings
from lacuna.codegen.compile import compile_model

ROOT = Path(__file__).resolve().parents[2]
COUNT, CHUNK = 48, 4  # of the short test; the long one has 2000 points

CLIENT = """
import sys
from pathlib import Path
from tests.campaign.test_campaign import short_test
from analysis.campaign.run import run_campaign
work, points = short_test(Path(sys.argv[1]), int(sys.argv[3]))
run_campaign(work, points, Path(sys.argv[1]), scheduler=sys.argv[2], chunk=int(sys.argv[4]))
"""


def short_test(folder: Path, count: int = COUNT) -> tuple[Work, dict[str, np.ndarray]]:
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
    return work, sobol_points(settings, count, plant)


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


@pytest.mark.parametrize("processes", [False, True])
def test_workers_of_our_own_are_at_any_free_port_and_for_this_machine_alone(processes, recwarn):
    """Dask's pages were at port 8787 of every network, with a warning where another sweep had it."""
    local = {"n_workers": 1, "threads_per_worker": 1, "processes": processes}
    with client_of(None, **local) as one, client_of(None, **local) as other:
        for client in (one, other):
            pages = [worker["services"]["dashboard"] for worker in client.scheduler_info()["workers"].values()]
            pages += [urlsplit(client.dashboard_link).port]
            assert len(pages) == 2 and all(map(_refused_elsewhere, pages))
    assert not [w for w in recwarn if "already in use" in str(w.message)]


def _refused_elsewhere(port: int) -> bool:
    """Whether nobody answers at an address of this machine other than the one that it has for itself."""
    with socket.socket() as one:
        one.settimeout(1.0)
        return one.connect_ex(("127.0.0.2", port)) != 0


def test_killed_worker_and_killed_client_lose_nothing(undisturbed, tmp_path):
    disturbed = killed_twice(tmp_path, COUNT, CHUNK)
    assert disturbed.read_bytes() == undisturbed.read_bytes()


def test_a_lost_scheduler_is_said_and_loses_nothing(undisturbed, tmp_path):
    folder, started = tmp_path / "campaign", []
    try:
        address = _scheduler(tmp_path, started)
        worker = ["-m", "distributed.cli.dask_worker", address, "--no-nanny", "--nthreads", "1", "--no-dashboard"]
        _start(started, *worker)
        client = _start(started, "-c", CLIENT, str(folder), address, str(COUNT), str(CHUNK), said=tmp_path / "said")
        _wait(lambda: len(list(folder.glob("parts/*.parquet"))) >= 2)
        started[0].kill()
        assert client.wait(timeout=240) == 1
    finally:
        _end(started)
    assert "AnalysisError: the Dask scheduler or its workers were lost" in (tmp_path / "said").read_text()
    work, points = short_test(folder)
    assert run_campaign(work, points, folder, chunk=CHUNK).read_bytes() == undisturbed.read_bytes()


@pytest.mark.slow
def test_two_thousand_points_killed_twice_end_with_the_same_bytes(tmp_path):
    work, points = short_test(tmp_path / "undisturbed", 2000)
    undisturbed = run_campaign(work, points, tmp_path / "undisturbed", chunk=16)
    assert killed_twice(tmp_path, 2000, 16).read_bytes() == undisturbed.read_bytes()
    assert pq.read_table(undisturbed).num_rows == 2000


def killed_twice(base: Path, count: int, chunk: int) -> Path:
    """results.parquet of a campaign whose worker is killed after a sixth of its chunks, and its client after two."""
    started: list[subprocess.Popen] = []
    chunks_in_all = -(-count // chunk)
    folder = base / "campaign"
    start = partial(_start, started)
    try:
        address = _scheduler(base, started)
        worker = ["-m", "distributed.cli.dask_worker", address, "--no-nanny", "--nthreads", "1", "--no-dashboard"]
        run = ["-c", CLIENT, str(folder), address, str(count), str(chunk)]
        first, client = start(*worker), start(*run)
        _wait(lambda: len(list(folder.glob("parts/*.parquet"))) >= chunks_in_all // 6)
        first.send_signal(signal.SIGKILL)
        start(*worker)
        _wait(lambda: len(list(folder.glob("parts/*.parquet"))) >= chunks_in_all // 3)
        client.send_signal(signal.SIGKILL)
        client.wait()
        finished_before = {p.name: p.stat().st_mtime_ns for p in folder.glob("parts/*.parquet")}
        assert chunks_in_all // 3 <= len(finished_before) < chunks_in_all, "the client ended before it could be killed"
        assert start(*run).wait(timeout=1800) == 0
    finally:
        _end(started)
    for name, when in finished_before.items():
        assert (folder / "parts" / name).stat().st_mtime_ns == when, "a finished chunk was computed again"
    return folder / "results.parquet"


def _start(started: list[subprocess.Popen], *command: str, said: Path = Path(os.devnull)) -> subprocess.Popen:
    environment = os.environ | {"PYTHONPATH": str(ROOT), "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "10"}
    with said.open("w") as errors:
        process = subprocess.Popen(
            [sys.executable, *command], cwd=ROOT, env=environment, stdout=subprocess.DEVNULL, stderr=errors
        )
    started.append(process)
    return process


def _scheduler(base: Path, started: list[subprocess.Popen]) -> str:
    """The address of a scheduler of its own, the first that is started."""
    file = base / "scheduler.json"
    _start(
        started, "-m", "distributed.cli.dask_scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", str(file)
    )
    _wait(lambda: file.exists() and file.stat().st_size > 0)
    return json.loads(file.read_text())["address"]


def _end(started: list[subprocess.Popen]) -> None:
    for process in started:
        process.kill()
        process.wait()


def _wait(condition, seconds: float = 600.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited too long"
        time.sleep(0.02)


def test_a_damaged_part_is_as_good_as_none(tmp_path):
    table, path = pa.table({"x": np.arange(1000.0), "failure": pa.nulls(1000, pa.string())}), tmp_path / "part.parquet"
    assert not has_part(path)
    write_part(path, table)
    assert has_part(path)
    whole = path.read_bytes()
    flipped = bytearray(whole)
    flipped[len(whole) // 3] ^= 1
    for damaged in (b"", b"PAR1", whole[: len(whole) // 2], whole[:-1], bytes(flipped), b"time,x\n0,1\n"):
        path.write_bytes(damaged)
        assert not has_part(path)


def test_a_sweep_computes_a_damaged_part_again(undisturbed, tmp_path):
    work, points = short_test(tmp_path)
    few = {name: values[:8] for name, values in points.items()}
    first = run_campaign(work, few, tmp_path, chunk=4).read_bytes()
    for part in (tmp_path / "parts").iterdir():
        part.write_bytes(b"PAR1")
    assert run_campaign(work, few, tmp_path, chunk=4).read_bytes() == first


def test_a_part_of_another_place_or_program_is_computed_again(undisturbed, tmp_path):
    work, points = short_test(tmp_path)
    few = {name: values[:8] for name, values in points.items()}
    first = run_campaign(work, few, tmp_path, chunk=4).read_bytes()
    one, other = sorted((tmp_path / "parts").iterdir())
    other.write_bytes(one.read_bytes())
    assert run_campaign(work, few, tmp_path, chunk=4).read_bytes() == first
    rows = pq.read_table(one)
    failure = rows.schema.get_field_index("failure")
    pq.write_table(rows.set_column(failure, "failure", pa.nulls(len(rows))).replace_schema_metadata(), one)
    assert run_campaign(work, few, tmp_path, chunk=4).read_bytes() == first
