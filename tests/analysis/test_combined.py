"""Two faults at once: the joint estimate in closed cases, where it must give up, and a recording from end to end."""

from __future__ import annotations

from dataclasses import replace
import json
import shutil

import numpy as np
import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.recording.recordings import Refusal
from lacuna.analysis.settings import load_settings
from lacuna.analysis.severity.combined.assessment import assess_both
from lacuna.analysis.severity.combined.estimate import JointEstimator
from lacuna.analysis.severity.combined.figures import draw_estimate
from lacuna.analysis.severity.combined.grid import GRID_FILE, Grid, build_grid, load_grid, other_fault
from lacuna.analysis.severity.combined.report import write_studies
from lacuna.analysis.severity.combined.study import run_study
from lacuna.analysis.severity.preparation import TABLE_FILE
from lacuna.analysis.severity.severity_table import SeverityTable
from tests.analysis.plants import ReferencePlant, paper_settings
from tests.analysis.reference import declared, simulate
from tests.analysis.test_assessment import COLUMNS, write

SIGMA, N = 0.01, 16
U, V = np.eye(N)[0], (np.eye(N)[0] + np.eye(N)[1]) / np.sqrt(2)
FRICTION = """
[[combined]]
symbol = "friction"
parameter = "tau_c"
name = "dry friction"
unit = "times nominal"
scale = 10.68719
first = 0.046785
last = 0.28071
step = 0.046785
"""


def linear_grid(u: np.ndarray, v: np.ndarray) -> Grid:
    """The signature grows by `u` over the first axis and by `v` over the second, both from 0 to 1 of their range."""
    settings = load_settings()
    other = replace(settings.fault, symbol="other", first=0.0, last=0.5, step=0.05)
    axis = np.linspace(0, 0.5, 11)
    mean = axis[:, None, None] * u + axis[None, :, None] * v
    return Grid(
        settings, other, axis, axis, mean[None], np.tile(SIGMA**2 * np.eye(N), (1, 11, 11, 1, 1)), np.zeros((11, 3, 2))
    )


def test_estimate_interval_and_correlation_are_the_closed_ones():
    found = JointEstimator(linear_grid(U, V)).estimate(0.2 * U + 0.3 * V)
    information = np.array([[U @ U, U @ V], [U @ V, V @ V]]) / SIGMA**2
    covariance = np.linalg.inv(information)
    deviation = np.sqrt(np.diagonal(covariance))
    for reading, truth, sigma in zip((found.first, found.second), (0.2, 0.3), deviation, strict=True):
        assert reading.severity == pytest.approx(truth, abs=1e-3)
        assert reading.high - reading.low == pytest.approx(2 * 1.96 * sigma, rel=0.02)
        assert reading.readable
    assert found.correlation == pytest.approx(covariance[0, 1] / deviation.prod(), abs=0.01)
    assert found.misfit == pytest.approx(0, abs=1e-6) and found.covered


def test_faults_with_one_and_the_same_effect_are_not_told_apart():
    found = JointEstimator(linear_grid(U, U)).estimate(0.5 * U)
    assert found.correlation < -0.99
    assert not found.first.readable and not found.second.readable
    assert found.first.high - found.first.low > 0.4


@pytest.mark.parametrize("first", [0.0, 0.5])
@pytest.mark.parametrize("second", [0.0, 0.5])
def test_a_reading_at_the_end_of_an_axis_lies_in_its_own_interval(first, second):
    """A healthy actuator read 0 below an interval that began a little above it: no figure, no row of a history."""
    estimator = JointEstimator(linear_grid(100 * U, 100 * V))
    found = estimator.estimate(100 * (first * U + second * V))
    for reading, truth in zip((found.first, found.second), (first, second), strict=True):
        assert reading.severity == pytest.approx(truth, abs=1e-6)
        assert reading.low <= reading.severity <= reading.high and reading.readable
    assert draw_estimate(estimator, found)


def test_what_neither_explains_is_not_covered():
    found = JointEstimator(linear_grid(U, V)).estimate(0.2 * U + 0.3 * V + 10 * SIGMA * np.eye(N)[5])
    assert found.misfit == pytest.approx(100, rel=1e-3) and not found.covered


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    base = tmp_path_factory.mktemp("combined")
    settings = paper_settings(base)
    settings.path.write_text(settings.text + FRICTION, encoding="utf-8")
    settings = load_settings(settings.path)
    build_grid(ReferencePlant(), settings, other_fault(settings, "friction"), base / "map")
    return base / "map"


def test_eccentricity_and_friction_of_a_recording(tmp_path, folder):
    currents = simulate(0.23, tau_c=2.2 * declared("tau_c"))[:3]
    done = assess_both(write(tmp_path / "r.csv", currents), folder, tmp_path / "out", columns=COLUMNS)
    assert done.estimate.first.severity == pytest.approx(0.23, abs=0.01)
    assert done.estimate.second.severity == pytest.approx(2.2 * declared("tau_c"), rel=0.05)
    assert done.band.name == "orange" and "Together with dry friction 2.2" in done.sentence
    content = json.loads((tmp_path / "out" / "assessment.json").read_text())
    assert content["estimate"]["second"]["readable"] is True and "density" not in content["estimate"]
    assert content["faults"] == ["static rotor eccentricity ζ", "dry friction"]
    assert (tmp_path / "out" / "assessment.png").exists()


def test_another_actuator_is_refused(tmp_path, folder):
    with pytest.raises(Refusal):
        assess_both(write(tmp_path / "r.csv", simulate(0.1, V=20.0, J=2e-4)[:3]), folder, columns=COLUMNS)


def test_the_page_of_a_study(tmp_path, folder, map_folder):
    grid = load_grid(folder)
    study = run_study(ReferencePlant(), grid, SeverityTable(map_folder / TABLE_FILE), 16)
    errors = [test.joint.first.severity - test.first for test in study.tests]
    assert np.sqrt(np.mean(np.square(errors))) < 0.02
    write_studies([study], tmp_path)
    page = (tmp_path / "combined.md").read_text()
    assert "16 simulated tests" in page and "{" not in page and "## With dry friction, 0.5 to 3 times nominal" in page
    assert (tmp_path / "figures" / "combined_friction.svg").exists()


@pytest.mark.parametrize("share", [0.0, 0.3, 0.9])
def test_a_truncated_map_is_refused(tmp_path, folder, share):
    data = (folder / GRID_FILE).read_bytes()
    (tmp_path / "settings.toml").write_bytes((folder / "settings.toml").read_bytes())
    (tmp_path / GRID_FILE).write_bytes(data[: int(share * len(data))])
    with pytest.raises(AnalysisError, match="damaged"):
        load_grid(tmp_path)


def test_an_unknown_fault_is_answered_with_those_there_are(tmp_path):
    with pytest.raises(AnalysisError, match=r"no .*combined.* fault rust; there is friction, short, backlash"):
        other_fault(load_settings(), "rust")


def test_settings_that_were_changed_after_the_map_was_made_are_refused(tmp_path, folder):
    """Severities, bands and spectra of one text were read into a grid of another without a word."""
    shutil.copytree(folder, tmp_path / "map")
    settings = tmp_path / "map" / "settings.toml"
    settings.write_text(settings.read_text().replace("last = 0.5", "last = 0.4", 1), encoding="utf-8")
    with pytest.raises(AnalysisError, match="changed since the map was made"):
        load_grid(tmp_path / "map")
