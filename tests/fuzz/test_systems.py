"""A few systems with fixed seeds; more of them, and the targets of libFuzzer: make fuzz."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from tests.fuzz.systems import try_system


def test_three_solvers_agree_on_random_systems(tmp_path: Path) -> None:
    outcomes = Counter(try_system(seed, tmp_path) for seed in range(12))
    assert outcomes["3 agree"] >= 8, outcomes
