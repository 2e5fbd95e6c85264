"""The model led by the effort at a place, where a whole step of what is right to first order leads it astray."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lacuna.discovery.case.cases import load
from lacuna.discovery.efforts.find import places_of
from lacuna.discovery.efforts.guide import _missed, guide
from lacuna.discovery.steps import fitted

from .recorded import concealed, record

CULTURE = """model Culture "Yeast in continuous culture: it is washed out where it grows too slowly"
  parameter Real mumax(unit="1/s", min=0) = 1e-4;
  parameter Real Ks(unit="kg/m3", min=0) = 0.9;
  parameter Real Y(unit="1", min=0) = 0.48;
  input Real D(unit="1/s");
  input Real Sf(unit="kg/m3");
  Real X(unit="kg/m3", start=0.7, fixed=true);
  Real S(unit="kg/m3", start=14, fixed=true);
  Real mu(unit="1/s");
equation
  mu = mumax*S/(Ks + SINHIBITED);
  der(X) = mu*X - D*X;
  der(S) = D*(Sf - S) - mu*X/Y;
end Culture;
"""
CASE = """model = "Culture.mo"
[uncertainty]
mumax = 0.05
Ks = 0.1
Y = 0.05
[signals.D]
role = "input"
variable = "D"
unit = "1/s"
[signals.Sf]
role = "input"
variable = "Sf"
unit = "kg/m3"
[signals.X]
role = "output"
variable = "X"
unit = "kg/m3"
noise_std = 0.08
[signals.S]
role = "output"
variable = "S"
unit = "kg/m3"
noise_std = 0.08
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


def test_an_effort_that_would_starve_a_culture_leads_it_by_smaller_steps(tmp_path: Path) -> None:
    """Growth that too much substrate inhibits: the runs that it leads miss the data by noise."""
    concealing, believed = (CULTURE.replace("INHIBITED", text) for text in (" + S^2/20", ""))
    folder, machine = concealed(tmp_path, "Culture", concealing, believed, CASE)
    time, random = np.arange(0, 7e5, 600.0), np.random.default_rng(6)
    for k in (1, 2, 3):
        part = (time // 6e4).astype(int)
        inputs = {"D": random.uniform(1e-5, 6.5e-5, 12)[part], "Sf": random.uniform(12, 25, 12)[part]}
        errors = {n: 0.08 * random.normal(size=len(time)) for n in ("X", "S")}
        record(folder / f"r{k}.csv", machine, time, inputs, {"X": "X", "S": "S"}, errors)
    start = fitted(load(folder), lambda text: None)
    found = places_of(start.case, start.amendment, start.base, start.case.library())
    best = found.sites[0]
    assert best.location == "mu"
    led = guide(found.locator, best)
    acting = [[(best.place.columns[0], effort)] for effort in led.efforts]
    before = _missed(found.locator, found.locator.pieces, [[] for _ in acting])
    assert before > 20 and _missed(found.locator, led.pieces, acting) < 2
