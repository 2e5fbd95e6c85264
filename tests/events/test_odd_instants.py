"""Events at odd instants and in odd company, counted: by every solver as the language has it."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna import runtime
from tests.events.models import compiled

STOP = 4.25
PRIORITY = """model Priority "Both conditions become true at one instant: the first branch alone happens"
  Real x(start=0, fixed=true);
  Integer a(start=0, fixed=true), b(start=0, fixed=true);
equation
  der(x) = 1;
  when x > 1 then
    a = pre(a) + 1;
    b = pre(b);
  elsewhen x + 0 > 1 then
    b = pre(b) + 1;
    a = pre(a);
  end when;
end Priority;
"""
AT_START = """model AtStart "On the threshold at the start: going up is an event, having been there is none"
  Real x(start=1, fixed=true), y(start=1, fixed=true);
  Integer a(start=0, fixed=true), b(start=0, fixed=true), c(start=0, fixed=true);
equation
  der(x) = 1;
  der(y) = -1;
  when x > 1 then
    a = pre(a) + 1;
  end when;
  when y > 1 then
    b = pre(b) + 1;
  end when;
  when y < 1 then
    c = pre(c) + 1;
  end when;
end AtStart;
"""
CHAIN = """model Chain "What a tick changes is seen by others at the same instant"
  Integer n1(start=0, fixed=true), n2(start=0, fixed=true), n3(start=0, fixed=true);
  Boolean p(start=false, fixed=true);
equation
  when sample(0.5, 0.5) then
    n1 = pre(n1) + 1;
    p = not pre(p);
  end when;
  when change(n1) then
    n2 = pre(n2) + n1;
  end when;
  when edge(p) then
    n3 = pre(n3) + 1;
  end when;
end Chain;
"""
BOTH = """model Both "x reaches 2 at a tick, and is above it right after"
  Real x(start=0, fixed=true);
  Integer a(start=0, fixed=true), b(start=0, fixed=true), c(start=0, fixed=true);
equation
  der(x) = 1;
  when sample(1, 1) then
    a = pre(a) + 1;
  end when;
  when x > 2 then
    b = pre(b) + 1;
  end when;
  when {sample(1, 1), x > 2} then
    c = pre(c) + 1;
  end when;
end Both;
"""
ALGORITHM = """model Algorithm "A vector of conditions, a loop and a branch in an algorithm; x = sin(time)"
  Real x(start=0, fixed=true), s(start=0, fixed=true);
  Integer n(start=0, fixed=true), m(start=0, fixed=true);
equation
  der(x) = cos(time);
algorithm
  when {x > 0.5, x < -0.5} then
    n := pre(n) + 1;
    for i in 1:3 loop
      m := m + i;
    end for;
    if n > 2 then
      s := s + 10;
    else
      s := s + 1;
    end if;
  elsewhen x > 0.9 then
    s := s + 100;
  end when;
end Algorithm;
"""
WRAP = """model Wrap "An angle that is brought back, and the sector of a circle that it is in"
  Real phi(start=0, fixed=true);
  Integer turns(start=0, fixed=true), sector;
equation
  der(phi) = 7;
  when phi > 3.141592653589793 then
    reinit(phi, phi - 6.283185307179586);
    turns = pre(turns) + 1;
  end when;
  sector = integer(floor((phi + 3.141592653589793)/1.0471975511965976));
end Wrap;
"""
PLAY = """model Play "A play of a micrometre between two that have travelled 40 m: a - b = 2e-6 sin(5 time)"
  Real a(start=0, fixed=true), b(start=0, fixed=true);
  Integer n(start=0, fixed=true);
equation
  der(a) = 10 + 1e-5*cos(5*time);
  der(b) = 10;
  when a - b > 1e-6 then
    n = pre(n) + 1;
  end when;
end Play;
"""
EXPECTED = {
    PRIORITY: {"a": 1, "b": 0},
    AT_START: {"a": 1, "b": 0, "c": 1},
    CHAIN: {"n1": 8, "n2": 36, "n3": 4},
    BOTH: {"a": 4, "b": 1, "c": 5},
    ALGORITHM: {"n": 2, "m": 12, "s": 102},
    WRAP: {"turns": 5, "sector": 1},
    PLAY: {"n": 4},
}


@pytest.mark.parametrize("text", EXPECTED, ids=lambda t: t.split()[1])
def test_counts(tmp_path: Path, text: str) -> None:
    model = compiled(tmp_path, text)
    for solver in ("ida", "dopri5", "rodas4", "rk4"):
        settings = {"step": 0.01} if solver == "rk4" else {"rtol": 1e-9}
        result = runtime.simulate(model, solver=solver, stop=STOP, interval=0.05, **settings)
        assert result.complete, result.failure
        assert {name: result[name][-1] for name in EXPECTED[text]} == EXPECTED[text], solver


ARRIVAL = """model Arrival "What jumps at an event, as it was when the event came: at a time and at a crossing"
  Real x(start=0, fixed=true), kept(start=5, fixed=true);
  Real u = if time < 0.5 then 1 else 2;
  Real w = if x < 1.5 then 10 else 20;
  discrete Real q(start=0, fixed=true), p(start=0, fixed=true), now(start=0, fixed=true), s(start=0, fixed=true);
equation
  der(x) = 1;
  der(kept) = 0;
  when time >= 0.5 then
    q = pre(u);
    now = u;
    reinit(kept, pre(u));
  end when;
  when x >= 1.5 then
    p = pre(w);
  end when;
  when sample(0, 0.25) then
    s = pre(u);
  end when;
end Arrival;
"""


def test_what_jumps_at_an_event_is_on_arrival_what_it_was(tmp_path: Path) -> None:
    """The left limit, by every solver (3.7.5): it was the value after the event. What is sampled as it jumps comes a
    sample later, as from a unit delay."""
    model = compiled(tmp_path, ARRIVAL)
    for solver in ("ida", "dopri5", "rodas4", "rk4"):
        settings = {"step": 0.01} if solver == "rk4" else {"rtol": 1e-9}
        for events in (True, False):
            result = runtime.simulate(
                model, solver=solver, stop=STOP, interval=0.05, events=events, outputs=["q", "p", "now", "kept", "s"],
                **settings,
            )  # fmt: skip
            assert result.complete, result.failure
            last = {name: result[name][-1] for name in ("q", "p", "now", "kept", "s")}
            assert last == {"q": 1, "p": 10, "now": 2, "kept": 1, "s": 2}, solver
            assert result["s"][result.time < 0.74].max() == 1
