"""Parameters that contradict each other are refused before anything is computed: component, rule, values, bound."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model

MODEL = """model Limits
  parameter Real lo(unit="V") = -1;
  parameter Real hi(unit="V", max=supply) = 1;
  parameter Real supply(unit="V") = 10;
  parameter Real T(unit="s", min=1e-3) = 1;
  Real x(unit="V", start=0, fixed=true);
  discrete Real held(unit="V", start=0, fixed=true);
  Clamp clamp(low=lo, high=hi);
  model Clamp
    parameter Real low(unit="V");
    parameter Real high(unit="V");
  equation
    assert(low < high, "Clamp: low must be below high");
  end Clamp;
equation
  der(x) = (hi - x)/T;
  assert(x < hi/2, "x stays in the lower half");
  when time > 2 then
    held = x;
    assert(held > hi or x > hi, "x is large by then");
  end when;
  annotation(experiment(StopTime=3));
end Limits;
"""


@pytest.fixture(scope="module")
def limits(tmp_path_factory: pytest.TempPathFactory) -> runtime.Model:
    path = tmp_path_factory.mktemp("limits") / "Limits.mo"
    path.write_text(MODEL)
    return runtime.Model(compile_model(str(path)).path)


def failure(model: runtime.Model, **parameters: float) -> runtime.Result:
    result = runtime.simulate(model, parameters=parameters)
    assert result.failure is not None
    return result


def test_a_broken_rule_shows_component_rule_and_values(limits: runtime.Model) -> None:
    result = failure(limits, lo=3.0)
    message = str(result.failure)
    assert "Limits.mo:13: clamp: assertion violated at time 0 s: Clamp: low must be below high" in message
    assert message.endswith("(clamp.low = 3 V, clamp.high = 1 V)")
    assert len(result) == 0, "nothing is computed with limits that contradict each other"


def test_a_rule_about_what_changes_shows_the_values_then(limits: runtime.Model) -> None:
    """x = hi (1 - exp(-t/T)) passes hi/2 at T ln 2, and is recorded until the step before."""
    result = failure(limits, T=2.0)
    assert "x stays in the lower half (x = 0.5" in str(result.failure)
    assert str(result.failure).endswith("hi = 1 V)")
    assert result.time[-1] < 2 * math.log(2) < result.failure.time


def test_in_a_when_clause_what_is_about_to_change_is_left_out(limits: runtime.Model) -> None:
    message = str(failure(limits, T=30.0).failure)
    assert "x is large by then (hi = 1 V, x = 0.0644" in message
    assert "held" not in message


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"hi": 11.0}, "parameter hi = 11 is outside its bounds [-inf, 10] V"),
        ({"supply": 0.5}, "parameter hi = 1 is outside its bounds [-inf, 0.5] V"),
        ({"hi": 11.0, "supply": 10.5}, "parameter hi = 11 is outside its bounds [-inf, 10.5] V"),
    ],
)
def test_a_bound_that_follows_a_parameter_is_shown_as_it_is(limits: runtime.Model, values: dict, words: str) -> None:
    assert words in str(failure(limits, **values).failure)


def test_a_bound_that_follows_a_parameter_moves_with_it(limits: runtime.Model) -> None:
    assert "bounds" not in str(failure(limits, hi=11.0, supply=20.0).failure)
    assert limits.parameters["hi"].max == float("inf")


def test_end_stops_in_the_wrong_order_are_refused_with_both(tmp_path: Path) -> None:
    (tmp_path / "Stops.mo").write_text(
        "model Stops\n  Lacuna.Components.Mechanics.Inertia load(J=1);\n"
        "  Lacuna.Components.Mechanics.EndStops stops(phi_max=0.1, phi_min=0.2);\nequation\n"
        "  connect(stops.flange_b, load.flange_a);\nend Stops;\n"
    )
    result = runtime.simulate(runtime.Model(compile_model(str(tmp_path / "Stops.mo")).path))
    assert "stops: assertion violated" in str(result.failure)
    assert str(result.failure).endswith(
        "EndStops: phi_min must be below phi_max (stops.phi_min = 0.2 rad, stops.phi_max = 0.1 rad)"
    )


@pytest.mark.parametrize("value", [math.inf, -math.inf])
def test_an_infinite_number_is_refused_as_one(limits: runtime.Model, value: float) -> None:
    """It was told of a Real that it is of whole numbers."""
    with pytest.raises(runtime.SimulationError, match=r"parameter lo cannot be -?inf: it is of finite numbers"):
        runtime.simulate(limits, stop=1, parameters={"lo": value})
