"""Equations without a solution in their order, where a parameter is zero: it is named, and both ways out are ways."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from lacuna import runtime
from tests.events.models import compiled

SERIES = """model Series "A capacitance behind a resistance at an ideal source"
  parameter Real Rs = 0{};
  parameter Real C = 1e-6;
  Real D, Di(start=0), i;
equation
  D = sin(time);
  i*Rs = D - Di;
  i = C*der(Di);
end Series;
"""
WORDS = "that may come of what is zero: Rs; annotation(Evaluate = true) at its declaration"


def test_the_parameter_that_is_zero_is_named_alone(tmp_path: Path) -> None:
    failure = runtime.simulate(compiled(tmp_path, SERIES.format("")), stop=1).failure
    assert failure is not None
    assert "linear equations have no solution, or no unique one" in failure.message
    assert WORDS in failure.message


@pytest.mark.parametrize(("annotation", "resistance"), [(" annotation(Evaluate=true)", None), ("", 1e-3)])
def test_both_ways_out_lead_out(tmp_path: Path, annotation: str, resistance: float | None) -> None:
    given = {} if resistance is None else {"Rs": resistance}
    result = runtime.simulate(compiled(tmp_path, SERIES.format(annotation)), parameters=given, rtol=1e-9, stop=1)
    assert result.complete
    assert result["i"][-1] == pytest.approx(1e-6 * math.cos(1), rel=1e-5)


def test_where_no_parameter_is_zero_none_is_named(tmp_path: Path) -> None:
    text = (
        "model Open\n  parameter Real k = 2, p = 3; Real x, y;\nequation\n  k*x - k*y = p;\n  x - y = 1;\nend Open;\n"
    )
    failure = runtime.simulate(compiled(tmp_path, text), stop=1).failure
    assert failure is not None
    assert "no unique one" in failure.message
    assert "what is zero" not in failure.message
