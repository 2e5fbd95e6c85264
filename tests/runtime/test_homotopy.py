"""homotopy(actual, simplified): a path at the start, where Newton's method fails from the start values."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events.models import compiled, simulated

FLAT = """model Flat "tanh has no slope at the start values"
  Real x(start=0, fixed=true), a(start=1), b(start=1), A, B;
equation
  der(x) = 1 - x;
  A = {};
  B = {};
  A + B = 0.5 + 0.1*x;
  A - 0.5*noEvent(if a > 0 then B else B*b) = 0.1 + 0*a*b;
end Flat;
"""
ACTUAL = "tanh(a - 1000)", "tanh(b - 1000)"
PATH = "homotopy(tanh(a - 1000), a - 1000)", "homotopy(simplified=b - 1000, actual=tanh(b - 1000))"


@pytest.fixture(scope="module")
def flat(tmp_path_factory: pytest.TempPathFactory) -> runtime.Model:
    return compiled(tmp_path_factory.mktemp("flat"), FLAT.format(*PATH))


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_the_path_leads_where_newton_does_not(flat: runtime.Model, solver: str) -> None:
    """tanh(b - 1000) = (0.4 + 0.1 x)/1.5, and the rest of the sum is tanh(a - 1000)."""
    result = runtime.simulate(flat, solver=solver, stop=1.0, interval=0.1)
    assert result.complete, result.failure
    beta = (0.4 + 0.1 * result["x"]) / 1.5
    assert result["b"] == pytest.approx(1000 + np.arctanh(beta), rel=1e-9)
    assert result["a"] == pytest.approx(1000 + np.arctanh(0.5 + 0.1 * result["x"] - beta), rel=1e-9)


def test_without_it_the_start_fails(tmp_path: Path) -> None:
    result = simulated(tmp_path, FLAT.format(*ACTUAL), stop=1.0)
    assert result.failure is not None
    assert result.failure.status == "initialisation"


CHOSEN = """model Chosen
  Real x(start=0, fixed=true), y(start=2);
equation
  der(x) = 1;
  homotopy(y^2, y + 5) = 4 + x;
end Chosen;
"""


def test_where_newton_succeeds_it_is_the_actual_expression(tmp_path: Path) -> None:
    result = simulated(tmp_path, CHOSEN, stop=1.0)
    assert result["y"] == pytest.approx(np.sqrt(4 + result["x"]), rel=1e-6)
