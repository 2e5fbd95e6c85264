"""Errors of a sensor that are in no textbook of the machine: each is told as that, with its number."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue import catalogue, places
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.explain import explain

from .recorded import concealed, record
from .test_efforts import BELIEVED, cascade

CART = """model Cart "On a rail, drawn by a force"
  parameter Real m(unit="kg", min=0) = 4;
  parameter Real d(unit="N.s/m", min=0) = 2;
  parameter Real c(unit="N/m", min=0) = 8;
  input Real F(unit="N");
  Real x(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
equation
  der(x) = v;
  m*der(v) = F - d*v - c*x;
end Cart;
"""
CASE = """model = "Cart.mo"
[parameters]
m = 4
d = 2
c = 8
[uncertainty]
m = 0.05
d = 0.1
c = 0.05
[signals.F]
role = "input"
variable = "F"
unit = "N"
interpolation = "hold"
[signals.x]
role = "output"
variable = "x"
unit = "m"
noise_std = 0.002
[signals.v]
role = "output"
variable = "v"
unit = "m/s"
noise_std = 0.005
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""
STEP = 0.05  # s

Distort = Callable[[np.ndarray], np.ndarray]  # positions at the samples, as they are read


def leaking(x: np.ndarray) -> np.ndarray:
    """Behind a capacitor: a time constant of 6 s; between samples positions are lines."""
    lost, shown = 0.0, [x[0]]
    for before, after in pairwise(x):
        keeps, slope = np.exp(-STEP / 6.0), (after - before) / STEP
        lost = (lost - before + slope * 6.0) * keeps + after - slope * 6.0
        shown.append(after - lost)
    return np.array(shown)


def following(x: np.ndarray) -> np.ndarray:
    shown = [x[0]]
    for value in x[1:]:
        shown.append(min(max(shown[-1], value - 0.04), value + 0.04))
    return np.array(shown)


@pytest.mark.parametrize(
    ("distort", "effect", "parameter", "value", "within"),
    [
        (leaking, "sensor.leak", "T", 6.0, 0.02),
        (lambda x: np.where(np.abs(x) < 0.15, 0.0, x), "sensor.dead_band", "least", 0.15, 0.05),
        (following, "sensor.backlash", "gap", 0.04, 0.03),
        (lambda x: x + 0.003 * STEP * np.arange(len(x)), "sensor.drift", "drift", 0.003, 0.03),
    ],
)
def test_an_error_of_one_sensor_is_found(
    distort: Distort, effect: str, parameter: str, value: float, within: float, tmp_path: Path
) -> None:
    random = np.random.default_rng(8)
    (tmp_path / "Cart.mo").write_text(CART)
    (tmp_path / "case.toml").write_text(CASE)
    for name in ("r1", "r2", "r3"):
        force = np.repeat(random.uniform(-6, 6, 12), 50)
        state, seen = np.zeros(2), []
        for f in force:
            seen.append(state)
            for _ in range(10):  # explicit midpoint
                half = state + STEP / 20 * _rates(state, f)
                state = state + STEP / 10 * _rates(half, f)
        x, v = np.array(seen).T
        table = np.column_stack([
            STEP * np.arange(len(force)), force, distort(x) + random.normal(0, 0.002, len(x)),
            v + random.normal(0, 0.005, len(v)),
        ])  # fmt: skip
        np.savetxt(tmp_path / f"{name}.csv", table, delimiter=",", header="time,F,x,v", comments="", fmt="%.7g")
    found = explain(load(tmp_path))
    assert found.verdict == "missing_physics", found.reason
    (finding,) = found.findings
    attachment = finding.ranked.attachment
    assert (attachment.effect.identifier, attachment.location) == (effect, "sensor:x")
    assert found.final.point[attachment.full_name(parameter)] == pytest.approx(value, rel=within)


def _rates(state: np.ndarray, force: float) -> np.ndarray:
    return np.array([state[1], (force - 2 * state[1] - 8 * state[0]) / 4])


def test_a_sensor_that_shows_a_part_of_another_ones_quantity(tmp_path: Path) -> None:
    shown = BELIEVED.replace("equation", "  Real shown;\nequation\n  shown = lower + 0.05*upper;", 1)
    found = explain(load(cascade(tmp_path, shown, "shown")))
    assert found.verdict == "missing_physics", found.reason
    (finding,) = found.findings
    attachment = finding.ranked.attachment
    assert (attachment.effect.identifier, attachment.location) == ("sensor.crosstalk", "sensor:lower")
    assert found.final.point[attachment.full_name("share")] == pytest.approx(0.05, rel=0.05)


WARM_TANK = """model Tank "What flows out is thinner when it is warm"
  parameter Real A(unit="m2", min=0) = 0.01;
  parameter Real k(unit="m2/s", min=0) = 3e-4;
  input Real q(unit="m3/s");
  input Real T(unit="K");
  Real h(unit="m", start=0.2, fixed=true);
  Real out(unit="m3/s");
  SHOWN
equation
  out = k*h*(1 + 0.01*(T - 293));
  A*der(h) = q - out;
end Tank;
"""
WARM_CASE = """model = "Tank.mo"
[parameters]
A = 0.01
k = 3e-4
[uncertainty]
A = 0.05
k = 0.1
[signals.q]
role = "input"
variable = "q"
unit = "m3/s"
[signals.T]
role = "input"
variable = "T"
unit = "K"
[signals.h]
role = "output"
variable = "h"
unit = "m"
noise_std = 0.0005
[signals.out]
role = "output"
variable = "out"
unit = "m3/s"
noise_std = 1e-7
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


@pytest.mark.parametrize(
    ("shown", "effect", "slope", "unit"),
    [
        ("out*(1 + 0.002*(T - 293))", "SensorSpanOverTemperature", 0.002, "K"),
        ("out + 4e-8*(T - 293)", "SensorZeroOverTemperature", 4e-8, "degC"),
    ],
)
def test_a_sensor_whose_scale_or_zero_follows_a_temperature(
    tmp_path: Path, shown: str, effect: str, slope: float, unit: str
) -> None:
    """In kelvin, and the same machine in degrees Celsius, whose 20 are taken for 293."""
    machine = WARM_TANK.replace("SHOWN", f'Real shown(unit="m3/s") = {shown};')
    zero = {"K": 293, "degC": 20}[unit]
    machine, believed, told = (
        text.replace("293", str(zero)).replace('"K"', f'"{unit}"')
        for text in (machine, WARM_TANK.replace("SHOWN", ""), WARM_CASE)
    )
    folder, tank = concealed(tmp_path, "Tank", machine, believed, told)
    time, random = np.arange(400) * 1.0, np.random.default_rng(5)
    for k in (1, 2, 3):
        inputs = {
            "q": 6e-5 * (1 + 0.8 * np.sign(np.sin(0.05 * k * time + k))),
            "T": zero + 12 * np.sin(0.021 * time + 2 * k),
        }
        errors = {"h": 5e-4 * random.normal(size=len(time)), "out": 1e-7 * random.normal(size=len(time))}
        record(folder / f"r{k}.csv", tank, time, inputs, {"h": "h", "out": "shown"}, errors)
    found = explain(load(folder))
    assert found.verdict == "missing_physics", found.reason
    (finding,) = found.findings
    attachment = finding.ranked.attachment
    assert (attachment.effect.name, attachment.location) == (effect, "sensor:out")
    assert found.final.point[attachment.full_name("slope")] == pytest.approx(slope, rel=0.05)


def test_errors_that_are_of_several_other_sensors_have_names_of_their_own(tmp_path: Path) -> None:
    """They are screened in one model."""
    case = load(cascade(tmp_path, BELIEVED))
    case.signals["level"] = replace(case.signals["upper"], column="level", variable="level")
    effects = [e for e in catalogue.read(case.library()) if e.identifier == "sensor.crosstalk"]
    structure = places.read(case.library(), case.base)
    found = enumerate_attachments(case, structure, effects, Amendment(structure))
    assert len(found) == len({a.component for a in found}) == 6
    assert {a.signals for a in found if a.variable == "level"} == {(("other", "upper"),), (("other", "lower"),)}
