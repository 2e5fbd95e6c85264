"""Places inside of components: of the user's own classes, at any depth, in arrays, behind a base."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.classes import Library
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read as structure_of
from lacuna.discovery.efforts.places.insertion import probe
from lacuna.discovery.efforts.places.reading import LIBRARY, MANY, read
from lacuna.discovery.efforts.places.sites import Site
from lacuna.runtime import Model

from .recorded import acted

WORKS = """package Works "Units of two bodies"
  connector Heat
    Real T(unit="K");
    flow Real Q(unit="W");
  end Heat;
  model Body
    parameter Real C(unit="J/K") = 100;
    Heat port;
    Real T(unit="K", start=0, fixed=true);
  protected
    Real stored(unit="J");
  equation
    T = port.T;
    stored = C*T;
    C*der(T) = port.Q;
  end Body;
  model Link
    Heat a, b;
    parameter Real G(unit="W/K") = 2;
  equation
    a.Q = G*(a.T - b.T);
    a.Q + b.Q = 0;
  end Link;
  partial model Pair
    Body one, two(C=200);
    Link link;
    Heat port;
  equation
    connect(port, one.port);
    connect(one.port, link.a);
    connect(link.b, two.port) annotation(Line(points={{0, 0}, {1, 1}}));
  end Pair;
  model Unit "Its bodies are inherited"
    extends Pair;
  end Unit;
  connector Out = output Real;
  connector In = input Real;
  model Ramp
    Out y;
  equation
    y = 3*time;
  end Ramp;
  model Follower
    In u;
    Real x(start=0, fixed=true);
  equation
    der(x) = u - x;
  end Follower;
  model Chain
    Ramp ramp;
    Follower follower;
  equation
    connect(ramp.y, follower.u);
  end Chain;
  model Hall "Two units and one inside of another component"
    Unit unit[2];
    Wing wing;
  end Hall;
  model Wing
    Unit unit;
    Chain chain;
  end Wing;
  model Heavy
    extends Body;
  end Heavy;
  model Changed
    Body many[13];
    replaceable Body body;
  end Changed;
  model Variant
    Changed changed(redeclare Heavy body);
    Stock.Rack rack;
  end Variant;
end Works;
"""
STOCK = """package Stock "Somebody else's"
  model Rack
    Works.Body one, two;
  equation
    connect(one.port, two.port);
  end Rack;
end Stock;
"""
TIME = np.array([0.0, 40.0, 4000.0])


@pytest.fixture
def works(tmp_path: Path) -> Path:
    for name, text in (("Works", WORKS), ("Stock", STOCK)):
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.mo").write_text(text)
    return tmp_path


def places(folder: Path, name: str = "Works.Hall") -> dict[str, Site]:
    return {f"{s.kind} {s.label}": s for s in read(Library([str(folder)]), name).places}


def opened(folder: Path, labels: list[str], names: list[str]) -> list[np.ndarray]:
    """Variables at TIME with an effort of 6 at each of some sites."""
    found = places(folder)
    return acted(folder, "Works.Hall", [found[label] for label in labels], 6.0, names, TIME)


def test_places_inside_components_are_read_at_any_depth(works: Path) -> None:
    found = places(works)
    assert {"node unit[1].link.b", "node unit[2].link.b", "node wing.unit.link.b"} <= set(found)
    assert "edge wing.unit.link.b to wing.unit.two.port" in found
    assert "branch unit[2].link" in found
    assert "signal wing.chain.ramp.y to wing.chain.follower.u" in found
    assert "equation unit[2].two: C*der(T) = port.Q" in found
    way = found["equation wing.unit.two: C*der(T) = port.Q"].way
    assert [step.cls.name for step in way] == ["Wing", "Unit", "Pair", "Body"]


@pytest.mark.parametrize("unit", ["unit[2]", "wing.unit"])
def test_what_flows_into_a_node_inside_is_stored_there(works: Path, unit: str) -> None:
    one, two, other = opened(works, [f"node {unit}.link.b"], [f"{unit}.one.T", f"{unit}.two.T", "unit[1].two.T"])
    assert 100 * one + 200 * two == pytest.approx(6.0 * TIME, abs=1e-3)
    assert (two - one)[-1] == pytest.approx(6.0 / 3 / 2, rel=1e-6)  # a third of it goes on through 2 W/K
    assert other == pytest.approx(0.0)


@pytest.mark.parametrize("unit", ["unit[1]", "wing.unit"])
def test_what_is_lost_across_a_connection_inside_parts_its_ends(works: Path, unit: str) -> None:
    one, two = opened(works, [f"edge {unit}.link.b to {unit}.two.port"], [f"{unit}.one.T", f"{unit}.two.T"])
    assert (one - two)[-1] == pytest.approx(6.0, rel=1e-6)
    assert (100 * one + 200 * two) == pytest.approx(0.0, abs=1e-5)


def test_what_goes_past_a_component_inside_comes_back_through_it(works: Path) -> None:
    one, two = opened(works, ["branch unit[2].link"], ["unit[2].one.T", "unit[2].two.T"])
    assert (two - one)[-1] == pytest.approx(6.0 / 2, rel=1e-6)
    assert (100 * one + 200 * two) == pytest.approx(0.0, abs=1e-5)


def test_a_signal_inside_arrives_with_what_is_added(works: Path) -> None:
    (x,) = opened(works, ["signal wing.chain.ramp.y to wing.chain.follower.u"], ["wing.chain.follower.x"])
    assert x == pytest.approx(3 * (TIME - 1 + np.exp(-TIME)) + 6 * (1 - np.exp(-TIME)), abs=1e-4)


def test_several_places_of_one_copied_class_keep_apart(works: Path) -> None:
    """Two elements of an array share the text, a node and an equation of one unit the class."""
    labels = [
        "equation unit[1].two: C*der(T) = port.Q",
        "equation unit[2].one: C*der(T) = port.Q",
        "node unit[2].link.b",
    ]
    names = [f"unit[{k}].{body}.T" for k in (1, 2) for body in ("one", "two")]
    first, second, third, fourth = opened(works, labels, names)
    assert 100 * first + 200 * second == pytest.approx(6.0 * TIME, abs=1e-3)
    assert 100 * third + 200 * fourth == pytest.approx(12.0 * TIME, abs=1e-3)


def test_what_is_not_gone_into_is_said_to_be_closed(works: Path) -> None:
    closed = dict(read(Library([str(works)]), "Works.Variant").closed)
    assert closed == {"changed.many": MANY, "rack": LIBRARY}


def test_what_an_amendment_adds_is_no_variable_of_the_believed_model(works: Path) -> None:
    """Else a second law could be a function of the first one's effort."""
    found = places(works)
    sites = [found["node unit[2].link.b"], found["equation wing.unit.two: C*der(T) = port.Q"]]
    structure = structure_of(Library([str(works)]), "Works.Hall")
    pairs = [probe(site, k) for k, site in enumerate(sites)]
    amendment = Amendment(structure, attachments=[a for a, _ in pairs], inputs=tuple(n for _, n in pairs))
    file = works / "Amended.mo"
    file.write_text(amendment.text("Amended"))
    amended = Model(compile_model(str(file), search_path=[str(works)]).path).variables
    file.write_text(Amendment(structure).text("Amended"))
    believed = Model(compile_model(str(file), search_path=[str(works)]).path).variables
    assert {n for n in amended if amendment.adds(n)} == amended.keys() - believed.keys() - {n for _, n in pairs}
