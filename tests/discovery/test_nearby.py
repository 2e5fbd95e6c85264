"""What an effect of the catalogue leaves is looked for where it is, not among errors of sensors that could be it."""

from __future__ import annotations

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain
from lacuna.discovery.explanation.explanation import Explanation

from .recorded import concealed, record

FAN = """model Fan "A shaft that is braked, and its brake, which grows warm"
  parameter Real J(unit="kg.m2", min=0) = 0.01;
  parameter Real d(unit="N.m.s/rad", min=0) = 0.02;
  parameter Real C(unit="J/K", min=0) = 20;
  parameter Real G(unit="W/K", min=0) = 0.1;
  constant Real air(unit="K") = 293.15;
  input Real u(unit="N.m");
  Lacuna.Components.Mechanics.TorqueSource motor(u=u);
  Lacuna.Components.Mechanics.Inertia fan(J=J, phi(start=0, fixed=true), w(start=0, fixed=true));
  Lacuna.Components.Mechanics.Damper brake(d=d);
  Lacuna.Components.Mechanics.Fixed fixed;
  Real T(unit="K", start=air, fixed=true);
  {effect}
equation
  connect(motor.flange, fan.flange_a);
  connect(fan.flange_b, brake.flange_a);
  connect(brake.flange_b, fixed.flange);
  C*der(T) = d*fan.w^2 - G*(T - air){heat};
  {joined}
end Fan;
"""
CASE = """model = "Fan.mo"
[parameters]
J = 0.01
d = 0.02
C = 20
G = 0.1
[uncertainty]
J = 0.03
d = 0.1
C = 0.03
G = 0.05
[signals.u]
role = "input"
variable = "u"
unit = "N.m"
[signals.w]
role = "output"
variable = "fan.w"
unit = "rad/s"
noise_std = 0.05
[signals.T]
role = "output"
variable = "T"
unit = "K"
noise_std = 0.2
[recordings]
fit = ["r0.csv", "r1.csv"]
validate = ["r2.csv"]
"""
DRAG, RADIATION = 5e-4, 2e-9


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Explanation:
    """Drag of the fan, which the catalogue has, and radiation, where it knows nothing but the sensor of T."""
    truth = FAN.format(
        effect=f"Lacuna.Effects.QuadraticDrag drag(c2={DRAG});", joined="connect(drag.flange, fan.flange_a);",
        heat=f" - {RADIATION}*(T^4 - air^4)",
    )  # fmt: skip
    believed = FAN.format(effect="", joined="", heat="")
    folder, machine = concealed(tmp_path_factory.mktemp("fan"), "Fan", truth, believed, CASE)
    time, random = np.linspace(0.0, 400.0, 1601), np.random.default_rng(4)
    for k in range(3):
        u = 1.0 + 0.6 * np.sin(2 * np.pi * time / (90 + 35 * k)) + 0.3 * np.sign(np.sin(2 * np.pi * time / 23 + k))
        errors = {"w": 0.05 * random.normal(size=len(time)), "T": 0.2 * random.normal(size=len(time))}
        record(folder / f"r{k}.csv", machine, time, {"u": u}, {"w": "fan.w", "T": "T"}, errors)
    return explain(load(folder))


@pytest.mark.xdist_group("a fan that radiates")
def test_both_are_found_where_they_are(result: Explanation) -> None:
    assert result.verdict == "missing_physics"
    drag, heat = result.findings
    assert drag.ranked.attachment.effect.identifier == "drag.quadratic"
    assert result.final.point[drag.ranked.attachment.full_name("c2")] == pytest.approx(DRAG, rel=0.02)
    law = heat.ranked.attachment.law  # of the conductance, or of the heat itself
    assert heat.ranked.attachment.location == "T" and {v.name for v in law.references()} == {"T"}


@pytest.mark.xdist_group("a fan that radiates")
def test_errors_of_other_sensors_are_not_tried_beside_the_first(result: Explanation) -> None:
    screened = [e.hypothesis for e in result.trace.entries if "round 2" in e.looking and e.step == "screen"]
    assert screened and all("sensor:T" in hypothesis for hypothesis in screened)
