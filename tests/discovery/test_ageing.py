"""What has changed by all that was done since the start: a filter clogs, a catalyst is spent, a wall ages."""

from __future__ import annotations

from pathlib import Path
import re

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.efforts.laws.variants import _aged
from lacuna.discovery.efforts.places.sites import Site as Place
from lacuna.discovery.explain import explain
from lacuna.discovery.law.law import Law, Site
from lacuna.discovery.law.terms.courses import evaluate
from lacuna.discovery.law.terms.law_terms import Group, Shape, Variable

from .recorded import concealed, record

REACTOR = """model Reactor "A stirred basket of catalyst, first order"
  parameter Real V(unit="m3", min=0) = 0.02;
  parameter Real k(unit="1/s", min=0) = 0.02;
  input Real q(unit="m3/s");
  input Real c0(unit="g/m3");
  Real c(unit="g/m3", start=100, fixed=true);
equation
  V*der(c) = q*(c0 - c) - V*k*c;
end Reactor;
"""
SPENT = """  Real a(start=1, fixed=true) "Share of the catalyst that is left";
equation
  der(a) = -4e-6*c*a;"""
FILTER = """model Filter "A tank that empties through a filter"
  parameter Real A(unit="m2", min=0) = 0.5;
  parameter Real R(unit="s/m2", min=0) = 200;
  input Real q(unit="m3/s");
  Real h(unit="m", start=0.5, fixed=true);
  Real out(unit="m3/s");
equation
  R*out = h;
  A*der(h) = q - out;
end Filter;
"""
CLOGGED = """  Real v(start=0, fixed=true) "What went through";
equation
  der(v) = out;"""
WALL = """model Wall "A wall that is heated on one side"
  parameter Real C(unit="J/K", min=0) = 5000;
  parameter Real G(unit="W/K", min=0) = 12;
  input Real P(unit="W");
  Real T(unit="K", start=293, fixed=true);
equation
  C*der(T) = P - G*(T - 293);
end Wall;
"""
LEVEL, SLOW = Shape("q", "1", 0.5, 0.0, 1.0), Shape("t", "s", 20.0, 1.0, 900.0)
UNITS = {"q": "m3/s", "c0": "g/m3", "c": "g/m3", "h": "m", "out": "m3/s", "P": "W", "T": "K"}


def test_what_has_come_together_follows_its_integral() -> None:
    time = np.linspace(2.0, 12.0, 2001)
    path, sizes = {"x1": 2 + np.sin(time), "time": time}, {"x1": 4.0}
    integral = (2 * (time - 2) - np.cos(time) + np.cos(2.0)) / 4
    np.testing.assert_allclose(evaluate("total((x1/x1_ref), 5)", path, sizes), integral / 5, atol=1e-6)
    np.testing.assert_allclose(evaluate("spent((x1/x1_ref), 5)", path, sizes), 1 - np.exp(-integral / 5), atol=1e-6)
    np.testing.assert_allclose(evaluate("total(1, 5)", path, sizes), (time - 2) / 5)
    np.testing.assert_allclose(evaluate("warmth(1, 5)", path, sizes), 1 - np.exp((2 - time) / 5))


def told(
    folder: Path, believed: str, changes: dict[str, str], inputs: dict[str, tuple[float, float]],
    outputs: dict[str, float], interval: float,
) -> tuple[str, dict[str, float]]:  # fmt: skip
    """(text of the law that is found, its numbers and the sizes of its variables) where the machine is the believed one
    with some `changes`; inputs in steps within their ranges, outputs with their noise."""
    name, machine = believed.split()[1], believed
    for here, there in changes.items():
        assert machine.count(here) == 1
        machine = machine.replace(here, there)
    values = dict(re.findall(r"parameter Real (\w+)\(.*= (\S+);", believed))
    text = f'model = "{name}.mo"\n[parameters]\n' + "".join(f"{n} = {v}\n" for n, v in values.items())
    text += "[uncertainty]\n" + "".join(f"{n} = 0.05\n" for n in values)
    for n in inputs:
        text += f'[signals.{n}]\nrole = "input"\nvariable = "{n}"\nunit = "{UNITS[n]}"\n'
    for n, noise in outputs.items():
        text += f'[signals.{n}]\nrole = "output"\nvariable = "{n}"\nunit = "{UNITS[n]}"\nnoise_std = {noise}\n'
    text += '[recordings]\nfit = ["r1.csv", "r2.csv"]\nvalidate = ["r3.csv"]\n'
    case, truth = concealed(folder, name, machine, believed, text)
    random, time = np.random.default_rng(7), interval * np.arange(600)
    for k in (1, 2, 3):
        steps = {n: np.repeat(random.uniform(*ends, 20), 30) for n, ends in inputs.items()}
        errors = {n: noise * random.normal(size=600) for n, noise in outputs.items()}
        record(case / f"r{k}.csv", truth, time, steps, {n: n for n in outputs}, errors)
    result = explain(load(case))
    (finding,) = result.findings
    law = finding.ranked.attachment.law
    numbers = finding.ranked.attachment.own_values(result.final.point)
    return law.text(), numbers | {v.name: v.size for v in law.references()}


def test_a_catalyst_that_is_spent_by_what_it_turns_over(tmp_path: Path) -> None:
    changes = {"equation": SPENT, "V*k*c": "V*k*a*c"}
    inputs = {"q": (1e-4, 8e-4), "c0": (200.0, 1500.0)}
    text, found = told(tmp_path, REACTOR, changes, inputs, {"c": 3.0}, 2.0)
    assert "spent((" in text
    assert 1 / (found["c"] * found["t_1"]) == pytest.approx(4e-6, rel=0.03)


def test_a_filter_that_clogs_by_all_that_went_through(tmp_path: Path) -> None:
    changes = {"equation": CLOGGED, "R*out = h": "R*(1 + v/4)*out = h"}
    text, found = told(tmp_path, FILTER, changes, {"q": (0.001, 0.008)}, {"h": 0.004, "out": 2e-5}, 2.0)
    assert "total((" in text
    assert "out" in found


def test_a_wall_whose_insulation_ages_with_time_alone(tmp_path: Path) -> None:
    text, found = told(
        tmp_path, WALL, {"G*(T - 293)": "G*(1 + time/4000)*(T - 293)"}, {"P": (50.0, 900.0)}, {"T": 0.1}, 4.0
    )
    assert "total(1, " in text
    assert found["c_1"] / (599 * 4.0) == pytest.approx(12 / 4000, rel=0.03)


def test_a_storage_that_begins_empty_beside_one_that_does_not(tmp_path: Path) -> None:
    beside = """  Real z(start=0, fixed=true) "Sunk into the wall";
equation
  500*der(z) = T - z;"""
    changes = {"equation": beside, "T - 293)": "T - 293) - 4*(T - z)"}
    text, found = told(tmp_path, WALL, changes, {"P": (50.0, 900.0)}, {"T": 0.5}, 4.0)
    assert text == "c_1*((x1/x1_ref) - warmth((x1/x1_ref), t_1))"
    assert found["t_1"] == pytest.approx(500, rel=0.05)
    assert found["c_1"] / found["T"] == pytest.approx(-4, rel=0.05)


@pytest.mark.parametrize(
    "text", ["total({x}, 60)", "warmth({x}^2, {{t}})", "spent((abs({x} - {{q}}) + {x} - {{q}}), {{t}})"]
)
def test_variants_of_what_ages_keep_the_numbers_that_were_fitted(text: str) -> None:
    variable = Variable("x1", "tank.h", "m", "state", 2.0)
    place = Site(Place("parameter", "k"), "tank.h", "m2/s", (variable,))
    told = text.format(x=variable.scaled)
    group = Group((told,), tuple(s for s in (LEVEL, SLOW) if f"{{{s.name}}}" in told))
    fitted = {"c_1": 3.0, **{f"{s.name}_1": 0.7 * s.start for s in group.shapes}}
    found = _aged(Law(place, (group,)), fitted)
    assert found
    for other in found:
        assert len({s.name for s in other.law.groups[0].shapes}) == len(other.law.groups[0].shapes)
        assert other.start.items() >= fitted.items()
        assert set(other.law.shapes()) <= other.start.keys()
