"""Stick and slip on a moving belt: guards that rest on their thresholds lose no event and delay none."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from tests.events.belts import MODEL, SOLVERS, draw, judge


@pytest.fixture(scope="module")
def belt() -> runtime.Model:
    return runtime.Model(compile_model(str(MODEL)).path)


@pytest.mark.parametrize("solver", SOLVERS)
def test_no_event_is_late_or_lost_and_times_converge(belt: runtime.Model, solver: str) -> None:
    """Of 20 belts, at rtol 1e-4 to 1e-10: before locate() bisected, each solver lost or delayed some."""
    rng = np.random.default_rng(1)
    belts = [draw(rng) for _ in range(20)]
    medians = []
    for rtol in (1e-4, 1e-6, 1e-8, 1e-10):
        verdicts = [judge(belt, b, solver, rtol) for b in belts]
        assert [v.wrong for v in verdicts if v.wrong] == []
        medians.append(np.median([v.error for v in verdicts]))
    # the error of a step is proportional to the tolerance; BDF of variable order gains a little less than it
    assert all(tighter < 0.1 * looser for looser, tighter in pairwise(medians)), medians
