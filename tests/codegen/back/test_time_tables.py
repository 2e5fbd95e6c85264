"""Tables over time at the ends of their abscissa."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from tests.codegen.generated import write_model

NO_EXTRAPOLATION = 4
TABLE = """model M
  class Table
    extends ExternalObject;
    function constructor
      input Real table[:, :]; input Real start; input Integer extrapolation; input Real shift; output Table t;
    external "C" t = ModelicaStandardTables_CombiTimeTable_init3("NoName", "NoName", table, size(table, 1),
      size(table, 2), start, {2}, 1, 1, extrapolation, shift, 3, false, ",", 0);
    end constructor;
    function destructor
      input Table t;
    external "C" ModelicaStandardTables_CombiTimeTable_close(t);
    end destructor;
  end Table;
  function value
    input Table table; input Real t; input Real next; input Real before; output Real y;
  external "C" y = ModelicaStandardTables_CombiTimeTable_getValue(table, 1, t, next, before);
  end value;
  parameter Table table = Table([0, 0; 0.3, 1; 0.6, 3], START, KIND, SHIFT);
  Real y = value(table, time, 1e60, -1e60);
  Real x(start = 0, fixed = true);
equation
  der(x) = y;
end M;"""


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_a_table_that_must_not_extrapolate_ends_the_run_outside_of_it(tmp_path: Path, solver: str) -> None:
    def run(stop: float, start: float = 0.0, shift: float = 0.0, kind: int = NO_EXTRAPOLATION) -> runtime.Result:
        text = TABLE.replace("START", str(start)).replace("SHIFT", str(shift)).replace("KIND", str(kind))
        compiled = compile_model(write_model(tmp_path, text), search_path=[])
        return runtime.simulate(runtime.Model(compiled.path), solver=solver, stop=stop)

    inside, beyond = run(0.6), run(1.0)
    assert inside.complete and inside["x"][-1] == pytest.approx(0.75, abs=1e-4)
    assert not beyond.complete and beyond.time[-1] == pytest.approx(0.6, abs=1e-3)
    assert run(1.0, start=0.5, shift=0.5).complete  # before its start a table is zero
    assert not run(1.0, shift=0.5).complete
    assert run(1.0, kind=1)["y"][-1] == 3
