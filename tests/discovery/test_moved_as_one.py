"""Two inputs that a recipe always sets in one ratio: a law of one may as well be a law of the other."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain
from lacuna.discovery.explanation.confidence import tie

TANK = """model Tank "Aerated while it is stirred"
  parameter Real k(unit="1/s", min=0) = 0.05;
  parameter Real G(unit="1/m3", min=0) = 40 "Air that is dissolved at once";
  input Real N(unit="1/s") "Of the stirrer";
  input Real Q(unit="m3/s") "Air";
  Real C(start=0, fixed=true);
equation
  der(C) = k*(1 - C) - 0.05*C + G*Q*0.1;
end Tank;
"""
CASE = """model = "Tank.mo"
[uncertainty]
k = 0.1
G = 0
[signals.N]
role = "input"
variable = "N"
unit = "1/s"
interpolation = "hold"
[signals.Q]
role = "input"
variable = "Q"
unit = "m3/s"
interpolation = "hold"
[signals.C]
role = "output"
variable = "C"
unit = "1"
noise_std = 0.003
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


@pytest.mark.parametrize(("apart", "verdict"), [(False, "undetermined"), (True, "missing_physics")])
def test_a_law_of_one_of_two_inputs_is_tied_with_the_other(apart: bool, verdict: str, tmp_path: Path) -> None:
    random = np.random.default_rng(3)
    (tmp_path / "Tank.mo").write_text(TANK)
    (tmp_path / "case.toml").write_text(CASE)
    for name in ("r1", "r2", "r3"):
        speed = np.repeat(random.uniform(2, 10, 12), 40)
        air = 1e-3 * (np.repeat(random.uniform(2, 10, 12), 40) if apart else speed)
        c, rows = 0.0, []
        for k, (n, q) in enumerate(zip(speed, air, strict=True)):
            rows.append(f"{k},{n:.8g},{q:.8g},{c + random.normal(0, 0.003):.7g}")
            rest = 0.05 + 4 * q - 0.0005 * n**2  # the stirrer draws some of it off
            c = rest / 0.1 + (c - rest / 0.1) * np.exp(-0.1)
        (tmp_path / f"{name}.csv").write_text("\n".join(["time,N,Q,C", *rows, ""]))
    found = explain(load(tmp_path))
    assert found.verdict == verdict, found.reason
    (finding,) = found.findings
    assert [t["of"] for t in tie(finding) if "of" in t] in (([],) if apart else (["N"], ["Q"]))
    assert ("go apart" in found.experiment) is not apart
