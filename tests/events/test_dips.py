"""A guard that crosses twice in a step at whose end another one has switched."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events.models import compiled

BEFORE = """model Before "x is above h for a while; then y passes its threshold, perhaps in the same step"
  parameter Real h = 0.9, late = 3;
  Real x(start=0, fixed=true), v(start=2, fixed=true), y(start=0, fixed=true);
  Integer up(start=0, fixed=true), down(start=0, fixed=true), passed(start=0, fixed=true);
equation
  der(x) = v;
  der(v) = -2;
  der(y) = 1;
  when x > h then
    up = pre(up) + 1;
  end when;
  when x < h then
    down = pre(down) + 1;
  end when;
  when y > late then
    passed = pre(passed) + 1;
  end when;
end Before;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_neither_is_lost(tmp_path: Path, solver: str) -> None:
    """x is a parabola, so that a step may be as long as the run; y passes before, within and after the excursion."""
    model = compiled(tmp_path, BEFORE)
    for late in np.linspace(0.7, 9, 20):
        result = runtime.simulate(model, solver=solver, stop=10.0, interval=0, parameters={"late": float(late)})
        assert result.complete, result.failure
        assert [result[n][-1] for n in ("up", "down", "passed")] == [1, 1, 1], late
        found = [result.time[np.flatnonzero(np.diff(result[n]))[0]] for n in ("up", "down", "passed")]
        assert np.allclose(found, [1 - 0.1**0.5, 1 + 0.1**0.5, late], rtol=1e-5)
