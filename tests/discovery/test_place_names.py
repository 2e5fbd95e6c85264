"""What places are called: an engineer looks for a name in the model, and no two places share one."""

from __future__ import annotations

from lacuna.discovery.efforts.opened import Place, _apart
from lacuna.discovery.efforts.sites import Site


def place(location: str, *sites: Site) -> Place:
    return Place(location, sites, 0, "N.m")


def test_both_ends_of_a_shaft_whose_twist_is_a_state_have_their_own_names() -> None:
    motor = place("coupling", Site("node", "motor", ("coupling.a", "motor.b")), Site("node", "drive", ("motor.a",)))
    brake = place("coupling", Site("node", "brake", ("coupling.b", "brake.a")), Site("node", "pad", ("brake.b",)))
    beside = place("coupling", Site("branch", "coupling", ("coupling.a", "coupling.b")))
    assert [p.location for p in _apart([motor, brake, beside])] == ["motor", "brake", "coupling"]


def test_a_state_names_its_own_balance_and_not_what_flows_there() -> None:
    balance, flow = place("Tc", Site("equation", "C*der(Tc) = P - q")), place("Tc", Site("equation", "q = G*(Tc - Th)"))
    varies = place("Tc", Site("exchange", "C*der(Tc) = P - q and D*der(Th) = q"))
    assert [p.location for p in _apart([flow, balance, varies])] == ["q", "Tc", "Tc"]


def test_a_port_keeps_the_name_of_its_state_beside_the_wall_behind_it() -> None:
    shell = place("shell", Site("node", "film.b", ("film.b", "shell.a", "fins.a")))
    wall = place("shell", Site("edge", "film.b to shell.a", ("film.b", "shell.a")))
    assert [p.location for p in _apart([wall, shell])] == ["shell", "shell"]
