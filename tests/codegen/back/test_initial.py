"""Initial systems: steady starts against their closed forms, and a model with nothing to start."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model

STEADY = """model Steady "A DC motor that starts in steady state and is loaded after half a second"
  parameter Real R=1, L=0.01, k=0.1, J=0.001, d=1e-4, V=12;
  Real i, w, tau;
initial equation
  der(i) = 0;
  der(w) = 0;
equation
  L*der(i) = V - R*i - k*w;
  J*der(w) = k*i - d*w - tau;
  tau = if time < 0.5 then 0 else 0.1;
  annotation(experiment(StopTime=1));
end Steady;
"""


def simulated(folder: Path, text: str, **settings: object) -> runtime.Result:
    name = text.split()[1]
    (folder / f"{name}.mo").write_text(text)
    return runtime.simulate(runtime.Model(compile_model(str(folder / f"{name}.mo")).path), **settings)


@pytest.mark.parametrize("solver", ["ida", "dopri5"])
def test_a_steady_start_stays_steady_until_the_load_comes(tmp_path: Path, solver: str) -> None:
    """k i = d w and V = R i + k w: w = V k / (k^2 + R d)."""
    result = simulated(tmp_path, STEADY, solver=solver)
    speed = 12 * 0.1 / (0.1**2 + 1e-4)
    before = result["w"][result.time < 0.499]
    assert before == pytest.approx(speed, rel=1e-12)
    assert result["i"][0] == pytest.approx(1e-3 * speed, rel=1e-12)
    assert result["w"][-1] < speed - 5


def test_a_model_without_variables_runs(tmp_path: Path) -> None:
    result = simulated(tmp_path, "model Nothing\nend Nothing;\n")
    assert result.complete
    assert result.time[-1] == 1.0
