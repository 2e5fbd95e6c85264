"""What cannot move makes no states: structural parameters that are zero, parameters that initial equations give."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from lacuna.codegen.compile import compile_model, translate
from lacuna.runtime.model import Model
from lacuna.runtime.result import Result
from lacuna.runtime.simulation import Session
from tests.codegen.generated import write_model

# The time constant of an ideal filter is none; the modifier is written where the filter is used.
FILTERS = """model Filters
  model Filter
    parameter Real T = 1 "time constant";
    final parameter Real spread = 2*T;
    Real u, y;
    Real c = smooth(1, spread*u*u) "of the slope of y";
  equation
    y = u - T*der(y) - c*der(u);
  end Filter;
  parameter Real T0 = 0 annotation(Evaluate = true);
  parameter Real T1 = T0 "literal at the end, but not to be set";
  parameter Real k = 3;
  Filter ideal(T = T1, u = k*sin(time));
end Filters;
"""

# d/dt of y needs no d/dt of a and b, which are large and small beside it.
IMPULSE = """model Impulse
  parameter Real a(fixed = false, start = 1e5), b(fixed = false, start = 1e-5);
  Real y, slope;
initial equation
  a*b = 2;
  a = 1e11*b;
equation
  y = a*exp(-(1e-5 + 1e-6*time)/b);
  slope = der(y);
end Impulse;
"""


def _run(path: str, tmp_path: Path, solver: str = "dopri5") -> tuple[Model, Result]:
    model = Model(compile_model(path, cache_directory=str(tmp_path / "cache")).path)
    result = Session(model, solver=solver, rtol=1e-9).run(stop=1.0)
    assert result.complete, result.failure
    return model, result


def test_a_structural_zero_leaves_no_state(tmp_path: Path) -> None:
    path = write_model(tmp_path, FILTERS)
    assert translate(path)[0].system.states == []
    model, result = _run(path, tmp_path)
    assert result["ideal.y"][-1] == pytest.approx(3 * math.sin(1), rel=1e-12)
    assert [n for n in ("T0", "T1", "k", "ideal.T") if n in model.parameters] == ["k"]


@pytest.mark.parametrize("solver", ["ida", "dopri5"])
def test_a_parameter_is_no_candidate_for_a_state(tmp_path: Path, solver: str) -> None:
    path = write_model(tmp_path, IMPULSE)
    system = translate(path)[0].system
    assert set(system.states) == {"a", "b"} and not system.dynamic
    _, result = _run(path, tmp_path, solver)
    b = math.sqrt(2e-11)
    assert result["y"][-1] == pytest.approx(1e11 * b * math.exp(-1.1e-5 / b), rel=1e-6)
    assert result["slope"][-1] == pytest.approx(-1e5 * math.exp(-1.1e-5 / b), rel=1e-6)
