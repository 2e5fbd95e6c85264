"""Machines that are made of a library's parts: what such a part is may vary, and its equations may lack a term."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model, translate
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.searched import believed_structure
from lacuna.discovery.efforts.places import openable as opening
from lacuna.discovery.efforts.places.openable import RIGID
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.explain import explain, write_amended
from lacuna.discovery.law.terms.courses import evaluate
from lacuna.runtime import Model

from .recorded import record, truth

PARTS = """package Parts "Nobody's own"
  connector Pin
    Real v(unit="V");
    flow Real i(unit="A");
  end Pin;
  connector Flange
    Real s(unit="m");
    flow Real f(unit="N");
  end Flange;
  package Interfaces
    partial model TwoPin
      Pin p, n;
      Real v(unit="V"), i(unit="A");
    equation
      v = p.v - n.v;
      i = p.i;
      p.i + n.i = 0;
    end TwoPin;
  end Interfaces;
  model Source
    extends Interfaces.TwoPin;
    input Real u(unit="V");
  equation
    v = u;
  end Source;
  model Winding
    extends Interfaces.TwoPin(i(start=0, fixed=true));
    parameter Real R(unit="Ohm") = 5, L(unit="H") = 4e-4;
  equation
    L*der(i) = v - R*i;
  end Winding;
  model Ground
    Pin p;
  equation
    p.v = 0;
  end Ground;
  model Coil "In the gap of a magnet"
    extends Interfaces.TwoPin;
    Flange flange;
    parameter Real k(unit="N/A") = 7;
  equation
    v = {k}*der(flange.s);
    flange.f = -{k}*i;
  end Coil;
  model Cone
    Flange a, b;
    parameter Real m(unit="kg") = 0.02;
    Real s(unit="m", start=0, fixed=true), v(unit="m/s", start=0, fixed=true);
  equation
    a.s = s;
    b.s = s;
    v = der(s);
    m*der(v) = a.f + b.f;
  end Cone;
  model Suspension
    Flange a;
    parameter Real c(unit="N/m") = 4000, d(unit="N.s/m") = 1.2;
    Real f(unit="N");
  equation
    f = c*a.s + d*der(a.s){more};
    a.f = f;
  end Suspension;
end Parts;
"""
WOOFER = """model Woofer
  parameter Real k(unit="N/A", min=0) = 7, c(unit="N/m", min=0) = 4000, d(unit="N.s/m", min=0) = 1.2;
  input Real u(unit="V");
  Parts.Source amplifier(u=u);
  Parts.Winding winding;
  Parts.Coil coil(k=k);
  Parts.Ground ground;
  Parts.Cone cone;
  Parts.Suspension suspension(c=c, d=d);
equation
  connect(amplifier.p, winding.p);
  connect(winding.n, coil.p);
  connect(coil.n, amplifier.n);
  connect(amplifier.n, ground.p);
  connect(coil.flange, cone.a);
  connect(cone.b, suspension.a);
end Woofer;
"""
CASE = """model = "Woofer.mo"
libraries = ["lib/Parts.mo"]
[parameters]
k = 7
c = 4000
d = 1.2
[uncertainty]
k = 0.05
c = 0.1
d = 0.2
[signals.u]
role = "input"
variable = "u"
unit = "V"
[signals.i]
role = "output"
variable = "winding.i"
unit = "A"
noise_std = 0.01
[signals.x]
role = "output"
variable = "cone.s"
unit = "m"
noise_std = 2e-5
[signals.f]
role = "output"
variable = "suspension.f"
unit = "N"
noise_std = 0.1
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


@pytest.fixture
def woofer(tmp_path: Path) -> Callable[..., Path]:
    """A case of a loudspeaker of a library's parts, of which one is really otherwise."""

    def made(k: str = "k", more: str = "") -> Path:
        folder = tmp_path / "case"
        (folder / "lib").mkdir(parents=True)
        believed, real = (PARTS.replace("{k}", x).replace("{more}", y) for x, y in (("k", ""), (k, more)))
        (folder / "lib" / "Parts.mo").write_text(believed)
        (folder / "Woofer.mo").write_text(WOOFER)
        (folder / "case.toml").write_text(CASE)
        within = real.replace("end Parts;", WOOFER.replace("Parts.", "") + "end Parts;")
        machine = truth(tmp_path, "Parts", within, "Parts.Woofer")
        random, time = np.random.default_rng(3), 2.5e-4 * np.arange(2000)
        for n, size in enumerate((18.0, 10.0, 14.0), 1):
            sweep = size * np.sin(2 * np.pi * (20 + 40 * n * time) * time) + 0.3 * size * np.repeat(
                random.uniform(-1, 1, 20), 100
            )
            errors = {c: s * random.normal(size=2000) for c, s in (("i", 0.01), ("x", 2e-5), ("f", 0.1))}
            outputs = {"i": "winding.i", "x": "cone.s", "f": "suspension.f"}
            record(folder / f"r{n}.csv", machine, time, {"u": sweep}, outputs, errors)
        return folder

    return made


def test_equations_in_which_a_parameter_stands_are_open_and_those_that_only_join_are_not(
    woofer: Callable[..., Path],
) -> None:
    case = load(woofer())
    library = case.library()
    door = opened(case, Amendment(believed_structure(case, library)), library, [])
    inside = {s.label for s in door.sites if s.kind == "equation"}
    assert {"winding: L*der(i) = v - R*i", "cone: m*der(v) = a.f + b.f"} <= inside
    assert {"suspension: f = c*a.s + d*der(a.s)", "coil: flange.f = -k*i"} <= inside
    assert not any(label.startswith(("cone: a.s", "suspension: a.f", "ground")) for label in inside)
    vary = {s.label: len(s.parts) for s in door.sites if s.kind == "parameter"}
    assert vary == {"winding.R": 1, "winding.L": 1, "coil.k": 2, "cone.m": 1, "suspension.c": 1, "suspension.d": 1}
    assert dict(door.closed)["coil.flange to cone.a"] == RIGID


def test_what_is_rigid_is_left_out_at_once(woofer: Callable[..., Path], monkeypatch: pytest.MonkeyPatch) -> None:
    """Places of a machine of many parts are looked at in one model, not each by itself."""
    case, translated = load(woofer()), []
    library = case.library()

    def counted(*args: object, **kwargs: object) -> object:
        translated.append(args)
        return translate(*args, **kwargs)

    monkeypatch.setattr(opening, "translate", counted)
    door = opened(case, Amendment(believed_structure(case, library)), library, [])
    rigid = [label for label, why in door.closed if why == RIGID]
    assert len(rigid) > 1 and len(translated) == 2  # with all, and without these


def test_a_force_factor_that_falls_with_the_way_is_one_law_of_one_parameter(
    woofer: Callable[..., Path], tmp_path: Path
) -> None:
    """In the force and in the voltage at once: two laws at two places would say it, too."""
    result = explain(load(woofer(k="k*(1 - 2e4*flange.s^2)")))
    (finding,) = result.findings
    assert finding.ranked.attachment.location == "coil.k"
    law, values = finding.ranked.attachment.law, finding.ranked.attachment.own_values(result.final.point)
    (way,) = law.references()
    x = np.linspace(-0.9, 0.9, 50) * way.size
    path = {way.local: x, "time": x}
    texts = (text.format(**{s: values[n] for s, n in shapes.items()}) for _, text, shapes in law.numbered())
    lost = sum(values[f"c_{n}"] * evaluate(text, path, {way.local: way.size}) for n, text in enumerate(texts, 1))
    np.testing.assert_allclose(lost, -7 * 2e4 * x**2, atol=0.02 * 7 * 2e4 * np.max(x**2))
    amended = write_amended(result, tmp_path)
    assert Model(compile_model(str(amended), search_path=result.case.search_path).path).variables["coil.v"]


def test_a_spring_whose_force_is_recorded_stiffens_where_that_is_read(woofer: Callable[..., Path]) -> None:
    """Beside it nothing would be read of what it pulls more."""
    result = explain(load(woofer(more=" + 2e8*a.s^3")))
    (finding,) = result.findings
    assert finding.ranked.attachment.location == "suspension.f"
    assert finding.ranked.attachment.law.form({"p_1": 3.0}) == "stiffness.hardening"
    (way,) = finding.ranked.attachment.law.references()
    assert result.final.point["law_suspension_f.c_1"] / way.size**3 == pytest.approx(2e8, rel=0.03)
