"""Random hybrid systems against closed forms: a sample of `make hybrid`."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.events.__main__ import TOLERANCES
from tests.events.belts import SOLVERS
from tests.events.hybrid import draw
from tests.events.judge import wrong
from tests.events.models import compiled


def test_five_hundred_runs_are_right(tmp_path: Path) -> None:
    rng, runs = np.random.default_rng(1), 0
    for number in range(13):
        system = draw(rng, number)
        model = compiled(tmp_path, system.text)
        for solver in SOLVERS:
            for rtol in TOLERANCES:
                assert wrong(model, system, solver, rtol) == "", (number, solver, rtol, system.text)
                runs += 1
    assert runs > 500
