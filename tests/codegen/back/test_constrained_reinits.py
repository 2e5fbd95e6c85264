"""reinit of variables that constraints bind: a pendulum in x and y, whose state is chosen anew as it turns over."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.events.models import simulated

GRAVITY = 9.81
PENDULUM = """model Pendulum
  Real x(start = 0, fixed = true), y(start = -1), vx(start = 8, fixed = true), vy, F;
equation
  der(x) = vx; der(y) = vy; der(vx) = -F*x; der(vy) = -F*y - 9.81; x^2 + y^2 = 1;
  {when}
end Pendulum;
"""
HEIGHT = {"x": lambda s: np.sin(s[0]), "y": lambda s: -np.cos(s[0])}


def swing(t: np.ndarray, coordinate: str, level: float) -> np.ndarray:
    """x at t of the angle from the bottom, whose speed is turned round to 0.9 of it where the coordinate comes to the
    level from below."""

    def hit(_: float, s: np.ndarray) -> float:
        return HEIGHT[coordinate](s) - level

    hit.terminal, hit.direction = True, 1
    now, state, found = 0.0, [0.0, 8.0], np.full(len(t), np.nan)
    while now < t[-1]:
        flight = solve_ivp(
            lambda _, s: [s[1], -GRAVITY * np.sin(s[0])], (now, t[-1]), state, method="DOP853", rtol=1e-12, atol=1e-12,
            events=hit, dense_output=True,
        )  # fmt: skip
        inside = (t >= now) & (t <= flight.t[-1])
        found[inside] = np.sin(flight.sol(t[inside])[0])
        now, state = flight.t[-1], [flight.y[0, -1], -0.9 * flight.y[1, -1]]
    return found


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize(("coordinate", "level"), [("x", 0.9), ("x", 2 / math.sqrt(5)), ("x", 1 / math.sqrt(5)),
                                                   ("y", 0.9), ("y", -1 / math.sqrt(5))])  # fmt: skip
def test_a_speed_is_set_whatever_the_state_is(tmp_path: Path, solver: str, coordinate: str, level: float) -> None:
    """A wall, also where another state is chosen at that very instant (a tangent of 2)."""
    wall = f"when {coordinate} > {level!r} then reinit(vx, -0.9*pre(vx)); end when;"
    text = PENDULUM.format(when=wall)
    r = simulated(tmp_path, text, solver=solver, stop=3, rtol=1e-8, interval=0.1, events=False)
    assert r.complete, r.failure
    np.testing.assert_allclose(r["x"], swing(r["time"], coordinate, level), atol=1e-5)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4", "rk4"])
def test_a_coordinate_that_a_reinit_makes_a_state_is_watched(tmp_path: Path, solver: str) -> None:
    """No straight line leads along a circle, so x is the state all the time, until it is none at the bottom: runs came
    through with an energy of their own."""
    text = PENDULUM.format(when="when time > 100 then reinit(x, 0); end when;")
    r = simulated(tmp_path, text, solver=solver, stop=3, interval=0.1, **({"step": 1e-3} if solver == "rk4" else {}))
    assert not r.complete
    assert "a reinit of x makes it one" in r.failure.message


def test_two_speeds_that_reinits_set_are_one_too_many(tmp_path: Path) -> None:
    """One degree of freedom: both cannot be states."""
    text = PENDULUM.format(when="when x > 0.9 then reinit(vx, -pre(vx)); reinit(vy, -pre(vy)); end when;")
    with pytest.raises(Exception, match="is not a state here"):
        simulated(tmp_path, text, solver="dopri5", stop=3)
