"""Whole models in other units: the same events in the same order, relative errors within a factor of two."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.events.in_units import SYSTEMS, compare

ROOT = Path(__file__).parents[2]
MODELS = {
    "T1": (str(ROOT / "tests/models/SquareWaveServo.mo"), 1.0),
    "T2": (str(ROOT / "tests/models/SixStepMotor.mo"), 0.02),
}
BUCK = """model Buck "A converter with a bang-bang controller, a diode and a load that jumps"
  parameter Real L(unit="H") = 1e-4, C(unit="F") = 1e-4, R(unit="Ohm") = 2, V(unit="V") = 24;
  parameter Real want(unit="V") = 12, band(unit="V") = 0.2, Goff(unit="S") = 1e-2;
  Real i(unit="A", start=0, fixed=true), v(unit="V", start=0, fixed=true), u(unit="V"), load(unit="A");
  Boolean on(start=true, fixed=true);
equation
  u = if on then V elseif i > 0 then 0 else -i/Goff;
  L*der(i) = u - v;
  load = if time < 4e-3 then v/R else 2*v/R;
  C*der(v) = i - load;
  when v > want + band then
    on = false;
  elsewhen v < want - band then
    on = true;
  end when;
end Buck;
"""
STRIKER = """model Striker "A mass on a spring strikes a stop, drawn by a magnet"
  parameter Real m(unit="kg") = 0.2, k(unit="N/m") = 400, c(unit="N/m") = 1e6, d(unit="s/m") = 0.5;
  parameter Real K(unit="N.m2/A2") = 1e-5, R(unit="Ohm") = 4, L(unit="H") = 5e-3, V(unit="V") = 12;
  parameter Real gap0(unit="m") = 4e-3, omega(unit="rad/s") = 60, stop(unit="m") = 3.5e-3;
  Real x(unit="m", start=0, fixed=true), w(unit="m/s", start=0, fixed=true), i(unit="A", start=0, fixed=true);
  Real f(unit="N"), push(unit="N"), u(unit="V");
equation
  u = if sin(omega*time) > 0 then V else 0;
  L*der(i) = u - R*i;
  f = K*i^2/(gap0 - x + stop)^2;
  push = if x > stop then c*(x - stop)*(1 + d*w) else 0;
  der(x) = w;
  m*der(w) = f - k*x - push;
end Striker;
"""


def test_the_benchmark_motors(tmp_path: Path) -> None:
    for name, (path, stop) in MODELS.items():
        assert compare(path, stop, str(tmp_path), systems=SYSTEMS[:2], solvers=("ida", "dopri5")).faults == [], name


@pytest.mark.parametrize("text", [BUCK, STRIKER], ids=["buck", "striker"])
def test_small_models(tmp_path: Path, text: str) -> None:
    path = tmp_path / f"{text.split()[1]}.mo"
    path.write_text(text)
    assert compare(str(path), 0.01 if text is BUCK else 0.3, str(tmp_path)).faults == []
