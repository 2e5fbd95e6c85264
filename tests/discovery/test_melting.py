"""A storage that takes far more around a level: there the rate that an effort leads to is little but its error."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain

from .recorded import concealed, record

PAVEMENT = """model Pavement "Three layers, heated in the lowest, above the melting point of ice"
  parameter Real C(unit="J/K", min=0) = 6e4;
  parameter Real G(unit="W/K", min=0) = 32;
  parameter Real Gs(unit="W/K", min=0) = 15 "To the air";
  input Real P(unit="W");
  input Real Ta(unit="K") "Air";
  Real T1(unit="K", start=-5, fixed=true);
  Real T2(unit="K", start=-5, fixed=true);
  Real T3(unit="K", start=-5, fixed=true);
equation
  C*der(T1) = P - G*(T1 - T2);
  C*der(T2) = G*(T1 - T2) - G*(T2 - T3);
  {C}*der(T3) = G*(T2 - T3) - Gs*(T3 - Ta);
end Pavement;
"""
CASE = """model = "Pavement.mo"
[parameters]
C = 6e4
G = 32
Gs = 15
[uncertainty]
C = 0.05
G = 0.1
Gs = 0.1
[signals.P]
role = "input"
variable = "P"
unit = "W"
[signals.Ta]
role = "input"
variable = "Ta"
unit = "K"
[signals.T1]
role = "output"
variable = "T1"
unit = "K"
noise_std = 0.12
[signals.T3]
role = "output"
variable = "T3"
unit = "K"
noise_std = 0.12
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


def test_what_melts_is_found_with_its_temperature_and_its_heat(tmp_path: Path) -> None:
    """Five times what is believed to be stored, over 0.8 K a little below the melting point: some 0.4 MJ."""
    believed, real = (PAVEMENT.replace("{C}", c) for c in ("C", "C*(1 + 5*exp(-((T3 + 0.4)/0.8)^2))"))
    case, machine = concealed(tmp_path, "Pavement", real, believed, CASE)
    random, time = np.random.default_rng(4), 10.0 * np.arange(1500)
    for n in (1, 2, 3):
        inputs = {"P": 400 * np.repeat(random.uniform(0, 1, 6) > 0.4, 250), "Ta": -6 - 2 * np.cos(time / 3e3 + n)}
        errors = {c: 0.12 * random.normal(size=1500) for c in ("T1", "T3")}
        record(case / f"r{n}.csv", machine, time, inputs, {"T1": "T1", "T3": "T3"}, errors)
    result = explain(load(case))
    (finding,) = result.findings
    law, point = finding.ranked.attachment.law, result.final.point
    rate, level = sorted(law.references(), key=lambda v: "der(" not in v.name)
    assert (rate.name, level.name) == ("der(T3)", "T3")
    assert point["law_T3.m_1"] * level.size == pytest.approx(-0.4, abs=0.1)
    heat = -point["law_T3.c_1"] / rate.size * point["law_T3.d_1"] * level.size
    assert heat == pytest.approx(6e4 * 5 * 0.8, rel=0.05)
