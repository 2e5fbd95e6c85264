"""Several faults of one actuator: what is one fault is one history, and what is a new part is new in all of them."""

from __future__ import annotations

import numpy as np
import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.history import read_histories
from lacuna.analysis.prognosis.tracks import tracks
from lacuna.fleets import fleet
from lacuna.prognosis import forecast

HEAD = "actuator,cycles,fault,severity,low,high,event\n"


def histories(tmp_path, rows):
    path = tmp_path / "history.csv"
    path.write_text(HEAD + "".join(f"{row}\n" for row in rows))
    return read_histories(path)


def test_the_maps_own_fault_may_be_named_or_not(tmp_path):
    """A row without a fault and one of `zeta` made two histories, neither long enough to say anything."""
    rows = [
        "A,1,,.1,.09,.11,",
        "A,2,zeta,.2,.19,.21,",
        "A,3,,.4,.39,.41,",
        "A,4,zeta,.42,.41,.43,",
        "B,1,zeta,.1,.1,.1,",
    ]
    a, b = tracks(histories(tmp_path, rows), ("zeta",))
    assert (a.actuator, a.fault, b.actuator, b.fault) == ("A", "", "B", "")
    assert a.use.tolist() == [1, 2, 3, 4] and a.severity.tolist() == [0.1, 0.2, 0.4, 0.42]
    (said,) = forecast(histories(tmp_path, rows[:4])).sentences
    assert said == "Actuator A has reached violet: remove it now."
    assert len(fleet(tmp_path, out=tmp_path / "fleet")) == 1


def test_a_name_that_all_rows_have_is_kept(tmp_path):
    (a,) = tracks(histories(tmp_path, ["A,1,zeta,.1,.09,.11,"]), ("zeta",))
    assert a.fault == "zeta"


def test_two_tests_of_one_fault_at_one_use_are_refused(tmp_path):
    with pytest.raises(AnalysisError, match="actuator A: two tests at cycles 1: a row of fault 'zeta' is one of"):
        tracks(histories(tmp_path, ["A,1,,.1,.09,.11,", "A,1,zeta,.2,.19,.21,"]), ("zeta",))


@pytest.mark.parametrize("use", [3, 4])
def test_a_new_part_is_new_in_all_faults_of_its_actuator(tmp_path, use):
    """The wear of the old part went on over a replacement that a row of another fault told."""
    rows = ["A,1,,.1,.1,.1,", "A,1,friction,.1,.1,.1,", "A,3,,0,0,0,replaced", f"A,{use},friction,.1,.1,.1,",
            "A,9,friction,.1,.1,.1,", "B,3,,.1,.1,.1,", "B,4,friction,.1,.1,.1,"]  # fmt: skip
    own, friction, *others = tracks(histories(tmp_path, rows), ("zeta",))
    assert own.replaced.tolist() == [False, True]
    assert friction.replaced.tolist() == [False, True, False]
    assert not any(np.any(h.replaced) for h in others)
