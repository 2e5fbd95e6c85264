"""Dated diagnoses of `lacuna explain` as a history: which quantity drifts, and when it reaches its limit."""

from __future__ import annotations

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import lacuna
from lacuna.analysis.errors import AnalysisError
from lacuna.cli.main import app

USE = np.arange(100, 2600, 100)
STD = 0.002


def diagnosis(folder, friction, backlash=None):
    folder.mkdir(parents=True)
    content = {
        "parameters": {
            "d": {"believed": 0.05, "value": friction, "std": STD, "unit": "N.m.s/rad"},
            "J": {"believed": 0.2, "value": 0.2001, "std": 0.001, "unit": "kg.m2"},
        },
        "findings": [],
    }
    if backlash is not None:
        gap = {"gap": {"value": backlash, "std": 1e-4, "unit": "rad"}}
        content["findings"].append({"effect": "backlash", "location": "gear", "parameters": gap})
    (folder / "diagnosis.json").write_text(json.dumps(content))


@pytest.fixture
def series(tmp_path):
    """Damping that doubles in 4000 cycles, backlash that is seen from cycle 1000 on and grows as 1e-6 a cycle."""
    random, rows = np.random.default_rng(2), ["actuator,cycles,diagnosis"]
    for n in USE:
        gap = 1e-6 * n + 5e-5 * random.standard_normal() if n >= 1000 else None
        diagnosis(tmp_path / f"t{n}", 0.05 * (1 + n / 4000) + STD * random.standard_normal(), gap)
        rows.append(f"A,{n},t{n}")
    (tmp_path / "history.csv").write_text("\n".join(rows) + "\n")
    return tmp_path


def test_a_parameter_and_an_effect_reach_their_limits(series):
    limits = ["--limit", "d=0.1", "--limit", "backlash@gear.gap=0.004"]
    done = CliRunner().invoke(app, ["forecast", str(series), *limits, "--out", str(series / "out")])
    assert done.exit_code == 0, done.output
    own = json.loads((series / "out" / "forecast.json").read_text())["actuators"]["A"]
    found = {own["fault"]: own} | own["faults"]
    assert set(found) == {"d", "backlash@gear.gap"}
    for name, life in (("d", 4000), ("backlash@gear.gap", 4000)):
        low, high = found[name]["limit"]["interval95"]
        assert found[name]["verdict"] == "forecast" and low < life - USE[-1] < high
    assert found["backlash@gear.gap"]["tests"] == 16


def test_a_limit_below_the_healthy_value_is_one_too(series):
    """J stays: a limit on either side of it is not in sight."""
    for limit in (0.15, 0.25):
        assert lacuna.forecast(series, limits={"J": limit})["A"]["verdict"] == "steady"


def test_without_a_limit_what_drifts_is_named_first(series):
    with pytest.raises(AnalysisError, match=r"what limit\? There are d \(0\.0\d+, healthy 0\.05\), J"):
        lacuna.forecast(series)


@pytest.mark.parametrize(
    ("limits", "message"), [({"e": 1.0}, "no quantity 'e'; there are d"), ({"d": 0.05}, "0.05 is healthy")]
)
def test_what_is_no_limit_is_refused(series, limits, message):
    with pytest.raises(AnalysisError, match=message):
        lacuna.forecast(series, limits=limits)


def test_what_is_no_diagnosis_is_refused(series):
    (series / "t100" / "diagnosis.json").write_text('{"parameters": {"d": 3}}')
    with pytest.raises(AnalysisError, match=r"t100.*not a diagnosis"):
        lacuna.forecast(series, limits={"d": 0.1})
    (series / "t100" / "diagnosis.json").unlink()
    with pytest.raises(AnalysisError, match=r"t100.*is missing"):
        lacuna.forecast(series, limits={"d": 0.1})
    done = CliRunner().invoke(app, ["forecast", str(series), "--limit", "d"])
    assert done.exit_code != 0 and "NAME=VALUE" in done.output
