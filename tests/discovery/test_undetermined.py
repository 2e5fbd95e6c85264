"""What no recording of these can tell: a constant effort from an offset of the input that acts at its place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain
from lacuna.discovery.explanation.confidence import tie
from lacuna.discovery.explanation.input_error import offset_instead
from lacuna.discovery.explanation.report import write

from .recorded import TANK, concealed, record, truth


def drained(folder: Path, lost: str) -> Path:
    """A tank whose inflow is recorded, and which loses more than is believed."""
    (folder / "Tank.mo").write_text(TANK.format(outflow="k*h"))
    believed = truth(folder / "machine", "Tank", TANK.format(outflow=f"(k*h + {lost})"))
    time, random = np.arange(0.0, 1200.0, 3.0), np.random.default_rng(4)
    for name in ("r1", "r2", "r3"):
        inflow = 8e-5 + 2.5e-5 * np.repeat(random.uniform(-1, 1, 8), 50)
        errors = {"h": random.normal(0, 5e-4, len(time))}
        record(folder / f"{name}.csv", believed, time, {"q": inflow}, {"h": "h"}, errors)
    (folder / "case.toml").write_text(
        'model = "Tank.mo"\n[uncertainty]\nA = 0.01\nk = 0.05\n'
        '[signals.q]\nrole = "input"\nvariable = "q"\nunit = "m3/s"\n'
        '[signals.h]\nrole = "output"\nvariable = "h"\nunit = "m"\nnoise_std = 5e-4\n'
        '[recordings]\nfit = ["r1.csv", "r2.csv"]\nvalidate = ["r3.csv"]\n'
    )
    return folder


def test_a_constant_loss_is_not_told_from_an_offset_of_the_inflow(tmp_path: Path) -> None:
    found = explain(load(drained(tmp_path, "2e-5")))
    assert found.verdict == "undetermined"
    signal, offset = offset_instead(found)
    assert signal.column == "q" and offset == pytest.approx(2e-5, rel=0.05)
    assert {t["effect"] for t in tie(found.findings[0])} >= {"sensor.offset"}
    assert "offset" in found.reason and "q" in found.experiment
    page = write(found, tmp_path, None).read_text(encoding="utf-8")
    assert "No explanation is claimed" in page and "and is not claimed</h2>" in page
    assert "What was left out" not in page and " to 1 against" not in page


def test_a_loss_that_is_none_at_rest_is_told(tmp_path: Path) -> None:
    found = explain(load(drained(tmp_path, "6e-5*sqrt(h)")))
    assert found.verdict == "missing_physics" and offset_instead(found) is None


STORE = """model Store "A flywheel near its working speed"
  parameter Real J(unit="kg.m2", min=0) = 2.2;
  parameter Real k(unit="N.m/A", min=0) = 0.4;
  input Real i(unit="A");
  Real w(unit="rad/s", start=1500, fixed=true);
equation
  J*der(w) = k*i{loss};
end Store;
"""
STORED = """model = "Store.mo"
[uncertainty]
J = 0.03
k = 0
[signals.i]
role = "input"
unit = "A"
[signals.w]
role = "output"
unit = "rad/s"
noise_std = 0.4
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


def test_a_constant_torque_is_not_told_from_a_sensor_whose_zero_drifts(tmp_path: Path) -> None:
    case, machine = concealed(tmp_path, "Store", STORE.format(loss=" - 0.8"), STORE.format(loss=""), STORED)
    random, time = np.random.default_rng(3), np.arange(400) * 0.1
    for n in (1, 2, 3):
        current, error = np.repeat(random.uniform(-5, 5, 20), 20), 0.4 * random.normal(size=400)
        record(case / f"r{n}.csv", machine, time, {"i": current}, {"w": "w"}, {"w": error})
    result = explain(load(case))
    assert result.verdict == "undetermined"
    assert "sensor.drift" in result.reason and "at w" in result.reason
