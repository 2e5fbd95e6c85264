"""Maps of the second actuator, over its eccentricity and over any other parameter that the settings name."""

from __future__ import annotations

import numpy as np
import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.map.maps import build_map
from lacuna.analysis.map.plant import ModelPlant
from lacuna.analysis.settings import PAPER, load_settings
from lacuna.codegen.compile import compile_model

SCREW = PAPER.with_name("screw.toml")
AXES = {
    "zeta": ("zeta", "step = 0.02", "step = 0.25"),
    "friction": ("friction", "last = 0.5\nstep = 0.02", "last = 3.0\nstep = 1.5"),
    "short": ("short_a", "last = 0.5\nstep = 0.02", "last = 0.2\nstep = 0.1"),
    "backlash": ("backlash", "last = 0.5\nstep = 0.02", "last = 0.02\nstep = 0.01"),
}


@pytest.mark.parametrize("axis", AXES)
def test_a_map_over_any_fault(tmp_path, axis):
    parameter, old, new = AXES[axis]
    text = SCREW.read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / "settings.toml"
    path.write_text(text.replace(old, new).replace('"zeta"', f'"{parameter}"'), encoding="utf-8")
    settings = load_settings(path)
    plant = ModelPlant.of(compile_model(settings.model), settings)
    rows = build_map(plant, settings, tmp_path / "map", figures=False).rows
    assert [row.severity for row in rows] == settings.fault.severities and len(rows) == 3
    assert (tmp_path / "map" / "map.csv").read_text().startswith(f"{parameter},rms_a")
    rms = np.array([row.rms for row in rows])
    assert np.abs(rms[-1] / rms[0] - 1).max() > (1e-3 if axis == "backlash" else 0.05)
    assert all(240 < hz < 290 for row in rows for hz in row.peak_hz), "the electrical frequency at the speed limit"


def test_a_fault_that_the_model_does_not_have_is_named(tmp_path):
    path = tmp_path / "settings.toml"
    path.write_text(SCREW.read_text(encoding="utf-8").replace('"zeta"', '"rust"'), encoding="utf-8")
    settings = load_settings(path)
    with pytest.raises(AnalysisError, match="no parameter rust"):
        ModelPlant.of(compile_model(settings.model), settings)
