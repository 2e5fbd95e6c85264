"""Where no equation is open to a search, what a sensor would explain is not blamed on it: the verdict says so."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.signal import lfilter

import lacuna

SEALED = """package Works
  model Sealed "Equations of another house"
    input Real P(unit="W") "Power of the heater";
    parameter Real C(unit="J/K", min=1e-9) = 400 "Heat capacity";
    parameter Real G(unit="W/K", min=0) = 2 "Loss to the room";
    Real dT(unit="K", start=0, fixed=true) "Temperature over the room";
  equation
    C*der(dT) = P - G*dT;
  end Sealed;
end Works;
"""
OVEN = """
package Oven "An oven whose equations stand in a class that is not the case's own"
  model Kiln "What is believed"
    extends Works.Sealed;
  end Kiln;
  model Open "The same, with its equation in the open"
    input Real P(unit="W") "Power of the heater";
    parameter Real C(unit="J/K", min=1e-9) = 400 "Heat capacity";
    parameter Real G(unit="W/K", min=0) = 2 "Loss to the room";
    Real dT(unit="K", start=0, fixed=true) "Temperature over the room";
  equation
    C*der(dT) = P - G*dT;
  end Open;
end Oven;
"""
CASE = """
model = "Oven.mo:Oven.{model}"
libraries = ["{works}"]
[signals.P]
role = "input"
variable = "P"
unit = "W"
interpolation = "hold"
[signals.dT]
role = "output"
variable = "dT"
unit = "K"
[uncertainty]
C = 0.01
G = 0.01
[recordings]
fit = ["0.csv", "1.csv"]
validate = ["2.csv"]
"""
STEP, OFFSET, NOISE = 2.0, 1.5, 0.05  # s, K, K


def case(folder: Path, model: str) -> Path:
    """A sensor that reads 1.5 K too much; between samples, where power is constant, the oven is solved exactly."""
    random = np.random.default_rng(4)
    works, folder = folder / "works", folder / "case"
    for made in (works, folder):
        made.mkdir()
    (works / "Works.mo").write_text(SEALED, encoding="utf-8")
    (folder / "Oven.mo").write_text(OVEN, encoding="utf-8")
    (folder / "case.toml").write_text(CASE.format(model=model, works=works), encoding="utf-8")
    kept = np.exp(-2 / 400 * STEP)
    for k in range(3):
        time = np.arange(600) * STEP
        power = np.where(time // (150 + 40 * k) % 2 == 0, 120.0, 20.0 * k)
        risen = lfilter([0, 1 - kept], [1, -kept], power) / 2
        read = risen + OFFSET + random.normal(0, NOISE, len(time))
        rows = np.column_stack([time, power, read])
        np.savetxt(folder / f"{k}.csv", rows, delimiter=",", header="time,P,dT", comments="", fmt="%.6g")
    return folder


def test_a_sensor_is_not_accused_where_no_equation_was_open(tmp_path: Path) -> None:
    result = lacuna.explain(case(tmp_path, "Kiln"), out=tmp_path / "out")
    assert result.verdict == "undetermined"
    assert result.findings == []
    reason = result.diagnosis["reason"]
    assert "SensorOffset" in reason
    assert "no place in the equations of Oven.mo:Oven.Kiln was open" in reason
    assert "the equation stands in Works.Sealed" in reason


def test_the_same_sensor_is_named_where_the_equation_was_tried(tmp_path: Path) -> None:
    result = lacuna.explain(case(tmp_path, "Open"), out=tmp_path / "out")
    assert result.verdict == "missing_physics"
    assert result.diagnosis["findings"][0]["location"] == "sensor:dT"
