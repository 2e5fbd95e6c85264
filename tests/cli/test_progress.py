"""How far long work is: lines of JSON for programs, nothing where it is to be quiet."""

from __future__ import annotations

import io
import json
from pathlib import Path
import time
from typing import Any

import pytest
from typer.testing import CliRunner

import lacuna
from lacuna.cli.main import app
from lacuna.cli.progress import Pace, progress

pytest.importorskip("dask", reason="dask is not installed")

LONG = [
    ["sweep", "--points", "24"],
    ["maps", "Actuators.EccentricBldc", "--no-figures"],
    ["simulate", "Actuators.EccentricBldc"],
]


def run(words: list[str], out: Path) -> Any:
    return CliRunner().invoke(app, [*words, "--out", str(out)])


@pytest.mark.parametrize("words", LONG, ids=lambda words: words[0])
def test_json_says_how_far_it_is_in_lines(words: list[str], tmp_path: Path) -> None:
    done = run([*words, "--json"], tmp_path)
    assert done.exit_code == 0, done.stderr
    json.loads(done.stdout)
    lines = [json.loads(line) for line in done.stderr.splitlines()]
    assert lines and all(set(line) == {"progress", "share", "elapsed", "left"} for line in lines)
    shares = [line["share"] for line in lines if line["share"] is not None]
    assert all(0 <= share <= 1 for share in shares) and max(shares) == 1


def test_quiet_says_nothing(tmp_path: Path) -> None:
    for more in (["--quiet"], ["--quiet", "--json"]):
        assert run([*LONG[0], *more], tmp_path / more[-1]).stderr == ""


def test_every_long_command_takes_both() -> None:
    for name in ("maps", "sweep", "explain", "forecast", "fleet", "assess", "simulate", "compare", "verify"):
        said = CliRunner().invoke(app, [name, "--help"], env={"COLUMNS": "200"}).stdout
        assert "--json" in said and "--quiet" in said, name


def test_the_time_left_is_that_of_the_present_stage() -> None:
    clock = iter([0.0, 0.0, 10.0, 100.0, 101.0, 103.0]).__next__
    pace = Pace(clock)
    assert pace.left(0.0) is None
    assert pace.left(0.25) == pytest.approx(30.0)
    assert pace.left(0.0) is None  # another stage begins
    assert pace.left(0.5) == pytest.approx(1.0)
    assert pace.left(None) is None


def test_of_a_search_nobody_knows_the_time_left(tmp_path: Path) -> None:
    """Its limit is no share of it: it may end long before."""
    case = Path(lacuna.__file__).parent / "examples" / "missing-physics"
    done = run(["explain", str(case), "--limit", "1", "--json"], tmp_path)
    assert done.exit_code == 0, done.stderr
    lines = [json.loads(line) for line in done.stderr.splitlines()]
    assert lines and all((line["share"], line["left"]) == (None, None) for line in lines)


def test_the_limit_of_a_search_is_shown_in_place_of_the_time_left(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")  # as to a terminal
    monkeypatch.setenv("COLUMNS", "120")
    stderr = io.StringIO()
    monkeypatch.setattr("sys.stderr", stderr)
    with progress(90.0) as tell:
        tell("fitting", None)
        time.sleep(0.3)  # the bar is drawn ten times a second
    assert "fitting" in stderr.getvalue() and "limit 1 min 30 s" in stderr.getvalue()
