"""What counts: thresholds that an event sets further on are no chattering, however many come in one step."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.events.models import simulated

MOVES = {
    "algebraic": ("", "v = -1.2 + time;"),
    "steady": ("w(start=1, fixed=true), ", "der(v) = w; der(w) = 0;"),
    "slowing": ("w(start=1, fixed=true), ", "der(v) = w; der(w) = -w;"),
}


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize("interval", [None, 0.01])
@pytest.mark.parametrize("move", MOVES)
def test_an_encoder_counts_on(tmp_path: Path, move: str, interval: float | None, solver: str) -> None:
    declared, equations = MOVES[move]
    start = "" if move == "algebraic" else "(start=0, fixed=true)"
    text = f"""model Encoder
  Real {declared}v{start}, y;
equation
  {equations}
  y = floor(300.123*v);
end Encoder;
"""
    result = simulated(tmp_path, text, solver=solver, stop=2.0, rtol=1e-6, interval=interval)
    assert result.complete, result.failure
    apart = np.abs(300.123 * result["v"] - np.round(300.123 * result["v"])) > 1e-3
    np.testing.assert_array_equal(result["y"][apart], np.floor(300.123 * result["v"][apart]))
