"""One place in two quantities: what a valve is told, and what flows because of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.efforts.guide import guide
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.efforts.located import Locator
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.steps import fitted

from .recorded import record, truth

VESSEL = """model Vessel "Fills from a supply as its valve is told"
  parameter Real C(unit="kg/Pa", min=0) = 1e-6;
  parameter Real k(unit="kg/(s.Pa)", min=0) = 6e-7;
  parameter Real g(unit="kg/(s.Pa)", min=0) = 1.5e-7;
  parameter Real ps(unit="Pa") = 6e5;
  input Real u(unit="1") "Told";
  Real y(unit="1") "Opening";
  Real p(unit="Pa", start=1e5, fixed=true);
equation
  y = %s;
  C*der(p) = k*y*(ps - p) - g*p;
end Vessel;
"""
CASE = """model = "Vessel.mo"
[uncertainty]
C = 0.05
k = 0.05
g = 0.1
ps = 0
[signals.u]
role = "input"
unit = "1"
[signals.p]
role = "output"
unit = "Pa"
noise_std = 800
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


@pytest.fixture(scope="module")
def vessel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A case whose valve does not open before it is told to do so by 0.15."""
    folder = tmp_path_factory.mktemp("vessel")
    machine = truth(folder, "Vessel", VESSEL % "noEvent(max(u - 0.15, 0))")
    (folder / "Vessel.mo").write_text(VESSEL % "u", encoding="utf-8")
    (folder / "case.toml").write_text(CASE, encoding="utf-8")
    random, time = np.random.default_rng(5), np.arange(120) * 0.2
    for n in (1, 2, 3):
        u = np.repeat(random.uniform(0, 1, 24), 5)
        record(folder / f"r{n}.csv", machine, time, {"u": u}, {"p": "p"}, {"p": 800 * random.normal(size=120)})
    return folder


def test_a_law_is_in_the_quantity_in_which_it_is_short(vessel: Path) -> None:
    """As a flow it is a product of two quantities, one of which has a dead zone; as an opening a dead zone alone."""
    told = fitted(load(vessel), lambda text: None)
    case, base = told.case, told.base
    locator = Locator(case, opened(case, told.amendment, case.library(), ["C", "k", "g"]), base)
    (site,) = [s for s in locator.ranked() if s.place is not None]
    assert site.place.other[0].sites[0].label == "u"
    best = next(proposals(locator, site, guide(locator, site), 1))[0].law
    assert best.site.place.label == best.site.location == "u"
    assert {v.name for v in best.references()} == {"u"}
