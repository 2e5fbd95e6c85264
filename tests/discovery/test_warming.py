"""What warms by its own loss, where what goes through it is no state: the effort changes that at once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.efforts.find import located
from lacuna.discovery.efforts.guide import guide
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.steps import fitted

MODEL = """model Charger
  parameter Real R(unit="Ohm") = 40;
  parameter Real C(unit="F") = 1e-3;
  parameter Real Rl(unit="Ohm") = 200;
  input Real u(unit="V");
  Real v(unit="V", start=0, fixed=true);
  Real i(unit="A");
equation
  u - v = R*i;
  C*der(v) = i - v/Rl;
end Charger;
"""
CASE = """title = "A capacitor charged through a resistor"
model = "Charger.mo"
source = "synthetic"
[parameters]
R = 40.0
[signals.u]
role = "input"
variable = "u"
unit = "V"
interpolation = "hold"
[signals.v]
role = "output"
variable = "v"
unit = "V"
[signals.i]
role = "output"
variable = "i"
unit = "A"
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""
RISE, WARM, STEP = 300.0, 1.5, 1e-3  # Ohm per A2, s, s


@pytest.fixture(scope="module")
def warming(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """R + RISE*T, WARM*T' = i^2 - T, by Heun's method."""
    folder, random = tmp_path_factory.mktemp("warming"), np.random.default_rng(11)
    (folder / "Charger.mo").write_text(MODEL)
    (folder / "case.toml").write_text(CASE)
    for name in ("r1", "r2", "r3"):
        rows, x = [], np.zeros(2)
        for k, u in enumerate(np.repeat(random.uniform(0, 60, 12), 1000)):
            if k % 10 == 0:
                i = _current(x, u)
                rows.append(
                    f"{k * STEP:.3f},{u:.6g},{x[0] + random.normal(0, 0.05):.6g},{i + random.normal(0, 2e-3):.6g}"
                )
            first = _rates(x, u)
            x = x + 0.5 * STEP * (first + _rates(x + STEP * first, u))
        (folder / f"{name}.csv").write_text("\n".join(["time,u,v,i", *rows, ""]))
    return folder


def _current(x: np.ndarray, u: float) -> float:
    return (u - x[0]) / (40.0 + RISE * x[1])


def _rates(x: np.ndarray, u: float) -> np.ndarray:
    i = _current(x, u)
    return np.array([(i - x[0] / 200.0) / 1e-3, (i**2 - x[1]) / WARM])


def test_a_law_of_the_loss_comes_first(warming: Path) -> None:
    case = load(warming)
    told = fitted(case, lambda text: None)
    locator = located(told.case, told.amendment, told.base, case.library())
    site = next(s for s in locator.ranked() if s.place is not None)
    first = next(proposals(locator, site, guide(locator, site), 3))[0]
    (group,) = first.law.groups
    (read,) = [v for v in first.law.site.variables if v.scaled in group.texts[0]]
    warm = f"warmth({read.scaled}^2, {{t}})"  # what R gains, or what is lost across it
    assert (read.name, first.law.site.unit, group.texts[0]) in (("i", "Ohm", warm), ("i", "V", f"{read.scaled}*{warm}"))
    assert first.start["t_1"] == pytest.approx(WARM, rel=0.3)
