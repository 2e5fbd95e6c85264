"""Relations on what equations make of a sampled value: all equations hold together at an event (Modelica 3.6, B.1)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events.models import compiled

SOLVERS = ["ida", "dopri5", "rodas4"]
ALARM = """model Alarm
  discrete Real y(start=0, fixed=true), u(start=0, fixed=true);
  Boolean alarm(start=false, fixed=true), named(start=false, fixed=true), told(start=false, fixed=true), big = e > 0.5;
  Real x = if time < 1.5 then 1 elseif time < 2.5 then -1 else 1, e;
equation
  e = 1 - y;
  when sample(1, 1) then
    y = x;
    alarm = e > 0.5;
    named = big;
    u = if e > 0.5 then 1 else 0;
  end when;
algorithm
  when sample(1, 1) then
    told := e > 0.5;
  end when;
end Alarm;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_what_samples_reads_a_relation_as_it_is_with_what_is_sampled(tmp_path: Path, solver: str) -> None:
    """y is 1, -1, 1 at 1, 2, 3 s, so e is 0, 2, 0."""
    result = runtime.simulate(compiled(tmp_path, ALARM), solver=solver, stop=4.0, interval=0.5)
    assert result.complete, result.failure
    for name in ("alarm", "named", "told", "u"):
        assert [result[name][np.searchsorted(result["time"], t)] for t in (1.5, 2.5, 3.5)] == [0, 1, 0], name


LATE = """model Late
  discrete Real y(start=0, fixed=true), w(start=0, fixed=true);
  Real x(start=0, fixed=true), q;
equation
  der(x) = 1;
  q = 2*y + x;
  when sample(0.5, 0.5) then
    y = x;
  end when;
  when q > 2 then
    w = pre(y);
  end when;
end Late;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_condition_that_follows_what_is_sampled_is_of_the_same_instant(tmp_path: Path, solver: str) -> None:
    """At 1 s y goes from 0.5 to 1 and q from 2 to 3: pre(y) is 0.5."""
    result = runtime.simulate(compiled(tmp_path, LATE), solver=solver, stop=1.2)
    assert (result["y"][-1], result["w"][-1]) == (pytest.approx(1), pytest.approx(0.5))


CONTROL = """model Control "a sampled controller whose comparator is an equation"
  parameter Real T = 0.02, K = 3;
  Real x(start=0, fixed=true), e, r = if time < 1.005 then 1 else -0.5;
  discrete Real xs(start=0, fixed=true), u(start=0, fixed=true);
  Boolean big = e > 0.4 or e < -0.4;
  Integer count(start=0, fixed=true);
equation
  der(x) = u - x;
  e = r - xs;
  when sample(0, T) then
    xs = x;
    u = if big then (if e > 0 then 1.5 else -1.5) else K*e;
    count = if big then pre(count) + 1 else pre(count);
  end when;
end Control;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5"])
def test_a_sampled_controller_against_its_recurrence(tmp_path: Path, solver: str) -> None:
    """x(t + T) = u + (x - u) exp(-T), u by what is sampled at t."""
    model = compiled(tmp_path, CONTROL)
    result = runtime.simulate(model, solver=solver, stop=2.0, rtol=1e-8, interval=0.01)
    assert result.complete, result.failure
    x, decay, count, expected = 0.0, np.exp(-0.02), 0, {}
    for k in range(101):
        e = (1 if 0.02 * k < 1.005 else -0.5) - x
        big = abs(e) > 0.4
        count += big
        u = 1.5 * np.sign(e) if big else 3 * e
        expected[k], x = (u, x), u + (x - u) * decay
    assert result["count"][-1] == count
    for k in range(100):
        row = np.searchsorted(result["time"], 0.02 * k + 0.01 - 1e-9)
        assert result["u"][row] == pytest.approx(expected[k][0], abs=1e-6)
        assert result["xs"][row] == pytest.approx(expected[k][1], abs=1e-6)
