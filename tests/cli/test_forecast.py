"""`lacuna forecast`: the contract of its files, and its refusals."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest
from typer.testing import CliRunner

import lacuna
from lacuna.cli.main import app


@pytest.fixture
def history(tmp_path):
    """One part that grows linearly, one that is healthy, one that is new."""
    random, rows = np.random.default_rng(3), ["actuator,cycles,severity,low,high,event"]
    lives = {"left <b>": lambda n: 0.02 + 0.32 * n / 5000, "right": lambda n: 0.03, "new": lambda n: 0.02}
    for name, truth in lives.items():
        for n in np.arange(100, 3500.0 if name != "new" else 300.0, 100):
            z = max(0.0, truth(n) + 0.003 * random.standard_normal())
            rows.append(f"{name},{n:g},{z:.5f},{max(0, z - 0.006):.5f},{z + 0.006:.5f},")
    (tmp_path / "history.csv").write_text("\n".join(rows) + "\n")
    return tmp_path


def test_files_and_contract(history):
    done = CliRunner().invoke(app, ["forecast", str(history), "--out", str(history / "out")])
    assert done.exit_code == 0, done.output
    content = json.loads((history / "out" / "forecast.json").read_text())
    left, right, new = (content["actuators"][name] for name in ("left <b>", "right", "new"))
    assert [left["verdict"], right["verdict"], new["verdict"]] == ["forecast", "steady", "too_early"]
    for limit in ("orange", "red", "violet"):
        assert set(left[limit]) == {"median", "interval80", "interval95"}
    low, high = left["violet"]["interval95"]
    assert low < 5000 - 3400 < high and low < left["violet"]["median"] < high
    assert left["orange"]["median"] == 0
    first, last = left["probability"][0], left["probability"][-1]
    assert first["cycles"] == 3500 and first["violet"] < 1e-3 and last["violet"] > 0.9 and first["orange"] > 0.99
    assert 3400 <= left["advised_last_test"] < 5000 and new["advised_last_test"] is None
    assert sum(left["law"]["weights"].values()) == pytest.approx(1) and left["law"]["name"] in left["law"]["weights"]
    assert "reaches violet in" in left["sentence"] and "too early" in new["sentence"]
    assert left["sentence"] in done.output
    page = (history / "out" / "report.html").read_text()
    assert "left <b>" not in page and "left &lt;b&gt;" in page
    assert not re.search(r"""(src|href)=["']?(http|//)|<script(?!>// Figures)|url\(http""", page)
    assert (history / "out" / "right.png").exists()


def test_the_call_and_the_command_say_the_same(history):
    CliRunner().invoke(app, ["forecast", str(history), "--out", str(history / "out"), "--risk", "0.01"])
    content = json.loads((history / "out" / "forecast.json").read_text())["actuators"]
    assert lacuna.forecast(history, risk=0.01).content["actuators"] == content


def test_refusals_name_the_row_and_write_nothing(history):
    table = history / "history.csv"
    table.write_text(table.read_text() + "new,50,0.02,0.01,0.03,\n")
    done = CliRunner().invoke(app, ["forecast", str(history), "--out", str(history / "out")])
    assert done.exit_code == 1 and "do not increase" in done.output and not (history / "out").exists()
    done = CliRunner().invoke(app, ["forecast", str(history / "none")])
    assert done.exit_code == 1
    done = CliRunner().invoke(app, ["forecast", str(history), "--risk", "2"])
    assert done.exit_code == 1 and "probability" in done.output
