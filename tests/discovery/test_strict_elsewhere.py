"""A believed model that `lacuna check` refuses for its units, or for a part that is not balanced, is explained all the
same; what is wrong with it is said, by file and line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import lacuna
from lacuna.codegen.errors import Diagnostic
from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain

from .recorded import concealed, record
from .test_sensors import CART, CASE

SLIP = CART.replace('d(unit="N.s/m"', 'd(unit="N.s2/m"')
LACKS = """model Rail
  Real x(start=0, fixed=true), v;
equation
  der(x) = v;
end Rail;
""" + CART.replace("equation", "  Rail rail;\nequation\n  rail.v = v;")  # fmt: skip
UNEVEN = """connector Flange
  Real x;
  Real v;
  flow Real f;
end Flange;
model Damper
  Flange a;
  parameter Real d(unit="N.s/m") = 0.25;
equation
  a.f = d*a.v;
end Damper;
model Post
  Flange p;
  input Real x, v;
  output Real f = p.f;
equation
  p.x = x;
  p.v = v;
end Post;
""" + CART.replace(
    "equation", "  Damper damper;\n  Post post(x=x, v=v);\nequation\n  connect(post.p, damper.a);"
).replace("F - d*v", "F - (d - damper.d)*v + post.f")


@pytest.mark.parametrize(
    ("believed", "code", "said"),
    [
        (SLIP, "U002", "line 10: units differ"),
        (LACKS, "R078", "line 1: Rail is not balanced"),
        (UNEVEN, "R077", "line 1: the connector Flange has 1 flows and 2 potentials"),
    ],
)
def test_it_is_said_and_hinders_nothing(tmp_path: Path, believed: str, code: str, said: str) -> None:
    folder, machine = concealed(tmp_path, "Cart", CART, believed, CASE.replace("hold", "linear"))
    random, time = np.random.default_rng(4), np.arange(600) * 0.05
    for name in ("r1", "r2", "r3"):
        force = np.repeat(random.uniform(-6, 6, 60), 10)
        noise = {"x": random.normal(0, 0.002, len(time)), "v": random.normal(0, 0.005, len(time))}
        record(folder / f"{name}.csv", machine, time, {"F": force}, {"x": "x", "v": "v"}, noise)
    with pytest.raises(Diagnostic) as refused:
        lacuna.check(folder / "Cart.mo", class_name="Cart")
    assert refused.value.code == code
    found = explain(load(folder))
    assert found.verdict == "consistent"
    (problem,) = found.problems
    assert str(problem).startswith(f"Cart.mo, {said}")
