"""What is no number decides nothing: a run ends where it would."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.test_hostile_models import simulated


@pytest.mark.parametrize(
    ("y", "status"),
    [
        ("if sqrt(x - 1) > 0 then 1 else 2", 1),
        ("sign(asin(x - 2))", 1),
        ("atan(1/x)", 1),
        ("exp(-1/x^2)", 1),
        ("if x > 1 then (if sqrt(x - 1) > 0 then 1 else 2) else 3", 0),
        ("if x > 1 and sqrt(x - 1) > 0 then 1 else 2", 0),
        ("if x > 0 then atan(1/x) else 0", 0),
    ],
)
def test_what_is_no_number_decides_nothing_from_the_start_on(tmp_path: Path, y: str, status: int) -> None:
    text = f"model M Real x(start=0, fixed=true), y; equation der(x) = 0; y = {y}; end M;"
    assert simulated(tmp_path, text)[0] == status


FUNCTION = "function f input Real x; output Real y; algorithm if {0} then y := 1; else y := 2; end if; end f; "


@pytest.mark.parametrize(
    ("text", "status"),
    [
        ("Real x = time - 0.5, y = if noEvent(sqrt(x) > 0.1) then 1 else 2;", 1),
        ("Real x = time - 0.5, y = if noEvent(x > 0 and sqrt(x) > 0.1) then 1 else 2;", 0),
        ("Real x = time - 0.5, y = if noEvent(x > 0) then (if noEvent(log(x) > -1) then 1 else 2) else 3;", 0),
        (FUNCTION.format("sqrt(x) > 0.1") + "Real y = f(time - 0.5);", 1),
        (FUNCTION.format("x > 0 and sqrt(x) > 0.1") + "Real y = f(time - 0.5);", 0),
        (FUNCTION.format("not x > 0.1") + "Real y = f(sqrt(time - 0.5));", 1),
        ("parameter Real p = -1; parameter Boolean b = sqrt(p) > 0.1; Real y = if b then 1 else time;", 1),
        ("Real x = time - 0.5; discrete Real y(start=0); equation when sample(0.1, 0.1) then "
         "y = if sqrt(x) > 0.1 then 1 else 2; end when;", 1),
        ("Real x = time; discrete Real y(start=0); equation when sample(0.1, 0.1) then "
         "y = if sqrt(x) > 0.1 then 1 else 2; end when;", 0),
        ("Real x = 0.5 - time, y = noEvent(if sqrt(x) > 0 then 1 else 2);", 1),
        ("Real x(start=0.5, fixed=true), z(start=0, fixed=true); equation der(x) = -1; "
         "der(z) = noEvent(if sqrt(x) > 0 then 1 else 2);", 1),
        (FUNCTION.format("x > 0") + "Real x(start=0.5, fixed=true), z(start=0, fixed=true); equation der(x) = -1; "
         "der(z) = f(sqrt(x));", 1),
        ("Real x(start=1, fixed=true), z(start=0, fixed=true); equation der(x) = -0.5; "
         "der(z) = noEvent(if sqrt(x) > 0.8 then 1 else 2);", 0),
        ("Real x; equation x^3 + (if noEvent(sqrt(x + 0.1) > 0.2) then 1 else 2) = 1 + (1 + time)^3;", 0),
    ],
)  # fmt: skip
def test_a_relation_that_makes_no_event_compares_numbers(tmp_path: Path, text: str, status: int) -> None:
    """In noEvent, functions, parameters and when clauses; what a condition leaves out is not asked for, and what an
    iteration meets on its way does not count."""
    found, said = simulated(tmp_path, f"model M {text} end M;")
    assert (found, "one side of a relation is not a number" in said) == (status, status == 1), said


def test_a_size_that_is_no_number_is_no_relation_of_the_model(tmp_path: Path) -> None:
    """With both parameters zero the size of x, a/b, is 0/0: the declared one stands in for it."""
    text = "model M parameter Real a = 10, b = 1; Real x; equation b*x + sinh(x) = a*time; end M;"
    status, said = simulated(tmp_path, text, "-p", "a=0", "-p", "b=0")
    assert status == 0, said
