"""The robustness study: its statistics on cases with known answers, its resuming, and what it finds."""

from __future__ import annotations

import numpy as np
import pytest

from lacuna.analysis.report.robustness import alarms, write_study
from lacuna.analysis.settings import load_settings
from lacuna.analysis.severity.prepared import Prepared
from lacuna.analysis.severity.robustness import Rate, Results, error_shares, roc, run_tests
from tests.analysis.plants import ReferencePlant


def results_of(severity, **given) -> Results:
    severity = np.asarray(severity, dtype=float)
    fields = {"estimate": severity, "low": severity, "high": severity, "misfit": 0 * severity, "paper": severity}
    said = {"covered": severity >= 0, "warned": severity < 0}
    return Results(severity=severity, z=np.zeros((len(severity), 4)), **(said | fields | given))


def test_wilson_interval_of_a_share():
    assert Rate(0, 100).interval == pytest.approx((0.0, 0.0370), abs=1e-4)
    assert Rate(50, 100).interval == pytest.approx((0.4038, 0.5962), abs=1e-4)
    assert Rate(0, 0).interval == (0.0, 1.0)


def test_roc_of_perfect_useless_and_known_scores():
    sick = np.array([False, False, True, True])
    assert roc(sick, np.array([0.1, 0.2, 0.3, 0.4]))[2] == 1.0
    assert roc(sick, np.array([0.4, 0.3, 0.2, 0.1]))[2] == 0.0
    assert roc(sick, np.array([0.1, 0.35, 0.3, 0.4]))[2] == 0.75


def test_the_nuisance_that_makes_the_error_is_found():
    z = np.random.default_rng(3).uniform(-1.7, 1.7, size=(500, 4))
    results = results_of(np.zeros(500))
    results = Results(**(vars(results) | {"z": z}))
    shares = error_shares(results, 0.3 * z[:, 2] + 0.1 * z[:, 2] ** 2)
    assert shares[2] == pytest.approx(1.0)
    assert max(shares[0], shares[1], shares[3]) < 0.1


def test_alarms_by_each_method():
    settings = load_settings()
    results = results_of([0.25, 0.25], high=np.array([0.26, 0.28]), paper=np.array([0.266, 0.264]))
    by_paper, by_ours = alarms(settings, results)
    assert by_paper.tolist() == [True, False]
    assert by_ours.tolist() == [False, True]


def test_a_study_resumes_and_beats_the_mean_rms(tmp_path, map_folder):
    prepared = Prepared(map_folder)
    plant, progress = ReferencePlant(), []
    study = (prepared, tmp_path / "store", 64)
    results = run_tests(plant, *study, progress=lambda *call: progress.append(call))
    assert len(plant.runs) == 64 and progress[-1] == (64, 64)

    again = ReferencePlant()
    repeated = run_tests(again, *study, jobs=1)
    assert again.runs == []
    np.testing.assert_array_equal(repeated.estimate, results.estimate)

    ours, paper = results.estimate - results.severity, results.paper - results.severity
    assert np.sqrt((ours**2).mean()) < 0.015
    assert np.sqrt((paper**2).mean()) > 0.06

    assert results.covered.all()
    stranger = {"name": "a dragging brake", "parameters": ["tau_c", "V"], "factor": [3.0, 0.8]}
    strange = run_tests(ReferencePlant(), prepared, tmp_path / "store", 16, stranger=stranger)
    assert not strange.covered.any()

    write_study(prepared.settings, results, [(stranger["name"], strange)], tmp_path / "docs")
    page = (tmp_path / "docs" / "robustness.md").read_text()
    assert "| a dragging brake | 100.0 % | 0.0 % | 0.0 % | - |" in page
    assert "64 simulated pre-flight tests" in page and "{" not in page
    assert (tmp_path / "docs" / "figures" / "robustness.svg").exists()
