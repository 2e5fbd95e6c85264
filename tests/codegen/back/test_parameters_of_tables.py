"""Values of tables that follow parameters are set as these are, where a table is linear in them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from tests.codegen.generated import write_model

LINEAR, AKIMA, CONSTANT = 1, 2, 3  # Modelica.Blocks.Types.Smoothness
HOLD, EXTEND = 1, 2  # Modelica.Blocks.Types.Extrapolation
TABLE = """model M
  class Table
    extends ExternalObject;
    function constructor
      input Real table[:, :]; input Integer smoothness; input Integer extrapolation; output Table t;
    external "C" t = ModelicaStandardTables_CombiTable1D_init3("NoName", "NoName", table, size(table, 1),
      size(table, 2), {2}, 1, smoothness, extrapolation, false, ",", 0);
    end constructor;
    function destructor
      input Table t;
    external "C" ModelicaStandardTables_CombiTable1D_close(t);
    end destructor;
  end Table;
  function value
    input Table t; input Real u; output Real y;
  external "C" y = ModelicaStandardTables_CombiTable1D_getValue(t, 1, u);
  end value;
  parameter Real a = 1;
  parameter Real b = 2;
  parameter Real w = 1;
  parameter Real points[:, 2] = POINTS;
  parameter Table table = Table(points, KIND, BEYOND);
  Real y = value(table, time);
  Real x(start = 0, fixed = true);
equation
  der(x) = y;
end M;"""


def model(folder: Path, points: str, kind: int = LINEAR, beyond: int = EXTEND) -> runtime.Model:
    text = TABLE.replace("POINTS", points).replace("KIND", str(kind)).replace("BEYOND", str(beyond))
    return runtime.Model(compile_model(write_model(folder, text), search_path=[]).path)


@pytest.mark.parametrize("solver", ["ida", "dopri5"])
@pytest.mark.parametrize("beyond", [HOLD, EXTEND])
def test_straight_lines_and_what_they_give_for_a_parameter(tmp_path: Path, solver: str, beyond: int) -> None:
    """y is 3 at 0, a at 1, a + b at 2 and goes on so, or stays."""
    made = model(tmp_path, "[0, 3; 1, a; 2, a + b]", beyond=beyond)
    times, a, b = [0.5, 1.5, 4.0], 5.0, -2.0
    rates = {
        "a": [0.125, 0.5 + 0.5, 0.5 + 3.0],
        "b": [0.0, 0.125, 0.5 + (2.0 if beyond == HOLD else 4.0)],
    }
    expected = [3 * 0.375 + a * 0.125 + 0.0, 1.5 + a + b * 0.125, 1.5 + 3.5 * a + b * rates["b"][-1]]
    options = {"rtol": 1e-9, "start": 0.0, "stop": 4.0, "output_times": np.array(times), "events": False}
    run = runtime.simulate(made, solver=solver, parameters={"a": a, "b": b}, outputs=["x"], **options)
    assert run["x"] == pytest.approx(expected, rel=1e-6)
    for name, values in (("a", [a - 1, a + 1]), ("b", [b - 1, b + 1])):  # in both of which x is linear
        low, high = (
            runtime.simulate(made, solver=solver, parameters={"a": a, "b": b, name: v}, outputs=["x"], **options)["x"]
            for v in values
        )
        assert (high - low) / 2 == pytest.approx(rates[name], abs=1e-5)


def test_steps(tmp_path: Path) -> None:
    made = model(tmp_path, "[0, 3; 1, a; 2, a + b]", kind=CONSTANT, beyond=HOLD)
    run = runtime.simulate(made, solver="ida", parameters={"a": 5.0}, start=0.0, stop=4.0, outputs=["x"])
    assert run["x"][-1] == pytest.approx(3 + 5 + 2 * 7, rel=1e-6)


@pytest.mark.parametrize(
    ("points", "kind", "free"),
    [
        ("[0, 3; 1, a; 2, a + b]", LINEAR, {"a", "b", "w"}),
        ("[0, 3; w, a; 2*w, a + b]", LINEAR, {"a", "b"}),  # the abscissa has to ascend: it is known at translation
        ("[0, 3; 1, a; 2, a + b]", AKIMA, {"w"}),  # whose slopes are chosen by the values
        ("[0, 3; 1, 4; 2, 5]", LINEAR, {"a", "b", "w"}),
    ],
)
def test_what_a_table_is_made_of_is_structural_elsewhere(
    tmp_path: Path, points: str, kind: int, free: set[str]
) -> None:
    assert set(model(tmp_path, points, kind).parameters) == free
