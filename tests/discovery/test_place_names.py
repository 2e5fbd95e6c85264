"""What places are called: an engineer looks for a name in the model, and no two places share one."""

from __future__ import annotations

from pathlib import Path

from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.search_path import search_path
from lacuna.discovery.catalogue.places import read as structure_of
from lacuna.discovery.efforts.places.place import Place, told_apart
from lacuna.discovery.efforts.places.sites import Site


def place(location: str, *sites: Site) -> Place:
    return Place(location, sites, (0,), "N.m")


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
