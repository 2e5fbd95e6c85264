"""Asserts: those of level warning are told once in a run, where they are first violated; events are looked at too."""

from __future__ import annotations

from pathlib import Path
import re

import pytest

from lacuna import runtime
from tests.events.models import compiled

MODEL = """model Warned
  parameter Real p = 3;
  Real z(start=0, fixed=true), w;
  discrete Integer n(start=0, fixed=true);
equation
  der(z) = 1;
  w = 2*z;
  assert(p < 2, "p is large", AssertionLevel.warning);
  assert(z < 0.5 or z > 0.8, "late, w is " + String(w), AssertionLevel.warning);
  assert(z < 10, "never", AssertionLevel.warning);
  when z > 0.7 then
    n = pre(n) + 1;
    assert(z < 0.6, "in a when clause", AssertionLevel.warning);
  end when;
end Warned;
"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4", "rk4", "euler"])
def test_each_is_told_where_it_is_first_violated(tmp_path: Path, solver: str) -> None:
    model = compiled(tmp_path, MODEL)
    for _ in range(2):  # a second run begins anew
        run = runtime.simulate(model, solver=solver, step=0.01, stop=1.0)
        assert run.complete
        assert run["z"][-1] == pytest.approx(1)
        large, late, inside = run.warnings
        assert "Warned.mo:8: assertion violated at time 0 s: p is large (p = 3)" in large
        found = re.search(r"Warned.mo:9: .* at time (\S+) s: late, w is w \(z = (\S+), w = (\S+)\)", late)
        assert found
        time, z, w = map(float, found.groups())
        assert 0.5 <= time < 0.8
        assert (z, w) == (pytest.approx(time), pytest.approx(2 * time))
        assert re.search(r"Warned.mo:13: assertion violated at time 0\.7\d* s: in a when clause \(z = 0.7", inside)


def test_none_is_told_of_what_holds(tmp_path: Path) -> None:
    assert runtime.simulate(compiled(tmp_path, MODEL), parameters={"p": 1.0}, stop=0.4).warnings == []


def test_many_are_told_too(tmp_path: Path) -> None:
    """Of many alike, whose checks are rolled into a loop."""
    text = """model Many
  Real x[200](each start=0, each fixed=true);
equation
  for i in 1:200 loop
    der(x[i]) = i;
    assert(x[i] < 100.5, "x is large", AssertionLevel.warning);
  end for;
end Many;
"""
    assert len(runtime.simulate(compiled(tmp_path, text), stop=1.0).warnings) == 100


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4", "euler"])
@pytest.mark.parametrize("at", ["time >= 1", "x > 0.5"])
def test_what_an_event_violates_is_told_at_the_event(tmp_path: Path, solver: str, at: str) -> None:
    """Errors too, and where the run would end there."""
    text = f"""model Counted
  Real x(start=0, fixed=true);
  Integer n(start=0, fixed=true);
equation
  der(x) = 1;
  when {at} then
    n = 1;
  end when;
  assert(n < 1, "n is one");
end Counted;
"""
    run = runtime.simulate(compiled(tmp_path, text), solver=solver, step=0.01, stop=1.0)
    assert run.failure is not None
    assert run.failure.status == "assert"
    assert run.failure.time == pytest.approx(1.0 if "time" in at else 0.5, abs=0.011)
