"""Fixed start values that others determine: taken where they agree, and named where they do not."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from lacuna.codegen.errors import Diagnostic
from tests.events.models import compiled

STAR = """model Star "Three inductances in a star: two currents tell the third, and all are fixed"
  parameter Real begin = 1, third = -0.5;
  Real i[3](start={begin, -0.5, third}, each fixed=true), u;
equation
  der(i[1]) = u - i[1];
  der(i[2]) = u - 2*i[2];
  der(i[3]) = u - 3*i[3];
  i[1] + i[2] + i[3] = 0;
end Star;
"""


@pytest.fixture
def star(tmp_path: Path) -> runtime.Model:
    return compiled(tmp_path, STAR)


def test_a_start_value_that_agrees_is_taken_and_told(tmp_path: Path) -> None:
    model = compiled(tmp_path, STAR)
    (warning,) = compile_model(str(tmp_path / "Star.mo")).report.warnings
    assert (warning.code, warning.severity) == ("S022", "warning")
    assert "determine i[3] already" in warning.message
    result = runtime.simulate(model, stop=1)
    assert result.complete
    assert [result[f"i[{k}]"][0] for k in (1, 2, 3)] == pytest.approx([1, -0.5, -0.5], abs=1e-12)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rk4"])
def test_one_that_does_not_ends_the_run_by_its_name(star: runtime.Model, solver: str) -> None:
    failure = runtime.simulate(star, parameters={"third": -0.4}, solver=solver, step=0.01, stop=1).failure
    assert failure is not None
    assert failure.variable == "i[3]"
    assert "i[3] has the fixed start value -0.4, but the other initial conditions give -0.5" in failure.message


def test_what_rounding_leaves_of_zero_agrees_with_it(star: runtime.Model) -> None:
    """0.1 + 0.2 - 0.3 is no zero of floating-point numbers."""
    parameters = {"begin": 0.5 + 5.5e-17, "third": 0.0}
    assert runtime.simulate(star, parameters=parameters, stop=1).complete


def test_a_value_far_below_the_others_is_not_taken_for_zero(star: runtime.Model) -> None:
    assert not runtime.simulate(star, parameters={"begin": 0.5 + 1e-5, "third": 0.0}, stop=1).complete


def test_it_follows_states_that_the_caller_gives(star: runtime.Model) -> None:
    result = runtime.simulate(star, initial={"i[1]": 2.0}, stop=1)
    assert result.complete
    assert result["i[3]"][0] == pytest.approx(-1.5)


def test_against_an_initial_equation_it_is_refused(tmp_path: Path) -> None:
    text = STAR.replace("equation\n", "initial equation\n  der(i[1]) = 0;\nequation\n", 1)
    with pytest.raises(Diagnostic, match="has a fixed start value") as refused:
        compiled(tmp_path, text)
    assert (refused.value.code, refused.value.severity) == ("S022", "error")


ALIASED = """model Aliased "x is fixed and says no start value, y says one and is not fixed"
  Real x(fixed=true), y(start=3);
equation
  y = x;
  der({}) = 1 - {};
end Aliased;
"""


@pytest.mark.parametrize("written", ["x", "y"])
def test_one_that_is_fixed_stays_so_where_its_alias_has_the_start_value(tmp_path: Path, written: str) -> None:
    """It was said not to be fixed. What is fixed without a start value begins at zero (4.9)."""
    model = compiled(tmp_path, ALIASED.format(written, written))
    assert not compile_model(str(tmp_path / "Aliased.mo")).report.warnings
    assert runtime.simulate(model, stop=1)["y"][0] == 0
