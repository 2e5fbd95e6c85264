"""A resolver whose windings differ: an error of two periods a turn, zeroed with it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain
from lacuna.discovery.explanation.diagnosis import sentence

from .recorded import record, truth

AXIS = """model Axis "An axis driven by a torque; the error of its resolver, its own variable"
  parameter Real J(unit="kg.m2", min=0) = 2;
  parameter Real d(unit="N.m.s/rad", min=0) = 3;
  input Real T(unit="N.m");
  Real th(unit="rad", start=0, fixed=true);
  Real w(unit="rad/s", start=0, fixed=true);
  Real read(unit="rad");
equation
  der(th) = w;
  J*der(w) = T - d*w;
  read = th{error};
end Axis;
"""


def test_an_error_of_two_periods_a_turn_is_found_though_another_signal_is_mostly_noise(tmp_path: Path) -> None:
    random, time = np.random.default_rng(8), 0.02 * np.arange(1000)
    (tmp_path / "Axis.mo").write_text(AXIS.format(error=""))
    machine = truth(tmp_path / "m", "Axis", AXIS.format(error=" + 5e-3*(sin(2*th + 0.6) - sin(0.6))"))
    for name in ("r1", "r2", "r3"):
        torque = 6 * np.interp(time, np.linspace(0, 20, 9), random.uniform(-1, 1, 9))
        errors = {"az": random.normal(0, 5e-4, 1000), "w": random.normal(0, 0.5, 1000)}
        record(tmp_path / f"{name}.csv", machine, time, {"T": torque}, {"az": "read", "w": "w"}, errors)
    (tmp_path / "case.toml").write_text(
        'model = "Axis.mo"\n[uncertainty]\nJ = 0.02\nd = 0.05\n'
        '[signals.T]\nrole = "input"\nvariable = "T"\nunit = "N.m"\n'
        '[signals.az]\nrole = "output"\nvariable = "read"\nunit = "rad"\nnoise_std = 5e-4\n'
        '[signals.w]\nrole = "output"\nvariable = "w"\nunit = "rad/s"\nnoise_std = 0.5\n'
        '[recordings]\nfit = ["r1.csv", "r2.csv"]\nvalidate = ["r3.csv"]\n'
    )
    found = explain(load(tmp_path))
    assert found.verdict == "missing_physics"
    (finding,) = found.findings
    assert finding.ranked.identity == ("sensor.once_per_rev", "sensor:az")
    values = finding.ranked.effect_values()
    assert values["periods"] == 2
    assert values["amplitude"] == pytest.approx(5e-3, rel=0.02)
    assert values["zero"] == pytest.approx(-5e-3 * np.sin(0.6), rel=0.03)
    assert "the error of az on unseen recordings falls" in sentence(found)
