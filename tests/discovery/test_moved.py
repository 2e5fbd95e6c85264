"""A sensor that reads too much, told as one and not as two parameters that no machine has; a parameter that is off."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue import catalogue
from lacuna.discovery.explanation.moved import sensor_instead
from lacuna.discovery.naming.judge import noise_floor
from lacuna.discovery.naming.search import Search
from lacuna.discovery.steps import fitted

from .recorded import record, truth

SPINDLE = """model Spindle "A motor and what it turns"
  parameter Real R(unit="Ohm", min=0) = 1.2;
  parameter Real k(unit="V.s/rad", min=0) = 0.1;
  parameter Real J(unit="kg.m2", min=0) = %s;
  input Real u(unit="V");
  Real w(unit="rad/s", start=0, fixed=true);
  Real i(unit="A");
equation
  u = R*i + k*w;
  J*der(w) = k*i;
end Spindle;
"""
CASE = """model = "Spindle.mo"
[uncertainty]
R = 0.02
k = 0.005
J = 0.03
[signals.u]
role = "input"
unit = "V"
[signals.i]
role = "output"
unit = "A"
noise_std = 0.05
[signals.w]
role = "output"
unit = "rad/s"
noise_std = 0.5
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


@pytest.mark.parametrize(("gain", "inertia", "named"), [(1.15, 1e-3, [("sensor.gain", "sensor:i")]), (1.0, 1.3e-3, [])])
def test_one_sensor_goes_before_two_parameters_and_one_parameter_before_a_sensor(
    tmp_path: Path, gain: float, inertia: float, named: list
) -> None:
    machine = truth(tmp_path, "Spindle", SPINDLE % inertia)
    (tmp_path / "Spindle.mo").write_text(SPINDLE % 1e-3, encoding="utf-8")
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    random, time = np.random.default_rng(2), np.arange(150) * 0.02
    for n in (1, 2, 3):
        u = np.repeat(random.uniform(-10, 10, 15), 10)
        file, errors = tmp_path / f"r{n}.csv", {"i": 0.05 * random.normal(size=150), "w": 0.5 * random.normal(size=150)}
        record(file, machine, time, {"u": u}, {"i": "i", "w": "w"}, errors)
        rows = np.genfromtxt(file, delimiter=",", names=True)
        rows["i"] += (gain - 1) * (rows["i"] - errors["i"])
        np.savetxt(file, rows, "%.8g", ",", header="time,u,i,w", comments="")
    case = load(tmp_path)
    told = fitted(case, lambda text: None)
    floor = noise_floor(case, case.fit, told.base.noise)
    search = Search(case, [], told.lead, floor, told.amendment, told.base, told.before, [], [])
    moved = sensor_instead(search, catalogue.read(case.library()), lambda text: None)
    assert [f.ranked.identity for f in search.findings] == named
    assert set(moved) == ({"R", "J"} if named else set())
