"""A few seconds of fuzzing with fixed seeds; minutes of it: python -m tests.codegen.fuzz --seconds 180."""

from __future__ import annotations

import pytest

from tests.codegen.fuzz import run


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_nothing_but_diagnostics_comes_out(seed: int) -> None:
    outcomes = run(seed, seconds=60, count=150)
    assert sum(outcomes.values()) == 150
    assert len(outcomes) > 15, "the inputs reach many different checks"
