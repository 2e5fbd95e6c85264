"""Small swings of guards beside large states: a sample of `make swings`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from tests.events import swings
from tests.events.belts import SOLVERS
from tests.events.models import compiled


@pytest.mark.parametrize("number", [*range(12), 73])  # 73: a first step of most of a period
def test_none_is_lost(tmp_path: Path, number: int) -> None:
    swing = swings.draw(np.random.default_rng([2028, number]), number)
    model = compiled(tmp_path, swing.text)
    for solver in SOLVERS:
        for rtol in swings.TOLERANCES:
            assert swings.wrong(model, swing, solver, rtol) == "", (solver, rtol)


def counted(folder: Path, text: str, solver: str, stop: float, tolerances: Sequence[float], **expected: int) -> None:
    """What a model counts until `stop`, by each tolerance."""
    model = compiled(folder, text)
    for rtol in tolerances:
        result = runtime.simulate(model, solver=solver, rtol=rtol, stop=stop, interval=0, outputs=list(expected))
        assert result.complete, result.failure
        assert {name: result[name][-1] for name in expected} == expected, rtol


MANY = """model Many
  "a ratchet: a float on waves of 2e-6 m that drifts by 400 m, against a mark that drifts with it"
  Real x(start=0, fixed=true), y(start=0, fixed=true);
  Integer n(start=0, fixed=true);
equation
  der(x) = 0.8 + 2e-6*12.566370614359172*cos(12.566370614359172*time);
  der(y) = 0.8;
  when x - y > 1e-6 then
    n = pre(n) + 1;
  end when;
end Many;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_thousand_waves_are_counted(tmp_path: Path, solver: str) -> None:
    """By tolerances on both sides of the waves: the states are to be known to 1e-6 m at 2.5e-9, the guard is always."""
    counted(tmp_path, MANY, solver, 500.0, (1e-6, 2.5e-9, 2.5e-10, 2.5e-11), n=1000)


CLOSE = """model Close
  "a guard of two states that is zero but for its swing, seen through two linear equations, and one that follows time"
  Real x(start=1e3, fixed=true), v(start=1, fixed=true), f, g;
  Integer n(start=0, fixed=true), m(start=0, fixed=true);
equation
  der(x) = v;
  der(v) = -1e4*(x - 1e3);
  2*f + g = 3*x + time;
  f - g = 2*time;
  when f > 1e3 + time + 0.005 then
    n = pre(n) + 1;
  end when;
  when g < 1e3 - time + 0.002 then
    m = pre(m) + 1;
  end when;
end Close;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_guards_through_equations_and_time_are_affine_too(tmp_path: Path, solver: str) -> None:
    """f = x + time and g = x - time, x = 1000 + 0.01 sin(100 t): 16 periods in a second."""
    counted(tmp_path, CLOSE, solver, 1.0, (1e-3, 1e-5, 1e-7), n=16, m=16)


STIFF = """model Stiff
  "an open switch between two inductances with 60 A: their difference follows the voltage at 2e8 in a second"
  Real a(start=0, fixed=true), b(start=0, fixed=true), v;
  Integer n(start=0, fixed=true);
equation
  v = (a - b)/1e-5;
  1e-3*der(a) = 10*cos(100*time) + 1e-3*sin(300*time + 1) - v;
  1e-3*der(b) = 10*cos(100*time) + v;
  when v > 0 then
    n = pre(n) + 1;
  end when;
end Stiff;
"""


@pytest.mark.parametrize("solver", ["ida", "rodas4"])
def test_what_fast_rates_make_of_rounding_is_no_swing(tmp_path: Path, solver: str) -> None:
    """v = 0.5e-3 sin(300 t + 1): it rises at the start, and at 300 t + 1 = 2 pi, 4 pi, 6 pi, 8 pi."""
    counted(tmp_path, STIFF, solver, 0.1, (1e-4, 1e-6), n=5)


STARTS = """model Starts
  "an induction machine with a fan, from rest: the torque is a difference of products that are all but equal"
  parameter Integer p = 2;
  parameter Real Rs = 0.5, Rr = 0.4, L = 0.06, Lm = 0.057, J = 0.02;
  Real s[2](each start=0, each fixed=true), r[2](each start=0, each fixed=true), is[2], ir[2];
  Real w(start=0, fixed=true), v[3] = {310*cos(314*time - k*2.0943951023931953) for k in 0:2};
equation
  s = L*is + Lm*ir;
  r = L*ir + Lm*is;
  der(s) = [2/3, -1/3, -1/3; 0, sqrt(3)/3, -sqrt(3)/3]*v - Rs*is;
  der(r) = p*w*{-r[2], r[1]} - Rr*ir;
  J*der(w) = 1.5*p*(s[1]*is[2] - s[2]*is[1]) - 0.001*w*abs(w);
end Starts;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_noise_of_what_is_zero_as_yet_is_no_swing(tmp_path: Path, solver: str) -> None:
    """The speed is of the size of rounding at first, and moves to and fro within it; against SciPy at the end."""
    result = runtime.simulate(compiled(tmp_path, STARTS), solver=solver, rtol=1e-9, stop=0.1)
    assert result.complete, result.failure
    assert result["w"][-1] == pytest.approx(160.57559, rel=1e-6)
