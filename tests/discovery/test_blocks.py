"""A machine of components whose classes stand elsewhere in its file, joined by signals: its places, one by one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.efforts.places.reading import read
from lacuna.discovery.efforts.places.sites import Site

from .recorded import acted

LINE = """package Process "Signals and parts"
  connector ConcIn = input Real(unit="mol/m3");
  connector ConcOut = output Real(unit="mol/m3");
  model Feed
    ConcOut b;
  equation
    b = 20;
  end Feed;
  model Vessel "Stirred"
    ConcIn a;
    ConcOut b;
    parameter Real V(unit="m3") = 0.02;
    parameter Real Q(unit="m3/s") = 2e-4;
    Real c(unit="mol/m3", start=20, fixed=true);
  equation
    V*der(c) = Q*(a - c);
    b = c;
  end Vessel;
end Process;
model Line "Two vessels"
  import Process.*;
  Feed feed;
  Vessel first, second(V=0.01);
equation
  connect(feed.b, first.a);
  connect(first.b, second.a);
end Line;
"""


@pytest.fixture
def line(tmp_path: Path) -> Path:
    path = tmp_path / "Line.mo"
    path.write_text(LINE)
    return path


def places(path: Path) -> dict[str, Site]:
    return {s.label: s for s in read(Library([str(path)]), "Line").places}


def opened(path: Path, site: Site, amount: float) -> list[np.ndarray]:
    """(first.c, second.c) over 400 s with an effort of this amount at a site."""
    return acted(path, "Line", [site], amount, ["first.c", "second.c"], np.linspace(0, 400, 41))


def test_every_balance_and_signal_of_the_parts_is_a_place(line: Path) -> None:
    assert list(places(line)) == [
        "feed.b to first.a", "first.b to second.a", "feed: b = 20", "first: V*der(c) = Q*(a - c)", "first: b = c",
        "second: V*der(c) = Q*(a - c)", "second: b = c",
    ]  # fmt: skip


def test_a_term_in_one_of_two_vessels_of_a_class_acts_there_alone(line: Path) -> None:
    first, second = opened(line, places(line)["second: V*der(c) = Q*(a - c)"], 1e-3)
    assert first == pytest.approx(20.0)
    assert second == pytest.approx(20.0 + 5.0 * (1 - np.exp(-np.linspace(0, 400, 41) / 50)), abs=1e-6)


def test_a_signal_arrives_with_what_is_added_on_its_way(line: Path) -> None:
    first, second = opened(line, places(line)["first.b to second.a"], 3.0)
    assert first == pytest.approx(20.0)
    assert second == pytest.approx(20.0 + 3.0 * (1 - np.exp(-np.linspace(0, 400, 41) / 50)), abs=1e-6)


def test_a_signal_of_a_vector_of_ports_is_a_place(line: Path) -> None:
    """It ended the search (exit 70)."""
    line.write_text(
        LINE.replace("ConcIn a;", "ConcIn a[1];").replace("Q*(a - c)", "Q*(a[1] - c)").replace(".a);", ".a[1]);")
    )
    assert list(places(line))[:2] == ["feed.b to first.a[1]", "first.b to second.a[1]"]
    _, second = opened(line, places(line)["first.b to second.a[1]"], 3.0)
    assert second == pytest.approx(20.0 + 3.0 * (1 - np.exp(-np.linspace(0, 400, 41) / 50)), abs=1e-6)
