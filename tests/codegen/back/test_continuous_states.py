"""What a model differentiates is continuous, whatever index reduction differentiates besides."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.runtime import Model, simulate

CONTROLLED = """model Controlled "The feed-forward u steps, and cancels: nothing else moves"
  Real x, w, u, v, I, T;
initial equation
  x = 0.12;
  w = 0;
equation
  u = 5 + (if time > 5 then 1 else 0);
  der(x) = w;
  0.5*der(w) = T;
  {a}*w = u - v;
  der(I) = 0.12 - x;
  v = u - {b}*(0.12 - x) - 2*I;
end Controlled;
"""


@pytest.mark.parametrize(("a", "b"), [(2, 8), (1, 4), (8, 2), (100, 1)])
@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_states_are_what_the_model_differentiates(tmp_path: Path, solver: str, a: int, b: int) -> None:
    path = tmp_path / "Controlled.mo"
    path.write_text(CONTROLLED.format(a=a, b=b))
    result = simulate(Model(compile_model(str(path)).path), stop=10, interval=0.5, solver=solver)
    for name, expected in (("x", 0.12), ("w", 0), ("I", 0), ("T", 0)):
        np.testing.assert_allclose(result[name], expected, atol=1e-9)
    after = result["time"] > 5
    np.testing.assert_allclose(result["v"][after], 6, atol=1e-9)
    np.testing.assert_allclose(result["v"][result["time"] < 5], 5, atol=1e-9)
