"""Constants that a function names, its own and those of a package, in each way that a function is translated."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.codegen.generated import Generated, write_model

MODEL = """model Falling
  package Earth constant Real g(unit="m/s2") = 9.81; end Earth;
  function weight "inlined"
    input Real m(unit="kg"); output Real f(unit="N");
  protected
    constant Real a(unit="m/s2") = 2*Earth.g;
  algorithm
    f := if a > 10 then m*a else 0;
  end weight;
  function repeated "kept: a loop of unknown length"
    input Real m(unit="kg"); input Real n; output Real f(unit="N");
  protected
    Real k;
  algorithm
    k := 0;
    f := 0;
    while k < n loop
      f := f + weight(m) + m*Earth.g;
      k := k + 1;
    end while;
  end repeated;
  Real m(unit="kg", start=3, fixed=true);
  parameter Real T(unit="s") = 1;
  Real inlined(unit="N"), kept(unit="N");
equation
  der(m) = m/T;
  inlined = weight(m);
  kept = repeated(m, 2);
end Falling;
"""


def test_values_of_constants_in_functions(tmp_path: Path) -> None:
    model = Generated(write_model(tmp_path, MODEL), tmp_path)
    _, v = model.rhs(0.0, np.array([3.0]))
    assert sorted(v) == pytest.approx([3 * 2 * 9.81, 2 * (3 * 2 * 9.81 + 3 * 9.81)])
