"""What an effort at a place changes at once, by what stands in which equation: rounding reaches anything."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lacuna.discovery.case.cases import load
from lacuna.discovery.efforts.find import places_of
from lacuna.discovery.efforts.guide import guide
from lacuna.discovery.efforts.laws.offered import offered_at, unknowns
from lacuna.discovery.steps import fitted

from .recorded import concealed, record

LEG = """model Leg "A gas spring between two bodies"
  parameter Real M(unit="kg", min=0) = 2200;
  parameter Real m(unit="kg", min=0) = 90;
  parameter Real d(unit="N.s/m", min=0) = 9000;
  input Real u(unit="N");
  Real upper(unit="m", start=0, fixed=true);
  Real w(unit="m/s", start=0, fixed=true);
  Real lower(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
  Real y(unit="m");
  Real vy(unit="m/s");
  Real gas(unit="N");
  Real f(unit="N");
equation
  y = lower - upper;
  vy = der(y);
  gas = 20000*(1/(1 - y/0.35)^1.2 - 1);
  f = gas + d*vyRUBS;
  der(upper) = w;
  der(lower) = v;
  M*der(w) = f - u;
  m*der(v) = -f - 6e4*lower - 900*v;
end Leg;
"""
CASE = """model = "Leg.mo"
[parameters]
d = 9000
[uncertainty]
d = 0.1
M = 0
m = 0
[signals.u]
role = "input"
variable = "u"
unit = "N"
[signals.y]
role = "output"
variable = "y"
unit = "m"
noise_std = 1e-4
[signals.upper]
role = "output"
variable = "upper"
unit = "m"
noise_std = 1e-4
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


def test_a_law_may_be_of_what_stands_upstream_of_the_effort(tmp_path: Path) -> None:
    """Friction in the force: stroke and gas do not answer to it, and the equation that is amended is that of the force
    rather than that of the gas, in which an effort does the same."""
    concealing = LEG.replace("RUBS", " + 0.08*(20000 + gas)*tanh(vy/0.01)")
    folder, machine = concealed(tmp_path, "Leg", concealing, LEG.replace("RUBS", ""), CASE)
    time, random = np.arange(600) * 5e-3, np.random.default_rng(4)
    for k in (1, 2, 3):
        u = 9000 * np.sin(3.0 * k * time) + 5000 * np.sin(11 * time + k) + 6000
        errors = {n: 1e-4 * random.normal(size=len(time)) for n in ("y", "upper")}
        record(folder / f"r{k}.csv", machine, time, {"u": u}, {"y": "y", "upper": "upper"}, errors)
    start = fitted(load(folder), lambda text: None)
    found = places_of(start.case, start.amendment, start.base, start.case.library())
    locator = found.locator
    site = next(s for s in found.sites if s.place is not None and any("gas" in p.label for p in s.place.sites))
    assert site.place.sites[0].label.startswith("f = ")
    along = locator.pieces[0].along
    changed = {n for k, n in enumerate(unknowns(locator)) if along.answering[k, site.place.columns[0]]}
    assert changed == {"f", "der(w)", "der(v)"}
    regression, _ = offered_at(locator, site.place, guide(locator, site))
    assert {"gas", "vy", "y"} <= {v.reading for v in regression.place.variables}


def test_what_is_protected_in_a_component_is_no_variable_of_a_law(tmp_path: Path) -> None:
    """No amended model could read it."""
    protected = (
        LEG.replace("model Leg", "model Strut").replace("end Leg;", "end Strut;").replace("  input Real u", "  Real u")
    )
    protected = protected.replace("  Real gas", "protected\n  Real gas")
    outer = 'model Leg\n  input Real u(unit="N");\n  Strut strut(u=u);\nend Leg;\n'
    case = CASE.replace('"Leg.mo"', '"Leg.mo:Leg"').replace('"y"\nunit', '"strut.y"\nunit')
    case = case.replace('"upper"\nunit', '"strut.upper"\nunit').replace("\nd = ", '\n"strut.d" = ')
    case = case.replace("\nM = ", '\n"strut.M" = ').replace("\nm = ", '\n"strut.m" = ')
    text = protected.replace("RUBS", "") + outer
    folder, machine = concealed(tmp_path, "Leg", text, text, case, cls="Leg")
    time = np.arange(300) * 5e-3
    for k in (1, 2, 3):
        u = 9000 * np.sin(3.0 * k * time) + 6000
        record(folder / f"r{k}.csv", machine, time, {"u": u}, {"y": "strut.y", "upper": "strut.upper"},
               {n: 1e-4 * np.cos(np.arange(300) + k) for n in ("y", "upper")})  # fmt: skip
    start = fitted(load(folder), lambda text: None)
    found = places_of(start.case, start.amendment, start.base, start.case.library())
    site = next(s for s in found.sites if s.place is not None)
    regression, _ = offered_at(found.locator, site.place, guide(found.locator, site))
    read = {v.reading for v in regression.place.variables}
    assert "strut.y" in read and not any("strut.gas" in r or "strut.f" in r for r in read)
