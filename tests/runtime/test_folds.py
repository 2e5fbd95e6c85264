"""Sensitivities over a fold of an algebraic unknown: there are none, and a flag says so. A steep change is no fold."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events.models import compiled

FOLD = """model Fold "z follows the lower branch until x = 2, at time 5/p, and jumps from -1 to 2"
  parameter Real p = 1;
  Real x(start=-3, fixed=true), y(start=0, fixed=true), z(start=-2.1);
equation
  der(x) = p;
  der(y) = z;
  z^3 - 3*z = x;
end Fold;
"""
STEEP = """model Steep "z goes from -2 to 2 within a fiftieth of a second, and bends as sharply"
  parameter Real p = 1;
  Real x(start=-3, fixed=true), y(start=0, fixed=true), z(start=-2.1);
equation
  der(x) = p;
  der(y) = z;
  z^3 + z = 10*tanh(100*x);
end Steep;
"""


@pytest.mark.parametrize("solver", ["dopri5", "ida"])
def test_a_fold_ends_them(tmp_path: Path, solver: str) -> None:
    model = compiled(tmp_path, FOLD, sensitivities=True)
    for rtol in (1e-5, 1e-8):
        result = runtime.simulate(
            model, solver=solver, rtol=rtol, stop=7.0, interval=0.5, outputs=["y"], sensitivities=["p"]
        )
        assert result.complete, result.failure
        assert [(f.kind, f.time) for f in result.flags] == [("fold", pytest.approx(5, abs=1e-2))]
        found = result.sensitivity("y", "p")
        assert np.isnan(found[result.time > 5.1]).all()
        assert np.isfinite(found[result.time < 4.9]).all()


@pytest.mark.parametrize("solver", ["dopri5", "ida"])
def test_what_is_only_steep_does_not(tmp_path: Path, solver: str) -> None:
    model = compiled(tmp_path, STEEP, sensitivities=True)
    for rtol in (1e-4, 1e-6, 1e-8):
        result = runtime.simulate(
            model, solver=solver, rtol=rtol, stop=7.0, interval=0.5, outputs=["y", "z"], sensitivities=["p"]
        )
        assert result.complete, result.failure
        assert result.flags == []
        assert result["z"][-1] == pytest.approx(2, rel=1e-3)
        # y(7) = -z (3/p) + z (7 - 3/p) but for what is symmetric: dy/dp = 6 z/p^2
        assert result.sensitivity("y", "p")[-1] == pytest.approx(12, rel=1e-2)
