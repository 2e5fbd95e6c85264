"""What places are called: an engineer looks for a name in the model, and no two places share one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.search_path import search_path
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.places import read as structure_of
from lacuna.discovery.efforts.find import places_of
from lacuna.discovery.efforts.guide import guide
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.efforts.located import Locator
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.efforts.places.place import Place, adjoins, name_there, told_apart
from lacuna.discovery.efforts.places.sites import Port, Site
from lacuna.discovery.law.empirical_law import fitted_law
from lacuna.discovery.law.law import Law
from lacuna.discovery.law.terms.law_terms import Group, Shape
from lacuna.discovery.steps import fitted

from .recorded import concealed, record


def place(location: str, *sites: Site) -> Place:
    return Place(location, sites, (0,), "N.m")


def _varies(name: str, instance: str) -> Site:
    return Site("parameter", name, parts=(Site("equation", f"f = {name}*v", instance=instance),), instance=instance)


def test_both_ends_of_a_shaft_whose_twist_is_a_state_have_their_own_names() -> None:
    motor = place("coupling", Site("node", "motor", ("coupling.a", "motor.b")), Site("node", "drive", ("motor.a",)))
    brake = place("coupling", Site("node", "brake", ("coupling.b", "brake.a")), Site("node", "pad", ("brake.b",)))
    beside = place("coupling", Site("branch", "coupling", ("coupling.a", "coupling.b")))
    assert [p.location for p in told_apart([motor, brake, beside])] == ["motor", "brake", "coupling"]


def test_a_state_names_its_own_balance_and_not_what_flows_there() -> None:
    balance, flow = place("Tc", Site("equation", "C*der(Tc) = P - q")), place("Tc", Site("equation", "q = G*(Tc - Th)"))
    varies = place("Tc", Site("exchange", "C*der(Tc) = P - q and D*der(Th) = q"))
    assert [p.location for p in told_apart([flow, balance, varies])] == ["q", "Tc", "Tc"]


def test_a_port_keeps_the_name_of_its_state_beside_the_wall_behind_it() -> None:
    shell = place("shell", Site("node", "film.b", ("film.b", "shell.a", "fins.a")))
    wall = place("shell", Site("edge", "film.b to shell.a", ("film.b", "shell.a")))
    assert [p.location for p in told_apart([wall, shell])] == ["shell", "shell"]


FORCE, CURRENT = Port("Flange", "f", "s"), Port("Pin", "i", "v")


@pytest.mark.parametrize(
    ("one", "other", "joined"),
    [
        (_varies("damper.d", "damper"), Site("node", "arm", ("arm.b", "damper.a"), FORCE), True),
        (_varies("damper.d", "damper"), Site("node", "head", ("head.b", "spring.a"), FORCE), False),
        (Site("node", "arm", ("arm.b", "damper.a"), FORCE), Site("node", "base", ("damper.b", "base.a"), FORCE), True),
        (Site("node", "coil", ("coil.n", "emf.p"), CURRENT), Site("node", "shaft", ("emf.a", "shaft.a"), FORCE), False),
        (_varies("d", ""), Site("node", "arm", ("arm.b", "damper.a"), FORCE), False),
    ],
)
def test_what_varies_in_a_component_adjoins_what_that_holds(one: Site, other: Site, joined: bool) -> None:
    """A voltage that is lost and a torque, on both sides of a motor, are two kinds of physics."""
    assert adjoins(one, other) == adjoins(other, one) == joined


def test_a_coefficient_of_another_component_is_named_by_that() -> None:
    """What stretches a damper is told of the mass that it holds, which its place has the name of."""
    assert name_there(_varies("damper.d", "damper"), "base") == "damper"
    assert name_there(_varies("base.m", "base"), "base") == "base"
    assert name_there(_varies("wheel.tyre.c", "wheel.tyre"), "wheel.tyre.spring") == "wheel.tyre.spring"


ROTOR = """model Rotor "A disc that is no relative of the library's, between two dampers"
  model Inertia "Its flanges turn as one, as its equations say"
    Lacuna.Interfaces.Flange_a flange_a;
    Lacuna.Interfaces.Flange_b flange_b;
    parameter Real J(unit="kg.m2") = 1e-3;
    Real phi(unit="rad", start=0, fixed=true);
    Real w(unit="rad/s", start=1, fixed=true);
  equation
    phi = flange_a.phi;
    phi = flange_b.phi;
    w = der(phi);
    J*der(w) = flange_a.tau + flange_b.tau;
  end Inertia;
  Inertia disc;
  Lacuna.Components.Mechanics.Spring left(c=1), right(c=1);
  Lacuna.Components.Mechanics.Fixed wall;
equation
  connect(wall.flange, left.flange_a);
  connect(left.flange_b, disc.flange_a);
  connect(disc.flange_b, right.flange_a);
  connect(right.flange_b, wall.flange);
end Rotor;
"""


def test_flanges_that_turn_as_one_are_one_shaft_whatever_class_says_so(tmp_path: Path) -> None:
    (tmp_path / "Rotor.mo").write_text(ROTOR)
    (shaft,) = structure_of(Library(search_path([tmp_path])), str(tmp_path / "Rotor.mo")).shafts
    assert shaft.location == "disc"
    assert {"disc.flange_a", "disc.flange_b", "left.flange_b", "right.flange_a"} <= set(shaft.members)


MAGNET = """model Magnet "What pulls a mass in a damper"
  parameter Real m(unit="kg", min=0) = 0.5;
  parameter Real b(unit="N.s/m", min=0) = 2;
  parameter Real k(unit="N/A") = 3;
  input Real i(unit="A");
  Real v(unit="m/s", start=0, fixed=true);
  Real F(unit="N");
equation
  F = k*i;
  m*der(v) = F - b*v;
end Magnet;
"""
LATE = """model Magnet "Whose pull is late: eddy currents"
  input Real i;
  Real v(start=0, fixed=true);
  Real F(start=0, fixed=true);
equation
  0.05*der(F) = 3*i - F;
  0.5*der(v) = F - 2*v;
end Magnet;
"""
CASE = """title = "Magnet"
model = "Magnet.mo"
source = "synthetic"
[signals.i]
role = "input"
variable = "i"
unit = "A"
[signals.v]
role = "output"
variable = "v"
unit = "m/s"
noise_std = 0.002
[recordings]
fit = ["r0.csv"]
validate = ["r1.csv"]
"""


def test_a_state_of_what_was_added_before_gives_no_place_its_name(tmp_path: Path) -> None:
    """What is off in the pull is off in the law of a late pull first: `law_v` is no place of the machine."""
    folder, machine = concealed(tmp_path, "Magnet", LATE, MAGNET, CASE)
    time, dice = np.linspace(0, 5, 1001), np.random.default_rng(5)
    for n in range(2):
        current = np.sign(np.sin((7.0 + n) * time)) * (1 + 0.5 * np.sin(time))
        record(folder / f"r{n}.csv", machine, time, {"i": current}, {"v": "v"}, {"v": 0.002 * dice.normal(size=1001)})
    case = load(folder)
    told = fitted(case, lambda text: None)
    locator = Locator(case, opened(case, told.amendment, case.library(), ["m", "b", "k"]), told.base)
    site = next(s for s in locator.ranked() if s.location == "v")
    own = next(proposals(locator, site, guide(locator, site), 3))[0].law.site
    pull = next(v.scaled for v in own.variables if v.name == "F")
    law = Law(own, (Group((f"({pull} - lag({pull}, {{tau}}))",), (Shape("tau", "s", 0.05, 0.005, 0.5),)),))
    late = fitted_law(case, told.amendment, told.base, law, {"c_1": -1.0, "tau_1": 0.05})
    beside = places_of(case, replace(told.amendment, attachments=[late.attachment]), late.fit, case.library())
    locations = [s.location for s in beside.sites]
    assert "v" in locations and not [name for name in locations if name.startswith("law_")]
