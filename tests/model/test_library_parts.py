"""Benches of ours rebuilt from parts of the Modelica Standard Library: the same trajectories."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.search_path import search_path
from lacuna.runtime.model import Model
from lacuna.runtime.simulation import simulate

MODEL = Path(__file__).parents[1] / "models" / "library" / "DcServoOfParts.mo"
PAIRS = {"ours.i": "inductor.i", "ours.w": "shaft.w", "ours.theta": "shaft.phi"}


def test_a_servo_of_library_parts_moves_like_ours(shared: Path) -> None:
    library = shared / "msl"
    if not library.is_dir():
        pytest.skip(f"needs the Modelica Standard Library; not at {library}")
    compiled = compile_model(str(MODEL), search_path=search_path([library]))
    result = simulate(Model(compiled.path), interval=0.01)
    assert result.complete, result.failure
    for ours, theirs in PAIRS.items():
        size = np.ptp(result[theirs])
        assert size > 0
        assert np.max(np.abs(result[ours] - result[theirs])) <= 1e-6 * size, ours
