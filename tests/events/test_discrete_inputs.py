"""Integer and Boolean inputs of the model itself: held between samples, and known as they were before an event."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.runtime.model import Model
from lacuna.runtime.simulation import RecordedInput, simulate

SOURCE = """
model Commanded
  input Integer u;
  input Boolean b;
  Integer changes(start=0, fixed=true), rises(start=0, fixed=true), starts(start=0, fixed=true);
  Integer old(start=0, fixed=true);
  Real x(start=0, fixed=true);
equation
  der(x) = u;
  when change(u) then
    changes = pre(changes) + 1;
    old = pre(u);
  end when;
  when edge(b) then
    rises = pre(rises) + 1;
  end when;
  when b then
    starts = pre(starts) + 1;
  end when;
end Commanded;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rk4"])
@pytest.mark.parametrize("interpolation", ["hold", "linear"])
def test_an_input_is_known_as_it_was_before(tmp_path: Path, solver: str, interpolation: str) -> None:
    path = tmp_path / "Commanded.mo"
    path.write_text(SOURCE, encoding="utf-8")
    model = Model(compile_model(str(path), search_path=[]).path)
    times = np.array([0.0, 0.3, 0.6, 0.8])
    inputs = {
        "u": RecordedInput(times, np.array([1.0, 4.0, 2.0, 2.0]), interpolation),
        "b": RecordedInput(times, np.array([0.0, 1.0, 0.0, 1.0]), interpolation),
    }
    step = {"step": 0.01} if solver == "rk4" else {}
    result = simulate(model, inputs=inputs, stop=1.0, interval=0.1, solver=solver, **step)
    assert result.complete, result.failure
    ends = {name: result[name][-1] for name in ("changes", "old", "rises", "starts")}
    assert ends == {"changes": 2, "old": 4, "rises": 2, "starts": 2}
    assert set(result["u"]) == {1.0, 4.0, 2.0}
    assert result["x"][-1] == pytest.approx(0.3 + 4 * 0.3 + 2 * 0.4, rel=1e-6)
