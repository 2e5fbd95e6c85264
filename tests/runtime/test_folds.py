"""Folds of an algebraic unknown: sensitivities over one are none, and a flag says so. A steep change is no fold, nor is
what only rounds differently in the two forms of a model."""

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


ROUGH = """model Rough "Two linear equations that nearly agree: what they give is rounded 1/(p - 1) times more than x"
  parameter Real p = 1;
  Real x(start=1, fixed=true), s(start=0, fixed=true), z1, z2;
equation
  der(s) = 1;
  der(x) = z1;
  p*z1 + cos(s)*z2 = (cos(s) - p)*x;
  z1 + cos(s)*z2 = (cos(s) - 1)*x;
end Rough;
"""


@pytest.mark.parametrize(("p", "rtols"), [(1.0001, (1e-8, 1e-9, 1e-10, 1e-11)), (1.000001, (1e-8, 1e-9))])
def test_rounding_of_linear_equations_restarts_nothing(tmp_path: Path, p: float, rtols: tuple[float, ...]) -> None:
    """z1 = -x, so that x = exp(-time). Restarts at every other step cost the order of the method, and the error more
    than the tolerance."""
    model = compiled(tmp_path, ROUGH)
    for rtol in rtols:
        result = runtime.simulate(model, solver="ida", parameters={"p": p}, rtol=rtol, stop=3.0, interval=0.1)
        assert result.complete, result.failure
        assert result.counters["restarts"] == 0
        assert np.abs(result["x"] - np.exp(-result.time)).max() < 10 * rtol
