"""A solver that gets no further says which state or which equation it is about."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from lacuna import runtime
from tests.events.models import compiled, simulated

# Newton's method on the root of |z - y| goes to and fro between both sides of it.
CYCLE = """model Cycle
  parameter Real p = 1;
  Real x(start = 1, fixed = true), other(start = 3, fixed = true), z(start = 0), y(start = 1);
equation
  der(x) = -p*z;
  der(other) = -other;
  y = x + cos(5*other);
  noEvent(if z > y then sqrt(abs(z - y)) else -sqrt(abs(z - y))) = 0;
end Cycle;
"""
# A large state that moves fast beside a small one whose derivative jumps to and fro.
JUMPS = """model Jumps
  Real small(start = 1e-3, fixed = true), big(start = 1e6, fixed = true);
equation
  der(big) = 1e6*cos(time);
  der(small) = small*noEvent(if small > 1.5e-3 then -1e12 else 1);
end Jumps;
"""


def test_newtons_method_names_the_equation(tmp_path: Path) -> None:
    """With sensitivities nothing steps over what IDA's own Newton method does not solve."""
    model = compiled(tmp_path, CYCLE, sensitivities=True)
    result = runtime.simulate(model, solver="ida", stop=3.0, sensitivities=["p"])
    said = str(result.failure)
    assert "Cycle.mo:8: solver ida makes no progress" in said and "furthest from holding" in said
    assert "(y = " in said and result.failure.line == 8


def test_the_solver_of_the_blocks_goes_where_idas_newton_method_does_not(tmp_path: Path) -> None:
    ours, other = (simulated(tmp_path, CYCLE, solver=s, stop=3.0, rtol=1e-6) for s in ("ida", "dopri5"))
    assert ours.complete, ours.failure
    assert ours["x"][-1] == pytest.approx(other["x"][-1], abs=1e-4)


@pytest.mark.parametrize(("solver", "why"), [("ida", "changes fastest"), ("rodas4", "has the largest error")])
def test_the_error_test_names_the_state(tmp_path: Path, solver: str, why: str) -> None:
    result = simulated(tmp_path, JUMPS, solver=solver, stop=3.0)
    assert f"small {why}" in str(result.failure)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize(
    ("law", "pole"), [("x^2", 1.0), ("1 + x^2", math.pi / 4), ("x^3", 0.5), ("exp(x)", math.exp(-1))]
)
def test_no_step_goes_over_a_pole(tmp_path: Path, law: str, pole: float, solver: str) -> None:
    """Where all of an error is less than what time is rounded by times what x' has jumped by, nothing is known of it:
    rodas4 came to 1e37 at time 3, with all signs. Steps err by their tolerance each."""
    model = compiled(tmp_path, f"model Pole Real x(start = 1, fixed = true); equation der(x) = {law}; end Pole;")
    for rtol in (1e-3, 1e-4, 1e-5, 1e-6, 1e-8):
        result = runtime.simulate(model, solver=solver, stop=3.0, rtol=rtol)
        assert not result.complete
        assert result.failure.line == 1
        assert result.failure.time == pytest.approx(pole, rel=rtol * result.counters["steps"])
