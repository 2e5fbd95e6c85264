"""A signal that arrives late, where it is a state that is sent."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lacuna.discovery.case.cases import load
from lacuna.discovery.efforts.find import places_of
from lacuna.discovery.efforts.guide import guide
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.steps import fitted

from .recorded import concealed, record

LOOP = """package Tempering
  connector In = input Real(unit="K");
  connector Out = output Real(unit="K");
  model Unit
    In back;
    Out flow_;
    parameter Real C(unit="J/K", min=0) = 4e4;
    input Real P(unit="W");
    Real T(unit="K", start=294, fixed=true);
  equation
    flow_ = T;
    C*der(T) = P - 12*(T - 294) - 600*(T - back);
  end Unit;
  model Mould
    In flow_;
    Out back;
    parameter Real C(unit="J/K", min=0) = 9e4;
    Real T(unit="K", start=294, fixed=true);
    Real Q(unit="W");
  equation
    Q = 360*(LATE - T);
    back = LATE - Q/600;
    C*der(T) = Q - 60*(T - 294);
  end Mould;
  model Loop
    input Real P(unit="W");
    Unit unit;
    Mould mould;
  equation
    unit.P = P;
    connect(unit.flow_, mould.flow_);
    connect(mould.back, unit.back);
  end Loop;
end Tempering;
"""
CASE = """model = "Tempering.mo:Tempering.Loop"
[uncertainty]
"unit.C" = 0.05
"mould.C" = 0.05
[signals.P]
role = "input"
variable = "P"
unit = "W"
[signals.Tu]
role = "output"
variable = "unit.T"
unit = "K"
noise_std = 0.05
[signals.Tm]
role = "output"
variable = "mould.T"
unit = "K"
noise_std = 0.05
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


def test_a_state_that_goes_into_another_component_may_arrive_late(tmp_path: Path) -> None:
    texts = (LOOP.replace("LATE", text) for text in ("delay(flow_, 24)", "flow_"))
    folder, machine = concealed(tmp_path, "Tempering", *texts, CASE, cls="Tempering.Loop")
    time, random = np.arange(0, 1500, 2.0), np.random.default_rng(5)
    for k in (1, 2, 3):
        power = 9000 * random.integers(0, 2, 15)[(time // 100).astype(int)]
        errors = {n: 0.05 * random.normal(size=len(time)) for n in ("Tu", "Tm")}
        record(folder / f"r{k}.csv", machine, time, {"P": power}, {"Tu": "unit.T", "Tm": "mould.T"}, errors)
    start = fitted(load(folder), lambda text: None)
    found = places_of(start.case, start.amendment, start.base, start.case.library())
    site = next(s for s in found.sites if s.place is not None and s.place.sites[0].kind == "signal")
    assert site.location == "mould"
    assert {"unit.C", "mould.C"} <= {s.label for s in found.locator.opened.sites if s.kind == "parameter"}
    laws = next(proposals(found.locator, site, guide(found.locator, site), 3))
    assert any("delay(" in p.law.text() and {v.name for v in p.law.references()} == {"unit.T"} for p in laws)
