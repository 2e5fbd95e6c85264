"""Time events whose instants differ by the rounding of the sums that they come from."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.compile import compile_model
from lacuna.runtime.model import Model
from lacuna.runtime.simulation import simulate

PULSES = """model Pulses "Two trains of pulses of one period, one by a product, one by a sum"
  parameter Real period = 0.002;
  Integer count(start = 0, fixed = true), ticks(start = 0, fixed = true);
  Boolean inside = time < (pre(count) + 1)*period;
  discrete Real next(start = period, fixed = true);
equation
  when not inside then
    count = pre(count) + 1;
  end when;
  when time >= pre(next) then
    next = pre(next) + period;
    ticks = pre(ticks) + 1;
  end when;
end Pulses;
"""
TABLE = """model Table "A switching time that a clock of tenths nearly meets"
  parameter Real t[2] = {50, 80};
  Boolean before = time < t[1];
  Integer changes(start = 0, fixed = true), ticks(start = 0, fixed = true);
  discrete Real next(start = 0.1, fixed = true);
equation
  when time >= pre(next) then
    next = pre(next) + 0.1;
    ticks = pre(ticks) + 1;
  end when;
  when change(before) then
    changes = pre(changes) + 1;
  end when;
end Table;
"""


@pytest.mark.parametrize(("text", "counts"), [(PULSES, {"count": 50_000, "ticks": 50_000}), (TABLE, {"changes": 1})])
def test_each_of_two_instants_that_nearly_meet_happens_once(text: str, counts: dict[str, int], tmp_path: Path) -> None:
    path = tmp_path / f"{text.split()[1]}.mo"
    path.write_text(text)
    result = simulate(Model(compile_model(str(path)).path), stop=100.001, interval=10.0, events=False)
    assert result.complete, result.failure
    assert {name: int(result[name][-1]) for name in counts} == counts
    if "next" in result.model.variables:
        assert result["ticks"][-1] == pytest.approx(result["next"][-1] / (result["next"][0]) - 1, abs=1e-6)


AT_THE_START = """model AtTheStart "Relations of time whose instant is the start"
  Boolean after = time > {T}, from = time >= {T}, until = time <= {T};
  Boolean first(start = false, fixed = true);
  Integer count(start = 0, fixed = true), beside(start = 0, fixed = true);
equation
  when initial() then
    first = time > {T};
  end when;
  when {{after, not until, time > {T}}} then
    count = pre(count) + 1;
  end when;
  when from then
    beside = pre(beside) + 1;
  end when;
end AtTheStart;
"""


@pytest.mark.parametrize("start", [0.0, 0.3, -2.0])
@pytest.mark.parametrize("solver", ["ida", "dopri5", "rk4"])
def test_time_is_not_after_the_start_at_the_start(start: float, solver: str, tmp_path: Path) -> None:
    """`time > T` held at T already where the run began there, so that no when-clause saw it become true."""
    path = tmp_path / "AtTheStart.mo"
    path.write_text(AT_THE_START.format(T=start))
    model = Model(compile_model(str(path)).path)
    step = {"step": 0.1} if solver == "rk4" else {}
    result = simulate(model, start=start, stop=start + 1, interval=0.1, events=False, solver=solver, **step)
    assert result.complete, result.failure
    assert (result["first"][-1], result["beside"][-1]) == (0, 0)
    assert result["after"][-1] == 1 and result["count"][-1] == 1
