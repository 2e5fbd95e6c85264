"""Places inside of components whose class is another one than their declaration names: redeclared by a modification, of
a component, of an array or of a base, by an element, or as a class."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.efforts.places.reading import read

from .recorded import acted

PLANT = """package Plant
  partial model Engine
    parameter Real T(unit="s") = 2;
    Real y(start=0, fixed=true);
  end Engine;
  model Diesel
    extends Engine;
  equation
    T*der(y) = -y;
  end Diesel;
  model Turbine
    extends Engine(T=4);
  equation
    T*der(y) = 1 - y;
  end Turbine;
  model Set
    replaceable Diesel engine(T=3) constrainedby Engine;
    parameter Real H(unit="s") = 5;
    Real w(start=0, fixed=true);
  equation
    H*der(w) = engine.y;
  end Set;
  model Hall
    Set ship;
    Set shore(H=5,
      redeclare Turbine engine(T=8));
  end Hall;
  model Hybrid
    extends Set(redeclare Turbine engine);
  end Hybrid;
  model Other
    extends Set;
    redeclare Turbine engine;
  end Other;
  model Kind
    replaceable model Prime = Diesel constrainedby Engine;
    Prime engine;
    Real v(start=0, fixed=true);
  equation
    5*der(v) = 1 - v + engine.y;
  end Kind;
  model Island
    Hall hall;
    Set sets[2](redeclare each Turbine engine);
    Hybrid hybrid;
    Other other;
    Kind kind(redeclare model Prime = Turbine);
  end Island;
end Plant;
"""
TIME = np.array([0.0, 1.0, 10.0, 400.0])
INSIDE = ["hall.ship.engine", "hall.shore.engine", "sets[1].engine", "sets[2].engine", "hybrid.engine", "other.engine"]


@pytest.fixture
def plant(tmp_path: Path) -> Path:
    (tmp_path / "Plant").mkdir()
    (tmp_path / "Plant" / "package.mo").write_text(PLANT)
    return tmp_path


@pytest.mark.parametrize("where", INSIDE)
def test_a_term_in_what_stands_there_acts_there_alone(plant: Path, where: str) -> None:
    """T dy/dt = u + 6 - y, of the engine that is meant and of no other one."""
    diesel = where == "hall.ship.engine"
    label = f"{where}: T*der(y) = {'-' if diesel else '1 - '}y"
    sites = {s.label: s for s in read(Library([str(plant)]), "Plant.Island").places}
    lasts, names = {"hall.ship.engine": 3.0, "hall.shore.engine": 8.0}, [f"{e}.y" for e in INSIDE]
    for name, y in zip(names, acted(plant, "Plant.Island", [sites[label]], 6.0, names, TIME), strict=True):
        engine = name.removesuffix(".y")
        final = (engine != "hall.ship.engine") + 6.0 * (engine == where)
        assert y == pytest.approx(final * (1 - np.exp(-TIME / lasts.get(engine, 4.0))), abs=1e-6)


@pytest.mark.parametrize("where", ["hall.shore", "sets[2]", "hybrid", "other"])
def test_a_term_beside_it_and_one_in_it_keep_apart(plant: Path, where: str) -> None:
    """H dw/dt = y + 6 where T dy/dt = 1 + 6 - y."""
    sites = {s.label: s for s in read(Library([str(plant)]), "Plant.Island").places}
    both = [sites[f"{where}: H*der(w) = engine.y"], sites[f"{where}.engine: T*der(y) = 1 - y"]]
    w, y, other = acted(plant, "Plant.Island", both, 6.0, [f"{where}.w", f"{where}.engine.y", "sets[1].w"], TIME)
    last = 8.0 if where == "hall.shore" else 4.0
    gone = 1 - np.exp(-TIME / last)
    assert y == pytest.approx(7.0 * gone, abs=1e-6)
    assert 5.0 * w == pytest.approx(13.0 * TIME - 7.0 * last * gone, abs=1e-5)
    assert 5.0 * other == pytest.approx(TIME - 4.0 * (1 - np.exp(-TIME / 4.0)), abs=1e-5)


def test_what_a_redeclared_class_is_made_of_is_closed(plant: Path) -> None:
    """Its text stands behind a short definition; that of the component around it is open."""
    found = read(Library([str(plant)]), "Plant.Island")
    assert dict(found.closed) == {"kind.engine: T*der(y) = 1 - y": "the equation stands in Plant.Turbine"}
    site = next(s for s in found.places if s.label.startswith("kind"))
    v, y = acted(plant, "Plant.Island", [site], 6.0, ["kind.v", "kind.engine.y"], np.array([0.0, 4000.0]))
    assert [v[-1], y[-1]] == pytest.approx([8.0, 1.0], rel=1e-6)
