"""A ball whose bounces pile up does not fall through the floor; with a resting mode it comes to rest."""

from __future__ import annotations

import math

import pytest

from lacuna import runtime
from tests.events.models import compiled

BALL = """model Ball
  parameter Real e = 0.8, h0(unit="m") = 1, g(unit="m/s2") = 9.81, vRest(unit="m/s") = 0;
  Real h(unit="m", start=h0, fixed=true), v(unit="m/s", start=0, fixed=true);
  Boolean flying(start=true, fixed=true);
equation
  der(h) = v;
  der(v) = if flying then -g else 0;
  when h < 0 then
    reinit(v, if -e*v > vRest then -e*v else 0);
    flying = -e*v > vRest;
  end when;
end Ball;
"""


@pytest.fixture(scope="module")
def ball(tmp_path_factory: pytest.TempPathFactory) -> runtime.Model:
    return compiled(tmp_path_factory.mktemp("ball"), BALL)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize("height", [1e-12, 1.0, 1e9])
@pytest.mark.parametrize("e", [0.1, 0.5, 0.95])
def test_bounces_that_pile_up_are_reported_where_they_do(
    ball: runtime.Model, solver: str, height: float, e: float
) -> None:
    """At time sqrt(2 h0/g) (1 + e)/(1 - e), whatever the unit of length: nothing has a scale of its own. What is left
    when rounding swallows a hop of 1e-10 h0 is sqrt(1e-10) of that time, more where hops shrink slowly."""
    rest = math.sqrt(2 * height / 9.81) * (1 + e) / (1 - e)
    for rtol in (1e-4, 1e-6, 1e-8, 1e-10):
        result = runtime.simulate(
            ball, solver=solver, rtol=rtol, parameters={"h0": height, "e": e}, stop=2 * rest, interval=0
        )
        assert result.failure is not None, rtol
        assert result.failure.status == "chattering"
        assert result.failure.time == pytest.approx(rest, rel=max(3e-3, 30 * rtol))
        assert result["h"].min() > -1e-6 * height


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_with_a_resting_mode_it_rests(ball: runtime.Model, solver: str) -> None:
    result = runtime.simulate(ball, solver=solver, parameters={"vRest": 1e-3}, stop=6.0, interval=0)
    assert result.complete, result.failure
    assert result["v"][-1] == 0
    assert abs(result["h"][-1]) < 1e-9
