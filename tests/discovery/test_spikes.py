"""Single samples that a logger spoils: left out, said, and no part of what is judged."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.case.spikes import spikes
from lacuna.discovery.explain import explain
from lacuna.discovery.steps import opened


def test_a_sample_far_off_is_found_and_its_size_told() -> None:
    signal = np.sin(np.linspace(0, 6, 300))
    signal[[100, 200]] += [50.0, -30.0]
    signal[150] = np.nan
    found, size = spikes(signal)
    assert found.tolist() == [100, 200]
    assert np.allclose(size, [50.0, 30.0], atol=0.05)


def test_a_step_is_none() -> None:
    assert len(spikes(np.concatenate([np.zeros(100), np.full(100, 7.0)]))[0]) == 0


def test_it_is_left_out_in_the_unit_of_the_recording(friction_case: Path) -> None:
    case = load(friction_case)
    for recording in (*case.fit, *case.validate):
        recording.columns["theta"] = recording.columns["theta"].copy()
        recording.columns["theta"][50] = 1e9
    result, _ = opened(case, Library())
    assert {p.kind for p in result.problems} == {"outlier"}
    assert all("1 single sample jumps by 1e+09 and back: left out" in str(p) for p in result.problems)
    assert all(np.isnan(r.columns["theta"][50]) for r in (*result.case.fit, *result.case.validate))


def test_the_verdict_is_that_without_it(friction_case: Path) -> None:
    case = load(friction_case)
    case.fit[0].columns["theta"] = case.fit[0].columns["theta"].copy()
    case.fit[0].columns["theta"][50] = 1e9
    assert explain(case).verdict == "missing_physics"
