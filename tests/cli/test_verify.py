"""Results are equal byte for byte over runs, hash seeds, threads and folders; `lacuna verify` says so, or not."""

from __future__ import annotations

import json
import os
from pathlib import Path
import shutil
import subprocess
import sys

import pytest
from typer.testing import CliRunner

from lacuna.analysis.settings import PAPER
from lacuna.cli.main import app
from lacuna.examples import HERE as EXAMPLES
from lacuna.verification import MADE_BY, MOST_ENTRIES, _content, _results_in

MODEL = """model Decay
  parameter Real k = 1;
  Real x(start=1, fixed=true);
  Real late = if x < 0.5 then 1 else 0;
equation
  der(x) = -k*x;
end Decay;
"""
HISTORY = "actuator,cycles,severity,low,high,event\n" + "".join(
    f"left,{n},{0.02 + 6e-5 * n:.5f},{0.015 + 6e-5 * n:.5f},{0.025 + 6e-5 * n:.5f},\n" for n in range(100, 3500, 100)
)
SIMULATE = ("simulate", "Decay.mo", "-p", "k=2", "--plot", "--event-rows")
FORECAST = ("forecast", "history.csv")
MAPS = ("maps", "--settings", "settings.toml")
SWEEP = ("sweep", "--settings", "settings.toml", "--points", "6", "--chunk", "2")
ASSESS = ("assess", "test.csv", "--map", "map")
EXPLAIN = ("explain", "missing-physics")
# The paper's test at a few severities.
COARSE = PAPER.read_text(encoding="utf-8").replace("step = 0.01", "step = 0.25")
INPUTS = ("Decay.mo", "history.csv", "settings.toml", "test.csv", "missing-physics", "map")
slow = pytest.mark.slow


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "Decay.mo").write_text(MODEL)
    (tmp_path / "history.csv").write_text(HISTORY)
    (tmp_path / "settings.toml").write_text(COARSE, encoding="utf-8")
    shutil.copy(EXAMPLES / "preflight" / "test.csv", tmp_path)
    shutil.copytree(EXAMPLES / "missing-physics", tmp_path / "missing-physics")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def made_by(*words: str) -> str:
    """Give a command as a user does, in a process of its own: what other tests left in this one is no part of it.
    Returns what it says."""
    command = [sys.executable, "-m", "lacuna.cli.main", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout + done.stderr


def status_of(*words: str) -> int:
    return CliRunner().invoke(app, list(words)).exit_code


def bytes_of(place: Path, folder: str, words: tuple[str, ...], seed: str, threads: str) -> dict[str, object]:
    """What a command writes in a place of its own, by a process of its own: every file but the pages, without the
    seconds that it took."""
    there = place / folder / "here"  # a diagnosis names its case by two folders
    there.mkdir(parents=True)
    for source in (p for p in place.iterdir() if p.name in INPUTS):
        (shutil.copytree if source.is_dir() else shutil.copy)(source, there / source.name)
    settings = os.environ | {"PYTHONHASHSEED": seed, "OMP_NUM_THREADS": threads, "OPENBLAS_NUM_THREADS": threads}
    command = [sys.executable, "-m", "lacuna.cli.main", *words, "--out", "out"]
    subprocess.run(command, cwd=there, env=settings, check=True, capture_output=True)
    files = (p for p in _results_in(there / "out") if p.suffix != ".html")
    return {p.relative_to(there).as_posix(): _content(p) for p in files}


@pytest.mark.parametrize(
    "words",
    [SIMULATE, FORECAST, SWEEP, *(pytest.param(words, marks=slow) for words in (MAPS, EXPLAIN, ASSESS))],
    ids=lambda words: words[0],
)
def test_equal_bytes_over_hash_seeds_threads_and_folders(place: Path, words: tuple[str, ...]) -> None:
    if words == ASSESS:
        assert status_of(*MAPS, "--prepare", "--out", "map") == 0
    one = bytes_of(place, "one", words, "1", "1")
    other = bytes_of(place, "another place", words, "2", "2")
    assert one
    assert {name for name in one if one[name] != other.get(name)} == set()


@pytest.mark.slow
@pytest.mark.parametrize("words", [MAPS, SWEEP, EXPLAIN], ids=lambda words: words[0])
def test_what_long_commands_make_is_verified(place: Path, words: tuple[str, ...]) -> None:
    made_by(*words, "--out", "out")
    said = CliRunner().invoke(app, ["verify", "out"])
    assert said.exit_code == 0, said.output


def test_a_result_is_verified_and_a_changed_one_is_not(place: Path) -> None:
    made_by(*SIMULATE, "--out", "out")
    said = CliRunner().invoke(app, ["verify", "out"])
    assert said.exit_code == 0, said.output
    figures = place / "out" / "Decay.csv"
    figures.write_text(figures.read_text().replace("0.1", "0.2", 1))
    said = CliRunner().invoke(app, ["verify", "out"])
    assert (said.exit_code, "not the same: Decay.csv" in said.output) == (1, True)


def test_verify_needs_the_inputs_as_they_were(place: Path) -> None:
    assert status_of(*SIMULATE, "--out", "out") == 0
    (place / "Decay.mo").write_text(MODEL.replace("k = 1", "k = 3"))
    said = CliRunner().invoke(app, ["verify", "out"])
    assert (said.exit_code, "Decay.mo is not what" in said.output) == (1, True)


@pytest.mark.parametrize("word", ["u=drive.csv", "u=drive.csv:u"])
def test_verify_needs_recorded_inputs_as_they_were(place: Path, word: str) -> None:
    (place / "Driven.mo").write_text(
        "model Driven\n  input Real u; Real x(start=0, fixed=true);\nequation\n  der(x) = u;\nend Driven;\n"
    )
    (place / "drive.csv").write_text("time,u\n0,0\n1,1\n")
    assert status_of("simulate", "Driven.mo", "--stop", "1", "-u", word, "--out", "out") == 0
    (place / "drive.csv").write_text("time,u\n0,0\n1,2\n")
    said = CliRunner().invoke(app, ["verify", "out"])
    assert (said.exit_code, "drive.csv is not what" in said.output) == (1, True)


FORGED = [
    {"command": ["lsp"]}, {"files": ["../x"]}, {"files": ["/etc/passwd"]}, {"inputs": []}, {"format": 1},
    {"command": ["simulate", "Decay.mo", "--watch"]}, {"command": ["simulate", "Decay.mo", "--out=elsewhere"]},
    {"command": ["assess", "test.csv", "--store", "postgresql://host/fleet"]},
    {"command": ["assess", "test.csv", "--store=sqlite:///fleet.db"]},
    {"command": ["sweep", "Decay.mo", "--scheduler", "tcp://host:8786"]},
]  # fmt: skip


@pytest.mark.parametrize("change", FORGED)
def test_verify_takes_no_orders_from_a_strangers_file(place: Path, change: dict[str, object]) -> None:
    assert status_of(*SIMULATE, "--out", "out") == 0
    record = place / "out" / MADE_BY
    record.write_text(json.dumps(json.loads(record.read_text()) | change))
    said = CliRunner().invoke(app, ["verify", "out"])
    assert (said.exit_code, "damaged" in said.output) == (1, True)


def test_verify_runs_foreign_code_only_where_it_is_asked_to(place: Path) -> None:
    """made-by.json is a stranger's: that it allows external code is not the word of who verifies."""
    source = """function f
  input Real x; output Real y;
  external "C" y = foreign(x) annotation(Include = "#include <stdio.h>
static double foreign(double x) { fclose(fopen(\\"ran\\", \\"w\\")); return x; }");
end f;
model X Real x = f(time); end X;
"""
    (place / "X.mo").write_text(source)
    made_by("simulate", "X.mo", "--model", "X", "--allow-external", "--out", "out")
    (place / "ran").unlink()
    said = CliRunner().invoke(app, ["verify", "out"])
    assert (said.exit_code, "--allow-external" in said.output) == (1, True)
    assert not (place / "ran").exists()
    assert status_of("verify", "out", "--allow-external") == 0
    assert (place / "ran").exists()


def test_a_folder_that_is_too_large_is_not_read_through(place: Path) -> None:
    """--data / read the whole disk, for the digest that verify compares."""
    (place / "data").mkdir()
    for count in range(MOST_ENTRIES + 2):
        (place / "data" / str(count)).touch()
    warned = made_by("simulate", "Decay.mo", "--data", "data", "--out", "out")
    assert f"warning: data holds more than {MOST_ENTRIES} files" in warned
    said = CliRunner().invoke(app, ["verify", "out"])
    assert said.exit_code == 0, said.output
