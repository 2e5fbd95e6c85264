"""Constraints between states that structure does not show: sums of equations whose coefficients are whole numbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model

CHOKES = """model Chokes "Three inductances feed a delta of resistances that nothing joins to ground"
  parameter Real R = 3, L = 0.1, v[3] = {2, -1, -1};
  Real i[3], node[3], branch[3];
initial equation
  i[1:2] = {0, 0};
equation
  for k in 1:3 loop
    L*der(i[k]) = v[k] - node[k];
    R*branch[k] = node[k] - node[mod(k, 3) + 1];
    i[k] = branch[k] - branch[mod(k + 1, 3) + 1];
  end for;
end Chokes;
"""
LOOP = """model Loop "A current through one of three capacitances in a ring; a resistance grounds it"
  parameter Real C = 0.5, I = 3, R = 7;
  Real v[3], i[3], node[3], leak;
initial equation
  v[1:2] = {0, 0};
equation
  for k in 1:3 loop
    C*der(v[k]) = i[k];
    v[k] = node[k] - node[mod(k, 3) + 1];
  end for;
  I = i[1] - i[3];
  -I = i[2] - i[1];
  leak = i[3] - i[2];
  node[3] + R*leak = 0;
end Loop;
"""


def simulated(folder: Path, text: str, solver: str) -> runtime.Result:
    name = text.split()[1]
    (folder / f"{name}.mo").write_text(text)
    model = runtime.Model(compile_model(str(folder / f"{name}.mo")).path)
    return runtime.simulate(model, stop=0.2, rtol=1e-9, solver=solver)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_currents_into_a_floating_load_add_up_to_zero(tmp_path: Path, solver: str) -> None:
    """A delta of R is a star of R/3: i = v/(R/3) (1 - exp(-R/(3 L) t)), as the voltages add up to zero."""
    result = simulated(tmp_path, CHOKES, solver)
    assert result.complete, result.failure
    expected = 2 / 1 * (1 - np.exp(-10 * result.time))
    assert result["i[1]"] == pytest.approx(expected, abs=1e-7)
    assert result["i[3]"] == pytest.approx(-expected / 2, abs=1e-7)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_voltages_in_a_floating_loop_add_up_to_zero(tmp_path: Path, solver: str) -> None:
    """Two capacitances in series beside the third: C + C/2 takes the current."""
    result = simulated(tmp_path, LOOP, solver)
    assert result.complete, result.failure
    expected = 3 / (1.5 * 0.5) * result.time
    assert result["v[1]"] == pytest.approx(expected, abs=1e-8)
    assert result["v[3]"] == pytest.approx(-expected / 2, abs=1e-8)
