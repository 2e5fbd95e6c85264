"""What a settings file may hold, and how its slips are told."""

from __future__ import annotations

import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.settings import load_settings
from tests.analysis.plants import paper_settings


def test_the_papers_settings():
    settings = load_settings()
    assert settings.samples == 100000
    assert settings.fault.severities == [round(0.01 * k, 2) for k in range(51)]
    assert [band.name for band in settings.bands] == ["green", "orange", "red", "violet"]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[fault]", "[fault", "Expected ']'"),
        ("duration = 1.0", "", "recording.duration is missing"),
        ("duration = 1.0", "length = 1.0", "recording.length is not known"),
        ("step = 0.01", "step = -1.0", "fault.step is -1.0, not a number above zero"),
        ("last = 0.5", "last = 1" + 400 * "0", "a whole number of more than 18 digits"),
        ("step = 0.01", "step = nan", "fault.step is nan, not a number above zero"),
        ("step = 0.01", "step = 1e-9", "more than 100000 tests"),
        ("sampling_rate = 100000.0", "sampling_rate = 1e9", "more than 1024 MB a test"),
        ("after = 0.3", "after = 1.0", "speed.after is 1 s of a test of 1 s"),
        ('parameter = "zeta"', "parameter = []", "fault.parameter is"),
        ("scale = 100", 'scale = "x"', "fault.scale is 'x'"),
        ("parameters = []", 'parameters = ["V"]', "1 parameters, but 0 of values"),
        ('name = "ida"', 'name = "rk4"', "solver.name is 'rk4', not a solver that chooses its steps"),
        ("overlap = 0.67", "overlap = true", "overlap is True"),
        ("[fault]", "[[fault]]", "fault is a table"),
        ("[filter]", "[filters]", "there is no table .filters.; did you mean filter"),
        ("spread = [0.4]", "spread = [0.4, 0.1]", "1 parameters, but 2 of spread"),
        ("sampling_rate = 100000.0", 'sampling_rate = "fast"', "fast"),
        ('mode = "Normal"', 'state = "Normal"', "state"),
        ("overlap = 0.67", 'overlap = "much"', "much"),
        ("first = 0.11", "first = 0.05", "band orange does not begin above the end of green"),
        ("last = 0.33", "last = 0.2", "band red: first is above last"),
    ],
)
def test_slips_name_the_file_and_the_entry(tmp_path, old, new, message):
    with pytest.raises(AnalysisError, match=message) as caught:
        paper_settings(tmp_path, (old, new))
    assert "settings.toml" in str(caught.value)


def test_tables_that_only_some_uses_need(tmp_path):
    gone = ("[filter]", "# [filter]"), ("corner", "# corner"), ("sections = 3", ""), ("improbable", "# improbable")
    settings = paper_settings(tmp_path, *gone)
    with pytest.raises(AnalysisError, match=r"table \[filter\] is missing"):
        settings.table("filter")
    with pytest.raises(AnalysisError, match=r"assessment\.improbable is missing"):
        settings.table("assessment")["improbable"]


def test_a_missing_file_is_said(tmp_path):
    with pytest.raises(AnalysisError, match=r"none\.toml: there is no such file"):
        load_settings(tmp_path / "none.toml")
