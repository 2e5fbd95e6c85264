"""What is no finite number ends a run with the equation, its values and the time, at the start and on the way."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.events.models import simulated

SOLVERS = ("ida", "dopri5", "rodas4")
POLE = """model Pole
  parameter Real c = 1;
  Real x(start=-1, fixed=true);
  Real y = c/x;
equation
  der(x) = 2;
end Pole;
"""
ROOT = POLE.replace("Pole", "Root").replace("start=-1", "start=1").replace("c/x", "sqrt(x)").replace("= 2", "= -2")


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_divisor_that_passes_through_zero_is_a_division_by_zero(tmp_path: Path, solver: str) -> None:
    failure = simulated(tmp_path, POLE, solver=solver).failure
    assert failure.status == "domain"
    assert failure.time == pytest.approx(0.5, abs=1e-6)
    assert "Pole.mo:4: division by zero: a divisor passes through zero at time 0.5" in str(failure)
    assert failure.line == 4


def test_a_pole_is_found_in_seconds_since_1970_too(tmp_path: Path) -> None:
    """The rounding of time, 2.4e-7 s, lets a quotient grow by less than a pole does; a divisor that jumps is none."""
    since = {"start": 1.7e9, "stop": 1.7e9 + 1, "max_step": 0.01}
    failure = simulated(tmp_path, POLE.replace("start=-1", "start=-0.6"), **since).failure
    assert "division by zero: a divisor passes through zero" in str(failure)
    assert failure.time - 1.7e9 == pytest.approx(0.3, abs=1e-5)
    jump = POLE.replace("c/x", "c/noEvent(if x < -0.4 then -1.0 else 1.0)")
    assert simulated(tmp_path, jump, **since).complete


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_root_of_a_negative_number_is_told_with_its_values(tmp_path: Path, solver: str) -> None:
    failure = simulated(tmp_path, ROOT, solver=solver, max_step=0.05).failure
    assert failure.status == "non_finite"
    assert 0.5 < failure.time < 0.56
    assert "variable y (value nan); in: y = sqrt(x) (x = -0.0" in str(failure)


@pytest.mark.parametrize("solver", SOLVERS)
def test_what_a_derivative_takes_its_value_from_is_told_where_that_is_none(tmp_path: Path, solver: str) -> None:
    """The residual form has sqrt(x) in the balance of x: IDA told that line, with an x that was right."""
    text = ROOT.replace("sqrt(x)", "sqrt(x) + 0.1").replace("= -2", "= -y")
    failure = simulated(tmp_path, text, solver=solver, stop=3.0).failure
    assert failure.status == "non_finite"
    assert failure.line == 4
    assert "variable y (value nan); in: y = sqrt(x) + 0.1" in str(failure)


def test_between_two_steps_a_recorded_value_is_looked_at_too(tmp_path: Path) -> None:
    """x = 1 - 4 (1 - t) t touches -1e-2 between steps that end on positive values."""
    text = ROOT.replace("sqrt(x)", "sqrt((time - 0.5)^2 - 1e-4)")
    failure = simulated(tmp_path, text, solver="dopri5", interval=0.005, events=False).failure
    assert failure.status == "non_finite"
    assert 0.49 < failure.time < 0.51


def test_a_parameter_that_divides_by_zero_is_refused(tmp_path: Path) -> None:
    text = "model Inverse\n  parameter Real a = 0;\n  parameter Real b = 1/a;\n  Real y = b*time;\nend Inverse;\n"
    failure = simulated(tmp_path, text).failure
    assert failure.status == "non_finite"
    assert "Inverse.mo:3: computing parameters" in str(failure)
    assert "b = 1 / a (a = 0, b = inf)" in str(failure)


def test_at_the_start_too(tmp_path: Path) -> None:
    failure = simulated(tmp_path, POLE.replace("start=-1", "start=0")).failure
    assert failure.time == 0.0
    assert "variable y (value inf); in: y = c / x (c = 1, x = 0, y = inf)" in str(failure)


def test_overflow(tmp_path: Path) -> None:
    failure = simulated(tmp_path, POLE.replace("c/x", "exp(1000*x + 1000)"), solver="dopri5").failure
    assert failure.status == "non_finite"
    assert "variable y (value inf)" in str(failure)


@pytest.mark.parametrize("y", ["sin(x)/x", "(1 - cos(x))/x", "if x > 0 then c/x else 0", "c/(1 + x^2)", "x/sqrt(x^2)",
                               "x/(2 + abs(x))"])  # fmt: skip
def test_what_only_looks_like_a_pole_passes(tmp_path: Path, y: str) -> None:
    """0/0 that has a limit, a branch that does not hold there, a sum of squares, a numerator of zero at an event."""
    result = simulated(tmp_path, POLE.replace("c/x", y), solver="dopri5", interval=0.03, events=False)
    assert result.complete or "if x" in y, result.failure


def test_an_index_outside_its_array_is_told(tmp_path: Path) -> None:
    text = """model Outside
  Real v[3] = {time, 2*time, 3*time};
  Integer k(start=1, fixed=true);
  Real y = v[k];
equation
  when time > 0.5 then
    k = 7;
  end when;
end Outside;
"""
    failure = simulated(tmp_path, text).failure
    assert failure.time == 0.5
    assert "Outside.mo:4" in str(failure)
    assert "k = 7" in str(failure)


def test_checks_may_be_switched_off(tmp_path: Path) -> None:
    assert simulated(tmp_path, POLE, solver="dopri5", checks=False).complete


GENERATOR = """model Generator "A linear congruential generator, whose numbers stay below 2^31"
  Integer x(start=7, fixed=true);
equation
  when sample(0.1, 0.1) then
    x = mod(FACTOR*pre(x) + 12345, 2147483648);
  end when;
end Generator;
"""
IN_A_FUNCTION = """model Called
  function next
    input Integer s;
    output Integer x;
  algorithm
    x := mod(FACTOR*s + 12345, 2147483648);
  end next;
  Integer x(start=7, fixed=true);
equation
  when sample(0.1, 0.1) then
    x = next(pre(x));
  end when;
end Called;
"""


@pytest.mark.parametrize("text", [GENERATOR, IN_A_FUNCTION], ids=["equation", "function"])
def test_a_product_of_integers_that_is_not_exact_ends_the_run(tmp_path: Path, text: str) -> None:
    """It was rounded, and what was made of it wrong without a word; products that are exact stay as they are."""
    failure = simulated(tmp_path, text.replace("FACTOR", "1103515245"), stop=1.0).failure
    assert failure is not None and "the Integer x has no value: a sum or product" in str(failure)
    x = 7
    for _ in range(9):
        x = (1103515 * x + 12345) % 2**31
    result = simulated(tmp_path, text.replace("FACTOR", "1103515"), stop=0.95)
    assert result.complete and result["x"][-1] == x


SET_OUTSIDE = """model Outside
  record R
    Real a;
  end R;
  function f
    input Integer k;
    output R y[2] = fill(R(1), 2);
  algorithm
    y[k] := R(2);
  end f;
  Integer k = if time > 0.5 then 3 else 1;
  R y[2] = f(k);
end Outside;
"""


def test_a_record_that_is_set_outside_of_its_array_ends_the_run(tmp_path: Path) -> None:
    failure = simulated(tmp_path, SET_OUTSIDE, stop=1.0).failure
    assert failure is not None and failure.time == pytest.approx(0.5, abs=1e-6)
    assert "Outside.mo:9: " in str(failure) and "a subscript of y is outside of its array" in str(failure)
