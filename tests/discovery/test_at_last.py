"""Where the time is up before the search is done, the law that it has found by then stands, and the reader is told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.efforts import law_at
from lacuna.discovery.explain import explain
from lacuna.discovery.explanation.diagnosis import sentence
from lacuna.discovery.fit.solver.time_limit import TimeUp

from .recorded import concealed, record

TANK = """model Tank
  parameter Real A(unit="m2", min=0) = 0.02;
  parameter Real k(unit="m2/s", min=0) = 8e-4;
  input Real q(unit="m3/s");
  Real h(unit="m", start=0.5, fixed=true);
equation
  A*der(h) = q - k*h{effect};
end Tank;
"""
CASE = """title = "tank"
model = "Tank.mo"
source = "synthetic"
[uncertainty]
A = 0.02
k = 0.05
[signals.q]
role = "input"
variable = "q"
unit = "m3/s"
[signals.h]
role = "output"
variable = "h"
unit = "m"
noise_std = 2e-3
[recordings]
fit = ["r0.csv", "r1.csv"]
validate = ["r2.csv"]
"""


@pytest.fixture
def tank(tmp_path: Path) -> Path:
    folder, machine = concealed(tmp_path, "Tank", TANK.format(effect=" - 4e-4*h^3"), TANK.format(effect=""), CASE)
    time, random = np.linspace(0.0, 300.0, 601), np.random.default_rng(8)
    for k in range(3):
        q = 1e-3 * (1.5 + 1.4 * np.sin(2 * np.pi * time / (100 + 40 * k)))
        record(folder / f"r{k}.csv", machine, time, {"q": q}, {"h": "h"}, {"h": 2e-3 * random.normal(size=len(time))})
    return folder


def test_the_law_found_by_then_stands(tank: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The time is up when the first laws of one term have been fitted, and before they are compared with anything."""
    raced = []
    race = law_at.race

    def noted(*args: object) -> None:
        race(*args)
        raced.append(args)

    def stop(text: str) -> None:
        if raced and text.startswith("fitting a law"):
            raise TimeUp("the search was stopped after 1 s, before it was done")

    monkeypatch.setattr(law_at, "race", noted)
    monkeypatch.setattr(law_at.LawsAt, "settled", property(lambda self: False))
    found = explain(load(tank), stop)
    assert (found.stopped != "", found.verdict, found.reason) == (True, "missing_physics", "")
    assert [f.ranked.attachment.location for f in found.findings] == ["h"]
    assert sentence(found).endswith("The search was stopped after 1 s, before it was done.")


def test_the_best_so_far_is_told_while_laws_are_fitted(tank: Path) -> None:
    """Behind what is being done; at first errors of the sensor, at last the law that is the finding."""
    said: list[str] = []
    found = explain(load(tank), said.append)
    fitting = [text for text in said if text.startswith("fitting a law") and "; best so far " in text]
    best = list(dict.fromkeys(text.split("; best so far ")[1] for text in fitting))
    (finding,) = found.findings
    law = finding.ranked.attachment
    assert "sensor:h" in best[0] and best[-1] == law.said(finding.ranked.fit.point) and best[-1].endswith("^3 at h")
    assert said[-1].endswith(f"; best so far {best[-1]}")
