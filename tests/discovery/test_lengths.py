"""What a coefficient loses along a way: the stiffness of a rope as its cage goes down."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.discovery.efforts.find import find
from lacuna.discovery.law.law import law_at

from .test_flat_plants import case_of, told

HOIST = """model Hoist "A cage on a rope from a drum whose speed is commanded"
  parameter Real m(unit="kg", min=0) = 2e4;
  parameter Real c(unit="N/m", min=0) = 4e5;
  parameter Real d(unit="N.s/m", min=0) = 8e3;
  input Real u(unit="m/s");
  Real y(unit="m", start=20, fixed=true) "Rope that is let out";
  Real x(unit="m", start=20, fixed=true) "Depth, from where the cage hangs at rest";
  Real v(unit="m/s", start=0, fixed=true);
  Real f(unit="N");
equation
  der(y) = u;
  der(x) = v;
  f = c%s*(x - y) + d*(v - u);
  m*der(v) = -f;
end Hoist;
"""
LENGTH = 15.0  # m of rope above the shaft's zero


def test_a_stiffness_that_a_length_divides_is_told_as_one(tmp_path: Path) -> None:
    true = HOIST % f"*{50 + LENGTH}/(y + {LENGTH})"
    belief = "m = 0.02\nc = 0.1\nd = 0.2\n"
    case = case_of(tmp_path, "Hoist", true, HOIST % "", belief, ("u", "m/s"), (-2.0, 6.0),
                   [("x", "m", 0.01), ("v", "m/s", 0.005), ("f", "N", 50.0)], 0.25)  # fmt: skip
    result = told(case)
    best = find(case, result.amendment, result.base, case.library(), lambda text: None).laws[0]
    law = best.attachment.law
    assert law.site.place.label == "c"
    q = next(value for name, value in best.fit.point.items() if ".q_" in name)
    size = next(v.size for v in law.references())
    assert size / q == pytest.approx(LENGTH, rel=0.1), law_at(best.attachment, best.fit.point)
    assert all(level < 1.1 for level in best.fit.level.values())
