"""Dated diagnoses of `lacuna explain` as a history: which quantity drifts, and when it reaches its limit."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scipy.signal import lfilter
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
    """Damping and backlash grow by many of their standard deviations; inertia stays."""
    damping = r"d \(0\.05\d* to 0\.0[78]\d*, healthy 0\.05, drifts by \+\d\d"
    inertia = r"J \(0\.2001 to 0\.2001, healthy 0\.2, drifts by \+0\.0 standard deviations\)$"
    with pytest.raises(AnalysisError, match=rf"what limit\? There are {damping}.*backlash@gear.gap .*{inertia}"):
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
    with pytest.raises(AnalysisError, match=r"t100.*there is no such file"):
        lacuna.forecast(series, limits={"d": 0.1})
    done = CliRunner().invoke(app, ["forecast", str(series), "--limit", "d"])
    assert done.exit_code != 0 and "NAME=VALUE" in done.output


OVEN = """
model Oven "An oven whose insulation is believed to be new"
  input Real P(unit="W") "Power of the heater";
  parameter Real C(unit="J/K", min=1e-9) = 400 "Heat capacity";
  parameter Real G(unit="W/K", min=0) = 2 "Loss to the room";
  Real dT(unit="K", start=0, fixed=true) "Temperature over the room";
equation
  C*der(dT) = P - G*dT;
end Oven;
"""
CASE = """
model = "Oven.mo:Oven"
[signals.P]
role = "input"
variable = "P"
unit = "W"
interpolation = "hold"
[signals.dT]
role = "output"
variable = "dT"
unit = "K"
[recordings]
fit = ["0.csv", "1.csv"]
validate = ["2.csv"]
"""


def oven(folder, loss, seed):
    """A case of recordings of an oven that loses `loss` W/K, solved exactly from sample to sample."""
    folder.mkdir()
    (folder / "Oven.mo").write_text(OVEN)
    (folder / "case.toml").write_text(CASE)
    random, step, samples = np.random.default_rng(seed), 2.0, 600
    kept = np.exp(-loss / 400 * step)
    for k in range(3):
        time = np.arange(samples) * step
        power = np.where(time // (150 + 40 * k) % 2 == 0, 120.0, 20.0 * k)
        risen = lfilter([0, 1 - kept], [1, -kept], power) / loss
        rows = np.column_stack([time, power, risen + random.normal(0, 0.05, samples)])
        np.savetxt(folder / f"{k}.csv", rows, delimiter=",", header="time,P,dT", comments="", fmt="%.6g")


@pytest.mark.slow
def test_from_dated_recordings_and_a_model_to_the_use_that_remains(tmp_path):
    """Insulation that fails by 10 % of its loss in 100 hours, watched for 600: 900 remain to a loss of 5 W/K."""
    hours = np.arange(0, 700, 100)
    rows = ["actuator,hours,diagnosis"]
    for n in hours:
        oven(tmp_path / f"day{n}", 2 + 0.2 * n / 100, int(n))
        rows.append(f"oven,{n},day{n}")
    (tmp_path / "history.csv").write_text("\n".join(rows) + "\n")
    with pytest.raises(AnalysisError, match=r"There are G \([12][.\d]* to 3\.[12]\d*, healthy 2, drifts by \+\d+"):
        lacuna.forecast(tmp_path, out=tmp_path / "out")
    explained = sorted((tmp_path / "out" / "diagnoses").glob("*/diagnosis.json"))
    assert len(explained) == len(hours)
    written = [path.stat().st_mtime_ns for path in explained]
    own = lacuna.forecast(tmp_path, out=tmp_path / "out", limits={"G": 5.0})["oven"]
    low, high = own["limit"]["interval95"]
    assert own["verdict"] == "forecast" and low < 900 < high
    assert [path.stat().st_mtime_ns for path in explained] == written  # not explained again
