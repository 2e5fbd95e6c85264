"""Sweeps and maps by settings of one's own: what nuisances move, what the page reads, and what is no parameter."""

from __future__ import annotations

from pathlib import Path

import pytest

import lacuna
from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.settings import PAPER


def settings_with(folder: Path, *replacements: tuple[str, str]) -> Path:
    text = PAPER.read_text(encoding="utf-8")
    for old, new in [("duration = 1.0", "duration = 0.25"), ("after = 0.3", "after = 0.1"), *replacements]:
        assert old in text, old
        text = text.replace(old, new)
    path = folder / "own.toml"
    path.write_text(text, encoding="utf-8")
    return path


OWN = 'parameters = ["V", "offset"]\nvalues = [14.0, 0.1]\n'


def test_nuisances_move_what_the_settings_say(tmp_path):
    path = settings_with(tmp_path, ("[actuator]\n", f"[actuator]\n{OWN}"), ("parameters = []", ""), ("values = []", ""))
    found = lacuna.sweep(points=2, settings=path, out=tmp_path / "out")
    assert found["V"] == pytest.approx(14.0, rel=0.051) and found["offset"] == pytest.approx(0.1, abs=0.021)
    assert found["speed_mean"] == pytest.approx(50.0, rel=0.1)  # with half the supply


def test_a_sweep_over_a_parameter_that_is_headed_otherwise_has_its_page(tmp_path):
    path = settings_with(tmp_path, ('symbol = "zeta"', 'symbol = "gap"'))
    found = lacuna.sweep(points=2, settings=path, out=tmp_path / "out")
    assert found.report.exists() and found["zeta"].min() >= 0


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('parameter = "zeta"', 'parameter = "tau_c"', "moves tau_c, which is the fault: take it out"),
        ('parameters = ["V"]', 'parameters = ["VV"]', "has no parameter VV; did you mean V"),
    ],
)
def test_nuisances_that_cannot_be_are_refused_before_a_map_is_drawn(tmp_path, old, new, said):
    path = settings_with(tmp_path, (old, new))
    with pytest.raises(AnalysisError, match=said):
        lacuna.maps(settings=path, out=tmp_path / "out", prepare=True)
    assert not (tmp_path / "out").exists()


HALF = """model Own
  extends Lacuna.Actuators.PreflightEma;
  parameter Real half(unit="V") = V/2;
end Own;
"""


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("half", "half of model Own cannot be set: it is a constant, or given by other parameters"),
        ("rotor.w", "model Own has no parameter rotor.w"),
        ("VV", "model Own has no parameter VV; did you mean V"),
    ],
)
def test_parameters_of_the_settings_must_be_such_of_the_model(tmp_path, name, said):
    (tmp_path / "Own.mo").write_text(HALF, encoding="utf-8")
    nuisance = [('parameters = ["V"]', f'parameters = ["{name}"]')]
    actuator = [("parameters = []", f'parameters = ["{name}"]'), ("values = []", "values = [1.0]")]
    for place in (nuisance, actuator):
        path = settings_with(tmp_path, *place)
        with pytest.raises(AnalysisError, match=said):
            lacuna.sweep(tmp_path / "Own.mo", points=2, settings=path, out=tmp_path / "out")
