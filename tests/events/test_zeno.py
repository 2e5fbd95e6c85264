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


LEG = """model Leg
  "A leg of a bridge beside a shuttle that bounces at a steady rate; the leg's voltage rests where its guard is small"
  parameter Real vOn(unit="V") = 1e-6, creep(unit="V/s") = 1e-15;
  Real x(unit="m", start=0.5, fixed=true), w(unit="m/s", start=-10, fixed=true);
  Real drift(unit="V", start=0, fixed=true), v(unit="V", nominal=2e4);
  Boolean conducts;
  Integer bounces(start=0, fixed=true);
equation
  der(x) = w;
  der(w) = 0;
  der(drift) = -creep;
  v = if time < 0.985 then drift elseif time < 1.985 then 18 else -18;
  conducts = -vOn > v;
  when {x < 0, x > 1} then
    reinit(w, -w);
    bounces = pre(bounces) + 1;
  end when;
end Leg;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_a_guard_that_rests_near_zero_beside_steady_bounces_is_no_zeno(
    solver: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """The leg's guard lies within the hysteresis at every bounce and moves towards its threshold by rounding, but no
    event of its own has thrown it back: when its voltage rises at last, nothing has been lost."""
    model = compiled(tmp_path_factory.mktemp("leg"), LEG)
    result = runtime.simulate(model, solver=solver, stop=3.0, interval=0)
    assert result.complete, result.failure
    assert result["bounces"][-1] == 30
    assert [bool(c) for c in (result["conducts"][0], result["conducts"][-1])] == [False, True]


CLOCK = """  discrete Real seen(start=0, fixed=true);
equation
  when sample(0, 1e-4) then
    seen = h;
  end when;
"""
CLOCKED = BALL.replace(" Ball", " Clocked").replace("equation\n", CLOCK)


@pytest.mark.parametrize("e", [0.01, 0.1, 0.9])
def test_other_events_between_the_bounces_do_not_hide_them(tmp_path_factory: pytest.TempPathFactory, e: float) -> None:
    """A clock that ticks between bounces: intervals are those between events of one relation."""
    model = compiled(tmp_path_factory.mktemp("clocked"), CLOCKED)
    rest = math.sqrt(2 / 9.81) * (1 + e) / (1 - e)
    result = runtime.simulate(model, solver="dopri5", parameters={"e": e}, stop=2 * rest, interval=0)
    assert result.failure is not None
    assert result.failure.status == "chattering"
    assert result.failure.time == pytest.approx(rest, rel=3e-3)
