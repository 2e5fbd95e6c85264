"""A few of the random automata of `make automata`: each right within its budget, or ended by an error."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events import play
from tests.events.models import compiled


@pytest.mark.parametrize("number", [0, 1, 2, 38, 137])
# 38: two crossings in a step in which another guard switches; 137: a guard that comes back at once and jumps
def test_runs_go_as_the_automaton_is_played(tmp_path: Path, number: int) -> None:
    automaton, expected = play.fair(np.random.default_rng([2027, number]), number)
    model = compiled(tmp_path, automaton.text)
    for solver in ("ida", "dopri5", "rodas4"):
        for rtol in (1e-5, 1e-8):
            result = runtime.simulate(model, solver=solver, rtol=rtol, stop=automaton.stop, interval=0)
            assert play.wrong(automaton, expected, result, rtol) == "", (solver, rtol)
