"""A law beside an error of a sensor: found by the others, without listening to that one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import Own, load
from lacuna.discovery.efforts.find import places_of
from lacuna.discovery.explain import explain
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.law.together.unheard import to_be_left_out, without_sensor
from lacuna.discovery.steps import fitted

from .test_efforts import BELIEVED, cascade

# A loss from the upper tank with the cube of its level, and a gauge of the lower one that bends.
LOSS = BELIEVED.replace("q - k*upper", "q - k*upper - 2e-3*upper^3")
BENT = LOSS.replace("equation", "  Real shown;\nequation\n  shown = lower + 0.4*lower^2;", 1)


def test_a_law_and_a_bent_sensor_are_both_found(tmp_path: Path) -> None:
    result = explain(load(cascade(tmp_path, BENT, "shown")))
    assert result.verdict == "missing_physics"
    told = {f.ranked.attachment.location: f.ranked.attachment.effect.identifier for f in result.findings}
    assert told == {"upper": "unknown", "sensor:lower": "sensor.nonlinearity"}
    point = result.final.point
    level = np.linspace(0.1, 0.6, 6)
    law = next(f.ranked.attachment for f in result.findings if f.ranked.attachment.law)
    assert [v.name for v in law.law.references()] == ["upper"]
    size = law.law.references()[0].size
    assert point[law.full_name("c_1")] * (level / size) ** 3 == pytest.approx(-2e-3 * level**3, rel=0.05)
    floor = np.sqrt(np.mean([f**2 for f in result.floor.values()]))
    assert result.after.validate[""] < 1.1 * floor


def test_the_sensor_that_is_not_heard_is_the_wrong_one(tmp_path: Path) -> None:
    told = fitted(load(cascade(tmp_path, BENT, "shown")), lambda text: None)
    found = places_of(told.case, told.amendment, told.base, told.case.library())
    best = found.null + max(s.gain for s in found.sites)
    assert to_be_left_out(found, best, lambda text: None).column == "lower"


def test_what_no_sensor_shows_is_no_place(tmp_path: Path) -> None:
    """Without the lower gauge an effort in the lower tank does nothing that is recorded."""
    told = fitted(load(cascade(tmp_path, LOSS)), lambda text: None)
    lower = next(s for s in told.case.outputs if s.column == "lower")
    case = without_sensor(told.case, lower)
    base, _ = fit_believed(case, told.base.machine.amended(told.amendment, case))
    found = places_of(case, told.amendment, base, case.library())
    assert found.sites[0].location == "upper"


def test_a_state_that_only_this_sensor_gave_the_start_of_starts_anywhere(tmp_path: Path) -> None:
    case = load(cascade(tmp_path, BELIEVED))
    case.initial, case.own["r1.csv"] = {"lower": "recorded", "upper": "recorded"}, Own(initial={"lower": "recorded"})
    lower = next(s for s in case.outputs if s.column == "lower")
    less = without_sensor(case, lower)
    assert (less.initial, less.own["r1.csv"].initial) == (
        {"lower": "unknown", "upper": "recorded"}, {"lower": "unknown"},
    )  # fmt: skip
    assert [s.column for s in less.outputs] == ["upper"] and len(case.outputs) == 2
