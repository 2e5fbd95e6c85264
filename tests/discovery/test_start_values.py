"""A case may speak of the start of what is no state where the model chooses: the position of a mass behind a spring."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Case, load
from lacuna.discovery.catalogue.searched import believed_structure
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.starts import uncertain_starts
from lacuna.discovery.naming.candidate_fit import nearest
from lacuna.discovery.naming.screen import Candidate
from lacuna.discovery.steps import opened

MASS = """model Held "On a spring that prefers its own deflection"
  input Real F(unit="N");
  Real e(unit="m", stateSelect=StateSelect.prefer) "Of the spring";
  Real s(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
  Real q(unit="m/s");
equation
  e = s - 0.2;
  der(e) = q;
  der(s) = v;
  2*der(v) = F - 8*e - q;
end Held;
"""
CASE = """model = "Held.mo"
[signals.F]
role = "input"
variable = "F"
unit = "N"
[signals.s]
role = "output"
variable = "s"
unit = "m"
noise_std = 0.001
[initial]
{name} = "unknown"
[recordings]
fit = ["r1.csv"]
validate = ["r2.csv"]
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "Held.mo").write_text(MASS)
    for shift in (1, 2):
        rows = "\n".join(f"{k / 20},{k % 7 / 10},{0.1 + k % 5 / 1000 + shift / 100}" for k in range(200))
        (tmp_path / f"r{shift}.csv").write_text(f"time,F,s\n{rows}\n")
    return tmp_path


@pytest.mark.parametrize(("name", "states"), [("s", ("s",)), ("e", ()), ("v", ())])
def test_what_a_case_gives_the_start_of_is_a_state(folder: Path, name: str, states: tuple[str, ...]) -> None:
    (folder / "case.toml").write_text(CASE.format(name=name))
    case = load(folder)
    assert believed_structure(case, case.library()).states == states
    _, machine = opened(case, Library([str(folder)]))
    assert machine is None or name in machine.model.states


def test_what_can_be_no_state_is_refused_as_before(folder: Path) -> None:
    (folder / "case.toml").write_text(CASE.format(name="q"))
    case = load(folder)
    assert believed_structure(case, case.library()).states == ()


LAG = """model Lag "A current that nobody records, behind its command, {unit}"
  input Real c(unit="{unit}");
  Real i(unit="{unit}", start={start}, fixed=true);
  Real s(unit="m", start=0, fixed=true);
equation
  0.5*der(i) = c - i;
  der(s) = {gain}*i;
end Lag;
"""


def lagging(folder: Path, model: str, unit: str, per: float = 1.0) -> tuple[Case, Machine]:
    """A case of a command that rises from 10 A by a hundredth, in a unit of which so many are one A."""
    (folder / "Lag.mo").write_text(model)
    for name in ("r1", "r2"):
        rows = "\n".join(f"{k / 20},{(10 + k / 2000) * per},{k / 100 + k % 5 / 1000}" for k in range(200))
        (folder / f"{name}.csv").write_text(f"time,c,s\n{rows}\n")
    text = (
        CASE.replace("Held", "Lag").replace("signals.F", "signals.c").replace('"F"', '"c"').replace('"N"', f'"{unit}"')
    )
    (folder / "case.toml").write_text(text.format(name="i"))
    case = load(folder)
    return case, opened(case, Library([str(folder)]))[1]


@pytest.mark.parametrize(("unit", "per"), [("A", 1.0), ("mA", 1e3)])
def test_a_hidden_start_is_sought_from_what_is_declared_in_units_of_what_the_state_does(
    tmp_path: Path, unit: str, per: float
) -> None:
    """From 3 A to a command of 10.1 A at the end: 7.1 A, in whatever unit the model has."""
    case, machine = lagging(tmp_path, LAG.format(unit=unit, start=3 * per, gain=0.1 / per), unit, per)
    (found,) = (f for f in uncertain_starts(machine, case.fit[0], {}) if f.name.startswith("start:i"))
    assert found.centre == 3 * per and found.sigma is None
    assert found.scale == pytest.approx(7.1 * per, rel=2e-3)


def test_of_starts_that_miss_alike_the_one_nearer_to_belief_is_taken(tmp_path: Path) -> None:
    """A base without what is missing may have left it by any number of sigmas: where nothing moves, T tells nothing."""
    model = LAG.format(unit="A", start=0, gain=0.0).replace("0.5*der", "T*der")
    model = model.replace("  input Real c", '  parameter Real T(unit="s", min=0) = 0.5;\n  input Real c')
    case, machine = lagging(tmp_path, model, "A")
    base, _ = fit_believed(case, machine)
    candidate, here = Candidate(None, machine, []), dict(base.point)
    far, near = here | {"T": 5.0}, here | {"T": 0.5}
    assert nearest(case, base, candidate, far, near) is near


GEARED = """model Geared "Two inertias, whose springs and bearings prefer their own angles"
  import Modelica.Mechanics.Rotational.{Components, Sources};
  input Real tau(unit="N.m");
  Sources.Torque drive;
  Components.Inertia rotor(J=2, phi(start=0, fixed=true), w(start=0, fixed=true));
  Components.Inertia generator(J=1, phi(start=0, fixed=true), w(start=0, fixed=true));
  Components.SpringDamper shaft(c=50, d=1);
  Components.IdealGear gear(ratio=0.1);
  Components.Damper bearing(d=1);
  Components.Fixed wall;
equation
  drive.tau = tau;
  connect(drive.flange, rotor.flange_a);
  connect(rotor.flange_b, shaft.flange_a);
  connect(shaft.flange_b, gear.flange_a);
  connect(gear.flange_b, generator.flange_a);
  connect(generator.flange_b, bearing.flange_a);
  connect(bearing.flange_b, wall.flange);
end Geared;
"""


def test_all_that_a_case_gives_the_starts_of_are_states_together(folder: Path, shared: Path) -> None:
    """Where the first ones are, others come to be rates that have no start of their own."""
    (folder / "Geared.mo").write_text(GEARED)
    names = ("rotor.phi", "rotor.w", "generator.phi", "generator.w")
    text = CASE.format(name="s").replace('s = "unknown"', "\n".join(f'"{n}" = 0.0' for n in names))
    for old, new in (
        ("Held", "Geared"),
        ('"s"', '"generator.phi"'),
        ('"m"', '"rad"'),
        ('"F"', '"tau"'),
        ('"N"', '"N.m"'),
    ):
        text = text.replace(old, new)
    (folder / "case.toml").write_text(f'libraries = ["{shared / "msl"}"]\n{text}')
    case = load(folder)
    _, machine = opened(case, case.library())
    assert set(names) <= machine.model.states.keys()
