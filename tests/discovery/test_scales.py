"""Places of equations whose efforts are of units far apart: none is small because another one's numbers are large."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.symbolic.expr import var
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read as read_structure
from lacuna.discovery.efforts.latent.substitution import Substitution
from lacuna.discovery.efforts.places.opened import opened

LINE = """model Line "Accumulator, long line, load"
  parameter Real Ca(unit="m3/Pa", min=0) = 2e-11;
  parameter Real I(unit="kg/m4", min=0) = 2e7;
  parameter Real R(unit="Pa.s/m3", min=0) = 2e8;
  parameter Real Cl(unit="m3/Pa", min=0) = 4e-12;
  parameter Real kv(unit="m3/(s.Pa)", min=0) = 1.5e-10;
  input Real q(unit="m3/s");
  Real pa(unit="Pa", start=0, fixed=true);
  Real ql(unit="m3/s", start=0, fixed=true);
  Real pl(unit="Pa", start=0, fixed=true);
equation
  Ca*der(pa) = q - ql;
  I*der(ql) = pa - pl - R*ql;
  Cl*der(pl) = ql - kv*pl;
end Line;
"""
CASE = """model = "Line.mo"
[signals.q]
role = "input"
unit = "m3/s"
[signals.pa]
role = "output"
unit = "Pa"
[recordings]
fit = ["r.csv"]
validate = ["other.csv"]
"""


def test_a_loss_in_a_line_is_a_place_beside_a_leak(tmp_path: Path) -> None:
    """A pascal moves the flow ten orders less than a cubic metre a second moves the pressures, each in its own size."""
    (tmp_path / "Line.mo").write_text(LINE, encoding="utf-8")
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    rows = [f"{0.01 * k:.2f},{3e-4 * (1 + k // 20 % 2)},{k}" for k in range(100)]
    for name in ("r.csv", "other.csv"):
        (tmp_path / name).write_text("\n".join(["time,q,pa", *rows]) + "\n", encoding="utf-8")
    case = load(tmp_path)
    door = opened(case, Amendment(read_structure(case.library(), case.base)), case.library(), [])
    believed = {n: v.start for n, v in door.machine.model.parameters.items()}
    places = door.places([door.linear.along(believed, case.fit[0])])
    assert {(p.location, p.unit) for p in places} == {("pa", "m3/s"), ("ql", "Pa"), ("pl", "m3/s")}


@pytest.mark.parametrize("unit", [1.0, 1e-12, 1e12])
def test_what_cancels_but_for_rounding_does_nothing(unit: float) -> None:
    """Unknowns (a, b) with a + b = e and a + b/3 = e: the effort is in a alone, b is what rounding leaves."""
    one, third = var("one"), var("third")
    courses = {one: np.ones(1), third: np.full(1, 1 / 3)}
    effort = np.full(1, -0.3 * unit)
    right = [{0: effort}, {0: np.nextafter(effort, 0.0)}]
    equations = Substitution([{0: one, 1: one}, {0: one, 1: third}])
    whole, rounded = equations.solve(courses.__getitem__, right, 1)
    assert 0 < np.abs(rounded.values).max() < 1e-15 * unit
    a, b = equations.solve(courses.__getitem__, right, 1, exact=range(1))
    assert a.values == whole.values == pytest.approx(0.3 * unit) and len(b.columns) == 0
