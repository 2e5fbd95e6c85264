"""The stages of an explicit scheme in one call are those of one call each, to the last bit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from tests.codegen.generated import write_model

# Modes, a linear block, a divisor that an event decides, time, and a function.
BODY = """\
  Real x(start = 1, fixed = true), w(start = 0, fixed = true), y, z;
  Integer n(start = 0, fixed = true);
equation
  der(x) = (if n == 0 then 1 else 2)*w - y/3 + sin(5*time){idle};
  (1 + n)*y + z = x;
  y + 3*z = sin(w);
  der(w) = -x - 0.1*w;
  when x < -0.5 then
    n = pre(n) + 1;
  end when;
"""


def made(folder: Path, name: str, inputs: str, idle: str) -> runtime.Model:
    text = f"model {name}\n{inputs}{BODY.format(idle=idle)}end {name};\n"
    return runtime.Model(compile_model(write_model(folder, text), cache_directory=str(folder)).path)


@pytest.mark.parametrize(("solver", "step"), [("dopri5", None), ("rk4", 1e-3)])
def test_in_one_call_as_one_by_one(tmp_path: Path, solver: str, step: float | None):
    """A model with an input is called for each stage: one that changes nothing leaves the same bytes."""
    alone = made(tmp_path, "Alone", "", "")
    driven = made(tmp_path, "Driven", "  input Real u(start = 0);\n", " + 0.0*u")
    assert ["mdl_stages" in Path(m.path).with_suffix(".c").read_text() for m in (alone, driven)] == [True, False]
    runs = [runtime.simulate(m, solver=solver, step=step, stop=10, interval=0.1) for m in (alone, driven)]
    assert all(r.complete for r in runs), [r.failure for r in runs]
    assert runs[0].counters == runs[1].counters
    for name in ("time", "x", "w", "y", "z", "n"):
        assert np.array_equal(runs[0][name], runs[1][name]), name
    assert runs[0]["n"][-1] > 0
