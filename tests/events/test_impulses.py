"""What the model has the derivative of must not jump at an event: an impulse would be needed. It may bend."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.events.models import simulated

JUMPS = {
    "a relation": ("x = if time > 1 then 2 else 1; der(x) = v;", "x jump from 1 to 2", 1.0),
    "a discrete variable": (
        "x = p*time; der(x) = v; when time > 0.5 then p = 2; end when;",
        "x jump from 0.5 to 1",
        0.5,
    ),
    "as a rate that jumps with it": (
        "x = if s > 0.5 then 1 else 0; y = max(s, 0.5); der(x) + der(y) = v;",
        "x jump from 0 to 1",
        1.0,
    ),
    "by way of another": ("y = if s > 1e-9 then 1e-9 else 0; x = y; der(x) = v;", "jump from 0 to 1e-09", 0.5),
}
BENDS = {
    "two branches that meet": "x = if s > 0.3 then s else 0.6 - s; der(x) = v;",
    "the end of a ramp that is differentiated twice": "x = min(s, 0.2); der(x) = v; y = der(v);",
    "an absolute value": "x = 1e-9*abs(s); der(x) = v;",
    "a limit": "x = min(s, 0.2) + sin(time); der(x) = v;",
    "a discrete variable that does not change": "x = p*s; der(x) = v; when s > 0.1 then p = pre(p); end when;",
    "a state that is set": "x = 2*s + (if s > 0.1 then s - 0.1 else 0); der(x) = v;",
}


def model(equations: str) -> str:
    discrete = "discrete Real p(start=1, fixed=true);" if "p =" in equations else ""
    other = "Real y;" if "y =" in equations else ""
    return f"""model M
  Real x, v, s(start=-0.5, fixed=true); {other} {discrete}
equation
  der(s) = 1;
  {equations}
end M;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rk4"])
@pytest.mark.parametrize("kind", JUMPS)
def test_a_jump_is_refused(tmp_path: Path, kind: str, solver: str) -> None:
    equations, text, at = JUMPS[kind]
    result = simulated(tmp_path, model(equations), solver=solver, stop=2.0, **_step(solver))
    assert result.failure is not None
    assert (result.failure.status, result.failure.line) == ("singular", 5)
    assert result.failure.time == pytest.approx(at, abs=1e-6)
    assert text in result.failure.message and "impulse" in result.failure.message


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rk4"])
@pytest.mark.parametrize("kind", BENDS)
def test_a_bend_is_none(tmp_path: Path, kind: str, solver: str) -> None:
    result = simulated(tmp_path, model(BENDS[kind]), solver=solver, stop=2.0, **_step(solver))
    assert result.complete, result.failure
    assert result["s"][-1] == pytest.approx(1.5, rel=1e-6)


def _step(solver: str) -> dict[str, float]:
    return {"step": 0.01} if solver == "rk4" else {}
