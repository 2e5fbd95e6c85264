"""The paper's actuator, from its equations to its map: the published numbers, and an independent simulation's."""

from __future__ import annotations

from dataclasses import replace
import json

import numpy as np
import pytest

import lacuna
from lacuna.analysis.map.maps import build_map
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.settings import load_settings
from lacuna.analysis.spectra.chain import Chain
from lacuna.codegen.compile import compile_model
from tests.analysis.reference import simulate


@pytest.fixture(scope="module")
def settings():
    return load_settings()


@pytest.fixture(scope="module")
def plant(settings):
    compiled = compile_model(settings.model)
    return ModelPlant(compiled.name, compiled.path, compiled.hash, settings, compiled.report.seconds)


@pytest.fixture(scope="module")
def built(plant, settings, tmp_path_factory):
    return build_map(plant, settings, tmp_path_factory.mktemp("paper") / "map", figures=False)


def test_bands_rise_as_published(built):
    rises = [1e3 * band["rise"] for band in built.summary["bands"]]
    assert rises == pytest.approx([16.0, 99.4, 61.1, 196.9], abs=0.5)


def test_first_peak_switches_line_between_33_and_34_percent(built):
    assert len(built.rows) == 51
    for row in built.rows:
        assert row.peak_bin == [44 if row.severity < 0.335 else 43] * 3, row.severity
    assert built.summary["switch_severity"] == 0.34


def test_phase_a_is_lowest_and_phase_b_highest_throughout(built):
    assert built.summary["ordering"] == "A < C < B"


def test_mean_speed_falls_as_known(built):
    speeds = [built.rows[k].speed_mean for k in (0, 33, 34, 50)]
    assert speeds == pytest.approx([105.38, 104.31, 104.23, 102.36], abs=0.05)


def test_solver_met_every_event(built):
    """About 200 commutations and 200 diode extinctions in each test."""
    for row in built.rows:
        assert 350 <= row.counters["state_events"] <= 450


@pytest.mark.parametrize("zeta", [0.0, 0.33, 0.5])
def test_features_equal_those_of_an_independent_simulation(plant, settings, zeta):
    chain, record, reference = Chain(settings), plant.run(zeta), simulate(zeta)
    found, expected = chain.analyse(record.currents, record.angle), chain.analyse(reference[:3], reference[4])
    np.testing.assert_allclose(found.rms, expected.rms, rtol=1e-6)
    np.testing.assert_allclose(found.harmonic, expected.harmonic, atol=1e-6)
    assert found.speed_mean == pytest.approx(expected.speed_mean, rel=1e-6)


def test_who_waits_for_the_map_sees_the_same_one_by_the_faster_solver(built, settings, tmp_path):
    first, whole = lacuna.growing_map(out=tmp_path)
    assert (len(first), len(whole)) == (11, 51) and set(first.severities) <= set(whole.severities)
    for channel, feature in enumerate(("rms_a", "rms_b", "rms_c")):
        assert whole[feature] == pytest.approx([row.rms[channel] for row in built.rows], rel=1e-6)
    assert np.array_equal(whole["peak_a_hz"], [row.peak_hz[0] for row in built.rows])
    written = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert (built.summary["solver"]["name"], written["solver"]["name"]) == ("ida", "dopri5")


def test_settings_that_name_no_faster_solver_have_the_one_they_name(settings):
    alone = {name: table for name, table in settings.raw.items() if name != "assessment"}
    assert (settings.quick_solver, replace(settings, raw=alone).quick_solver) == ("dopri5", "ida")
