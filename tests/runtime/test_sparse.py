"""Rodas4 on models of many states: KLU in place of a dense matrix, against a closed form."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events.models import compiled

LADDER = """model Ladder "Sections of R and C, shorted in front, open at the end: its slowest mode, which decays alone"
  constant Integer n = {n};
  parameter Real R = 2, C = 0.5;
  parameter Real angle = 3.141592653589793/(2*n + 1);
  Real u[n](start={{sin(k*angle) for k in 1:n}}, each fixed=true), i[n];
equation
  R*i[1] = -u[1];
  for k in 2:n loop
    R*i[k] = u[k - 1] - u[k];
  end for;
  for k in 1:n - 1 loop
    C*der(u[k]) = i[k] - i[k + 1];
  end for;
  C*der(u[n]) = i[n];
end Ladder;
"""


@pytest.mark.parametrize("n", [40, 41, 400])
def test_a_mode_of_a_ladder_decays(tmp_path: Path, n: int) -> None:
    model = compiled(tmp_path, LADDER.format(n=n))
    angle = np.pi / (2 * n + 1)
    rate = 2 - 2 * np.cos(angle)  # over R C = 1 s
    for rtol in (1e-4, 1e-6, 1e-8):
        result = runtime.simulate(model, solver="rodas4", rtol=rtol, stop=2 / rate, interval=0.1 / rate)
        assert result.complete, result.failure
        decay = np.exp(-rate * result.time)
        for k in (1, n // 3, n):
            assert np.abs(result[f"u[{k}]"] - np.sin(k * angle) * decay).max() < 20 * rtol
        assert result.counters["steps"] < 100  # the fastest mode is 4 n^2 times faster
