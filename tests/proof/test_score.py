"""Scoring: what counts as right, and the figures over many cases."""

import json
import math
import sys

import pytest

from tests.proof.report import page
from tests.proof.runner import diagnose
from tests.proof.score import coverage, gain_share, score, score_folder, wilson


def _truth(kind="effect", verdict="missing_physics", effects=("friction.coulomb",)):
    listed = [
        {
            "effect": e,
            "location": "shaft",
            "accept_locations": ["shaft"],
            "parameters": {"tau_c": {"value": 0.002, "unit": "N.m", "aliases": ["Tc"]}},
        }
        for e in effects
    ]
    return {
        "kind": kind,
        "model": "Benches.DcServo",
        "verdict": verdict,
        "accept_verdicts": [verdict],
        "effects": listed,
        "true_parameters": {"R": 3.5},
        "nrmse": {k: {"refit_believed": 0.1, "floor": 0.01} for k in ("fit", "validate")},
    }


def _diagnosis(effect="friction.coulomb", location="shaft", after=0.02, std=1e-4):
    finding = {
        "effect": effect,
        "location": location,
        "parameters": {"Tc": {"value": 0.0021, "std": std, "unit": "N.m"}},
    }
    return {
        "verdict": "missing_physics",
        "findings": [finding],
        "nrmse": {"validate": {"before": 0.1, "after": after}},
        "parameters": {"R": {"value": 3.6, "std": 0.02}},
    }


def test_right_finding():
    s = score("c", _diagnosis(), _truth())
    assert s.verdict_right
    assert s.first_right
    assert s.location_right
    assert s.all_right
    assert s.gain_share == pytest.approx(math.log(5) / math.log(10))
    assert [(e.name, e.covered) for e in s.estimates] == [("tau_c", True), ("R", False)]
    assert coverage([s]) == (1, 2)


def test_wrong_effect_and_wrong_place():
    assert not score("c", _diagnosis("backlash"), _truth()).first_right
    elsewhere = score("c", _diagnosis(location="winding"), _truth())
    assert elsewhere.first_right
    assert not elsewhere.location_right
    assert not elsewhere.all_right


def test_finding_on_a_null_is_false():
    assert score("c", _diagnosis(), _truth("consistent", "consistent", ())).false_finding
    quiet = {"verdict": "consistent", "findings": []}
    assert not score("c", quiet, _truth("consistent", "consistent", ())).false_finding


def test_no_diagnosis_is_wrong_and_gains_nothing():
    s = score("c", {}, _truth())
    assert not s.verdict_right
    assert not s.first_right
    assert s.gain_share == 0


def test_gain_share_and_interval():
    assert gain_share(0.1, 0.01, 0.01) == 1
    assert gain_share(0.1, 0.2, 0.01) < 0
    assert gain_share(0.0101, 0.01, 0.01) is None
    low, high = wilson(0, 60)
    assert low == 0
    assert high == pytest.approx(0.060, abs=0.002)


FAKE = """import json, pathlib, sys
out = pathlib.Path(sys.argv[3]); out.mkdir()
(out / "diagnosis.json").write_text(json.dumps({"verdict": "consistent", "findings": [], "saw": sys.argv[1]}))
"""


def test_runner_resumes_and_hides_the_rest(tmp_path):
    tool, case = tmp_path / "tool.py", tmp_path / "cases" / "c001"
    tool.write_text(FAKE)
    case.mkdir(parents=True)
    (case / "case.toml").write_text("title = 'x'")
    command = [sys.executable, str(tool)]
    assert diagnose(command, case, tmp_path / "out", "v1", 60) == "ok"
    seen = json.loads((tmp_path / "out" / "diagnosis.json").read_text())["saw"]
    assert str(tmp_path) not in seen  # it worked on a copy: no truth beside it
    assert diagnose(command, case, tmp_path / "out", "v1", 60) == "kept"
    (case / "case.toml").write_text("title = 'y'")
    assert diagnose(command, case, tmp_path / "out", "v1", 60) == "ok"
    assert diagnose([sys.executable, "-c", "import sys; sys.exit(3)"], case, tmp_path / "out", "v2", 60) == "exit 3"
    assert not (tmp_path / "out" / "diagnosis.json").exists()


def test_page_reports_right_and_wrong():
    right = score("c001", _diagnosis(), _truth())
    wrong = score("c002", _diagnosis("backlash"), _truth())
    text = page([right, wrong], [right, wrong], seed=2, all_cases=3, version="")
    assert "1 of 2 = 50%" in text
    assert "2 of 3 cases" in text
    assert "backlash 1" in text


def test_out_of_time_is_never_right(tmp_path):
    case, truth = tmp_path / "cases" / "c001", tmp_path / "truth"
    case.mkdir(parents=True)
    truth.mkdir()
    (truth / "c001.toml").write_text(
        """kind = "weak"
model = "Benches.Joint"
accept_verdicts = ["undetermined", "consistent"]
[nrmse]
fit = {refit_believed = 0.1, floor = 0.1}
validate = {refit_believed = 0.1, floor = 0.1}
[true_parameters]
"""
    )
    sleeper = [sys.executable, "-c", "import time; time.sleep(60)"]
    assert diagnose(sleeper, case, tmp_path / "out" / "c001", "v1", 0.2) == "out of time"
    (score,) = score_folder(tmp_path / "out", truth, ["c001"])
    assert score.verdict == "out of time"
    assert not score.verdict_right
