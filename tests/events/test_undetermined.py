"""Linear equations that leave unknowns open in a mode: the motion goes on where it does not depend on them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.events.models import simulated

# Two brakes hold one shaft, and of their torques only the sum follows; a load that grows with time tears it loose at
# J*a = load - limit1 - limit2. `more` inertias behind springs take IDA from a dense matrix to a sparse one.
BRAKES = """model Brakes
  parameter Real J = 2, slope = 3, limit1 = 1, limit2 = 5, c = 4;
  parameter Integer more = {more};
  Real w(start = 0, fixed = true), a, s1, s2, tau1, tau2;
  Real phi[more](each start = 0.1, each fixed = true), v[more](each start = 0, each fixed = true);
  Boolean held1 = s1 < limit1, held2 = s2 < limit2;
equation
  der(w) = a;
  J*a = slope*time - tau1 - tau2;
  tau1 = if held1 then s1 else limit1;
  a = if held1 then 0 else s1 - limit1;
  tau2 = if held2 then s2 else limit2;
  a = if held2 then 0 else s2 - limit2;
  der(phi) = v;
  der(v) = -c*phi;
end Brakes;
"""


@pytest.mark.parametrize("more", [1, 8])
@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_two_brakes_on_one_shaft_give_way_together(tmp_path: Path, solver: str, more: int) -> None:
    result = simulated(tmp_path, BRAKES.format(more=more), solver=solver, rtol=1e-8, stop=4.0)
    assert result.complete, result.failure
    loose = np.maximum(result.time - 2.0, 0.0)
    np.testing.assert_allclose(result["w"], 0.75 * loose**2, atol=1e-6)
    assert [e.time for e in result.event_log if "limit1" in e.text] == [pytest.approx(2.0, abs=1e-8)]
    both = result.time < 5.2 / 3  # shares go as the squares of the limits until the second brake reaches its own
    np.testing.assert_allclose(result["tau1"][both], 3 * result.time[both] / 26, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(result["phi[1]"], 0.1 * np.cos(2 * result.time), atol=1e-6)


# At the start they may let go together: the relations go round in circles as long as each is judged strictly while the
# other brake holds.
TOGETHER = """model Together
  parameter Real limit1 = 1, limit2 = 5, load = {load};
  Real w(start = 0, fixed = true), a, s1, s2, tau1, tau2;
  Boolean loose1 = s1 > limit1, loose2 = s2 > limit2;
equation
  der(w) = a;
  2*a = load - tau1 - tau2;
  tau1 = if loose1 then limit1 else s1;
  a = if loose1 then s1 - limit1 else 0;
  tau2 = if loose2 then limit2 else s2;
  a = if loose2 then s2 - limit2 else 0;
end Together;
"""


@pytest.mark.parametrize(("load", "a"), [(1.0, 0.0), (10.0, 2.0)])
def test_at_the_start(tmp_path: Path, load: float, a: float) -> None:
    result = simulated(tmp_path, TOGETHER.format(load=load), stop=1.0)
    assert result.complete, result.failure
    assert result["w"][-1] == pytest.approx(a, abs=1e-6)


OPEN = """model Open
  Real x(start = 0, fixed = true), y, z;
  Real gap = {gap};
equation
  der(x) = {rate};
  y + z = {sum};
  gap*(y - z) = {right};
end Open;
"""


BEFORE = "if time < 0.5 then 1 else 0"
REFUSED = {
    "decides a derivative": (
        {"gap": BEFORE, "rate": "y", "sum": "1", "right": "0"},
        "Open.mo:7: a block of linear equations has no unique solution at time 0.5 s, and what it leaves open decides "
        "the derivative of x; open are y, z",
    ),
    "at one instant only": (
        {"gap": "x", "rate": "1", "sum": "1", "right": "sin(x)"},
        "one that it had at the last event only has no value",
    ),
    "contradictory": (
        {"gap": BEFORE, "rate": "1", "sum": "1", "right": "1"}, "at time 0.5 s: linear equations have no solution",
    ),
}  # fmt: skip


@pytest.mark.parametrize("solver", ["ida", "dopri5"])
@pytest.mark.parametrize("case", REFUSED)
def test_what_is_open_is_no_answer_elsewhere(tmp_path: Path, solver: str, case: str) -> None:
    values, said = REFUSED[case]
    result = simulated(tmp_path, OPEN.format(**values), solver=solver, stop=1.0)
    assert not result.complete and said in str(result.failure)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_what_is_left_open_is_told_once(tmp_path: Path, solver: str) -> None:
    text = """model Share
  Real a, b, x(start=1, fixed=true);
equation
  a + b = time;
  2*a + 2*b = 2*time;
  der(x) = -x;
end Share;
"""
    result = simulated(tmp_path, text, solver=solver, stop=1.0)
    assert result.complete, result.failure
    np.testing.assert_allclose(result["a"] + result["b"], result.time, atol=1e-9)
    (said,) = result.warnings
    assert "the equations leave open a, b from time 0 s on" in said and "Share.mo:" in said
