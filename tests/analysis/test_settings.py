"""What a settings file may hold, and how its slips are told."""

from __future__ import annotations

import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.settings import load_settings, settings_of
from lacuna.analysis.severity.combined.grid import other_fault
from tests.analysis.plants import paper_settings

COMMENTS = [  # that stand between what is replaced
    ("                        # of the model, in every test other than declared, and ...", ""),
    ("                            # ... their values", ""),
]


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
        ("spread = [0.4]", "", r"nuisances\[1\]: 1 parameters, but 0 of spread or shift"),
        ("spread = [0.4]", "spread = [0.4]\nshift = [0.1]", r"nuisances\[1\]: has spread and shift"),
        ('symbol = "zeta"', 'symbol = "rms_mean"', "fault.symbol is 'rms_mean', not a name of .* other than those of"),
        ('symbol = "zeta"', 'symbol = "a,b"', "fault.symbol is 'a,b', not a name of"),
        ("doubtful = 0.15", "doubtful = 1e-4", "assessment.doubtful, 0.0001, is below assessment.improbable, 0.001"),
        ("parameters = []\nvalues = []", 'parameters = ["V"]', "1 parameters, but 0 of values"),
        ("parameters = []\nvalues = []", 'parameters = ["V", "V"]\nvalues = [1, 2]', "actuator: names V twice"),
        ("parameters = []\nvalues = []", 'parameters = ["zeta"]\nvalues = [1]', "names zeta, which the fault sets"),
        ('parameters = ["V"]', 'parameters = ["R"]', r"`winding at .*` and `supply, \+-5 %` both move R: leave one"),
    ],
)
def test_slips_name_the_file_and_the_entry(tmp_path, old, new, message):
    with pytest.raises(AnalysisError, match=message) as caught:
        paper_settings(tmp_path, *COMMENTS, (old, new))
    assert "settings.toml" in str(caught.value)


def test_tables_that_only_some_uses_need(tmp_path):
    gone = ("[filter]", "# [filter]"), ("corner", "# corner"), ("sections = 3", ""), ("improbable", "# improbable")
    settings = paper_settings(tmp_path, *gone)
    with pytest.raises(AnalysisError, match=r"table \[filter\] is missing"):
        settings.table("filter")
    with pytest.raises(AnalysisError, match=r"assessment\.improbable is missing"):
        settings.table("assessment")["improbable"]


OTHER = """[[combined]]
symbol = "friction"
parameter = "tau_c"
name = "dry friction"
unit = "N.m"
scale = 1
first = 0.1
last = 0.4
step = 0.1
healthy = 0.1
limits = [0.2, 0.3, 0.4]
"""


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"friction"', '"x/../../evil"', r"combined\[1\].symbol is 'x/../../evil', not a name of letters"),
        ("step = 0.1\n", "step = 0.2\n", r"\[\[combined\]\] friction goes from 0.1 to 0.4, no whole steps of 0.2"),
        ("healthy = 0.1", "healthy = 5.0", "friction: healthy is 5, outside of 0.1 to 0.4"),
        ("[0.2, 0.3, 0.4]", "[0.2]", "friction: limits are where the bands after the first begin: 3 are needed"),
        ("[0.2, 0.3, 0.4]", "[0.9, 0.2, 0.3]", "friction: limits must rise from above 0.1 to at most 0.4: "),
        ("[0.2, 0.3, 0.4]", "[0.3, 0.2, 0.4]", "friction: limits must rise from above 0.1 to at most 0.4: "),
        ("[[combined]]", OTHER + "[[combined]]", r"two \[\[combined\]\] have the symbol friction: rename one"),
    ],
)
def test_slips_of_another_fault(tmp_path, old, new, message):
    settings = paper_settings(tmp_path)
    with pytest.raises(AnalysisError, match=message):
        settings_of(settings.text + OTHER.replace(old, new), settings.path)


def test_the_other_fault_of_a_map_is_another(tmp_path):
    settings = settings_of(paper_settings(tmp_path).text + OTHER.replace("tau_c", "zeta"), tmp_path / "settings.toml")
    with pytest.raises(AnalysisError, match=r"combined\]\] friction is the map's own fault, zeta"):
        other_fault(settings, "friction")


def test_the_fault_may_be_what_a_nuisance_moves_where_none_is_used(tmp_path):
    """A map over friction is drawn without nuisances, as the guide has it; two values of one parameter are refused."""
    settings = paper_settings(tmp_path, ('parameter = "zeta"', 'parameter = "tau_c"'))
    with pytest.raises(
        AnalysisError, match=r"nuisances\]\] `dry friction, half to double` moves tau_c, which is the fault"
    ):
        _ = settings.nuisances


def test_a_missing_file_is_said(tmp_path):
    with pytest.raises(AnalysisError, match=r"none\.toml: there is no such file"):
        load_settings(tmp_path / "none.toml")
