"""Machines whose equations are partly statements: what is assigned once holds at all times, and is a place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.efforts.places.reading import ALGORITHM, read

from .recorded import acted

REACTOR = """model Reactor "A declaration must come before the first section, of whatever kind it is"
  function rate
    input Real s;
    output Real r;
  algorithm
    r := 0.1*s;
  end rate;
  Real s(start=1);
  Real p(start=0, fixed=true);
  Real r;
  Real half;
  Real twice;
initial equation
  s = 2;
algorithm
  r := rate(s);
  assert(r > -10, "too fast");
algorithm
  half := r;
  half := half/2;
  twice := 2*r;
equation
  der(s) = -r;
  der(p) = half + twice - 2*half;
end Reactor;
"""


@pytest.fixture
def reactor(tmp_path: Path) -> Path:
    path = tmp_path / "Reactor.mo"
    path.write_text(REACTOR)
    return path


def test_what_is_assigned_once_is_a_place_and_what_is_assigned_again_is_said_to_be_none(reactor: Path) -> None:
    found = read(Library([str(reactor)]), "Reactor")
    labels = {s.label for s in found.places}
    assert labels == {"r = rate(s)", "twice = 2*r", "der(s) = -r", "der(p) = half + twice - 2*half"}
    lines = [k for k, line in enumerate(REACTOR.split("\n"), start=1) if line.startswith("  half :=")]
    assert {place for place, why in found.closed if why == ALGORITHM} == {f"line {k}" for k in lines}


@pytest.mark.parametrize("label", ["r = rate(s)", "der(s) = -r"])
def test_an_effort_acts_where_it_is_put(reactor: Path, label: str) -> None:
    """r = 0.1 s + e, s' = -r: s = 2 exp(-0.1 t) - e/0.1 (1 - exp(-0.1 t)); added to s' itself, with the other sign."""
    site = next(s for s in read(Library([str(reactor)]), "Reactor").places if s.label == label)
    (s,) = acted(reactor, "Reactor", [site], 0.5, ["s"], np.array([0.0, 5.0]))
    expected = 2 * np.exp(-0.5) + (-1 if label.startswith("r") else 1) * 5.0 * (1 - np.exp(-0.5))
    assert s[-1] == pytest.approx(expected, rel=1e-6)
