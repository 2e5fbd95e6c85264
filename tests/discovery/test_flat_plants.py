"""Plants written as equations, slow ones: what is exchanged, a coefficient that varies, a sensor behind a lag."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Case, load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.catalogue import read as read_catalogue
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.efforts.find import located
from lacuna.discovery.efforts.guide import guide
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.efforts.places.copied import copied, right_side
from lacuna.discovery.efforts.places.reading import read
from lacuna.discovery.efforts.places.sites import varying
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.fit.evidence import outside_belief
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.naming.screen import Screen, prepare
from lacuna.discovery.steps import fitted

from .recorded import record, truth

WINDING = """model Winding "Winding, stator and housing, heated by a current"
  parameter Real Cw(unit="J/K", min=0) = 116;
  parameter Real Cs(unit="J/K", min=0) = 390;
  parameter Real Ch(unit="J/K", min=0) = 620;
  parameter Real G(unit="W/K", min=0) = 1.43;
  parameter Real Gs(unit="W/K", min=0) = 2.46;
  parameter Real Ga(unit="W/K", min=0) = 0.88;
  parameter Real R(unit="Ohm", min=0) = 0.8;
  parameter Real Ta(unit="K") = 293.15;
  input Real i(unit="A");
  Real Tw(unit="K", start=293.15, fixed=true);
  Real Ts(unit="K", start=293.15, fixed=true);
  Real Th(unit="K", start=293.15, fixed=true);
  Real read(unit="K", start=293.15, fixed=true);
equation
  Cw*der(Tw) = R*i^2%s - G*(Tw - Ts);
  Cs*der(Ts) = G*(Tw - Ts) - Gs*(Ts - Th);
  Ch*der(Th) = Gs*(Ts - Th) - Ga*(Th - Ta);
  %s
end Winding;
"""
PROMPT = "read = Th;"
BELIEF = "Cw = 0.1\nCs = 0.1\nCh = 0.1\nG = 0.2\nGs = 0.2\nGa = 0.2\nR = 0.02\nTa = 0\n"
TANKS = """model Tanks "A flow into the first of two"
  parameter Real A1(unit="m2", min=0) = 0.02;
  parameter Real A2(unit="m2", min=0) = 0.03;
  parameter Real k(unit="m2/s", min=0) = 8e-4;
  input Real q(unit="m3/s");
  Real h1(unit="m", start=0.5, fixed=true);
  Real h2(unit="m", start=0.2, fixed=true);
equation
  A1*der(h1) = q - k*h1%s;
  -k*h2%s = A2*der(h2);
end Tanks;
"""
MOTOR = """model Motor "A constant that says of the torque and of the voltage what the current and the speed make"
  parameter Real R(unit="Ohm", min=0) = 0.5;
  parameter Real L(unit="H", min=0) = 8e-4;
  parameter Real k(unit="V.s/rad") = 0.06;
  parameter Real J(unit="kg.m2", min=0) = 3e-4;
  input Real u(unit="V");
  Real i(unit="A", start=0, fixed=true);
  Real w(unit="rad/s", start=0, fixed=true);
equation
  L*der(i) = u - R*i - k%s*w; // k, too
  J*der(w) = k%s*i;
end Motor;
"""


CART = """model Cart "A force on a mass that nothing brings back"
  parameter Real m(unit="kg", min=0) = 2;
  parameter Real d(unit="N.s/m", min=0) = 3;
  input Real F(unit="N");
  Real x(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
equation
  der(x) = v;
  m*der(v) = F - d*v;
end Cart;
"""


def case_of(
    folder: Path, name: str, true: str, believed: str, belief: str, quantity: tuple[str, str],
    level: tuple[float, float], outputs: Sequence[tuple[str, str, float]], interval: float,
) -> Case:  # fmt: skip
    """Three recordings of 150 samples whose input (name, unit) steps ten times between two levels; `outputs` are
    variables with their units and the noise of their readings."""
    machine = truth(folder, name, true)
    (folder / f"{name}.mo").write_text(believed, encoding="utf-8")
    random, time = np.random.default_rng(3), np.arange(150) * interval
    for n in (1, 2, 3):
        courses = {quantity[0]: np.repeat(random.uniform(*level, 10), 15)}
        errors = {v: noise * random.normal(size=150) for v, _, noise in outputs}
        record(folder / f"r{n}.csv", machine, time, courses, {v: v for v, _, _ in outputs}, errors)
    lines = [f'model = "{name}.mo"', "[uncertainty]", belief]
    lines += [f"[signals.{quantity[0]}]", 'role = "input"', f'unit = "{quantity[1]}"']
    for v, unit, noise in outputs:
        lines += [f"[signals.{v}]", 'role = "output"', f'unit = "{unit}"', f"noise_std = {noise}"]
    lines += ["[recordings]", 'fit = ["r1.csv", "r2.csv"]', 'validate = ["r3.csv"]', ""]
    (folder / "case.toml").write_text("\n".join(lines), encoding="utf-8")
    return load(folder)


def told(case: Case) -> Explanation:
    return fitted(case, lambda text: None)


def test_a_coefficient_that_varies_is_offered_where_a_fit_without_it_ran_away(tmp_path: Path) -> None:
    """The winding's resistance rises by 0.39 % each kelvin. Fitted without, its parameters leave their beliefs far
    behind, and so would a law that is looked for about that fit."""
    warm = WINDING % ("*(1 + 0.0039*(Tw - Ta))", "der(read) = (Th - read)/1e-3;")
    case = case_of(tmp_path, "Winding", warm, WINDING % ("", PROMPT), BELIEF, ("i", "A"), (0.0, 15.0),
                   [("Tw", "K", 0.5), ("Th", "K", 0.5)], 20.0)  # fmt: skip
    result = told(case)
    assert max(abs(f.centre - result.base.point[f.name]) / f.sigma for f in result.base.estimate.free) > 3.0
    locator = located(case, result.amendment, result.base, case.library())
    site = next(s for s in locator.ranked() if s.place is not None)
    assert site.location == "Tw"
    best = next(proposals(locator, site, guide(locator, site), 3))[0].law
    assert best.site.place.label == "R"
    assert {v.name for v in best.references()} == {"Tw"}


def test_what_one_balance_gains_and_another_loses_is_one_place(tmp_path: Path) -> None:
    """A pipe between two tanks of which nobody knows, one rate on the right side of its equation."""
    leak = " - 6e-4*(h1 - h2)", " + 6e-4*(h1 - h2)"
    case = case_of(tmp_path, "Tanks", TANKS % leak, TANKS % ("", ""), "A1 = 0.05\nA2 = 0.05\nk = 0.1\n",
                   ("q", "m3/s"), (0.0, 1e-3), [("h1", "m", 2e-3), ("h2", "m", 2e-3)], 5.0)  # fmt: skip
    result = told(case)
    locator = located(case, result.amendment, result.base, case.library())
    efforts = [s for s in locator.ranked() if s.place is not None]
    assert efforts[0].place.sites[0].kind == "exchange" and efforts[0].gain > efforts[1].gain + 100.0
    proposal = next(proposals(locator, efforts[0], guide(locator, efforts[0]), 1))[0]
    driving = next(v for v in proposal.law.references())
    assert (driving.name, driving.minus) == ("h1", "h2")
    assert proposal.start["c_1"] / driving.size == pytest.approx(-6e-4, rel=0.05)


def test_the_lag_of_a_sensor_starts_in_intervals_of_the_samples(tmp_path: Path) -> None:
    """The housing's thermometer follows in 60 s, three samples: no lag of milliseconds is of any use there."""
    late = WINDING % ("", "der(read) = (Th - read)/60;")
    case = case_of(tmp_path, "Winding", late, WINDING % ("", PROMPT), BELIEF, ("i", "A"), (0.0, 15.0),
                   [("Tw", "K", 0.5), ("read", "K", 0.2)], 20.0)  # fmt: skip
    result = told(case)
    every = enumerate_attachments(case, result.amendment.structure, read_catalogue(case.library()), result.amendment)
    lags = [a for a in every if a.effect.name == "SensorLag" and a.location == "sensor:read"]
    machine = Machine(case, Amendment(result.amendment.structure, lags))
    best = prepare(Screen(result.base), lags[0], machine)[0]
    assert best.predicted > 0.3
    assert 6.0 <= best.start[lags[0].full_name("T")] <= 600.0


def test_a_parameter_varies_inside_the_side_that_a_term_is_added_to(tmp_path: Path) -> None:
    """In whichever order both were found, and where the parameter is the last word of the equation."""
    path = tmp_path / "Motor.mo"
    path.write_text(MOTOR.replace("k%s*i;", "i*k;") % "", encoding="utf-8")
    sites = read(Library([str(path)]), "Motor")
    (k,) = varying(sites.places, {"k": 2})
    assert not varying(sites.places, {"k": 3})  # a third one would not vary with them
    torque = next(s for s in sites.places if s.label.startswith("J*der(w)"))
    for edits in ([(k, "varies"), (torque, "acts")], [(torque, "acts"), (k, "varies")]):
        _, lines = copied(sites.cls, edits)
        assert "    J*der(w) = ( i*(k + varies)) + acts;" in lines


def test_a_parameter_that_varies_is_one_place_in_all_its_equations(tmp_path: Path) -> None:
    """A motor constant that falls with the current, in the voltage and in the torque alike."""
    falls = "/(1 + (i/15)^2)"
    belief = "R = 0.03\nL = 0.1\nk = 0.03\nJ = 0.1\n"
    case = case_of(tmp_path, "Motor", MOTOR % (falls, falls), MOTOR % ("", ""), belief,
                   ("u", "V"), (-8.0, 8.0), [("i", "A", 0.05), ("w", "rad/s", 0.5)], 1e-3)  # fmt: skip
    result = told(case)
    locator = located(case, result.amendment, result.base, case.library())
    site = next(s for s in locator.ranked() if s.place is not None)
    assert (site.location, site.place.unit) == ("k", "V.s/rad")
    best = next(proposals(locator, site, guide(locator, site), 1))[0]
    assert {v.name for v in best.law.references()} == {"i"}
    assert best.law.form(best.start) == "motor.saturation"


def test_the_right_side_of_an_equation() -> None:
    for text, expected in (
        ("a = b + c;", " b + c"),
        ('a*der(x) = if u >= 1 then f(x=2) else 3 "why; so" annotation(Icon());', " if u >= 1 then f(x=2) else 3 "),
        ("v = // = no\n  der(x);", " // = no\n  der(x)"),
    ):
        side, end = right_side(text, 0)
        assert text[side:end] == expected


def test_a_recorded_state_is_known_within_the_noise_of_its_first_sample(tmp_path: Path) -> None:
    """Two sigmas of the first sample of a position would stay to the end, two of a speed for most of it: nothing of
    that is physics, or a parameter."""
    case_of(tmp_path, "Cart", CART, CART, "m = 0.05\nd = 0.05\n", ("F", "N"), (-4.0, 4.0),
            [("x", "m", 0.02), ("v", "m/s", 0.05)], 0.02)  # fmt: skip
    table = np.genfromtxt(tmp_path / "r1.csv", delimiter=",", names=True)
    table["x"][0], table["v"][0] = 0.04, 0.1
    np.savetxt(tmp_path / "r1.csv", table, "%.8g", ",", header=",".join(table.dtype.names), comments="")
    text = (tmp_path / "case.toml").read_text(encoding="utf-8")
    (tmp_path / "case.toml").write_text('initial = {x = "recorded", v = "recorded"}\n' + text, encoding="utf-8")
    result = told(load(tmp_path))
    assert max(result.base.level.values()) < 1.12  # three standard errors of the RMS of 300 samples
    starts = {f.name: result.base.point[f.name] for f in result.base.estimate.free if f.name.startswith("start:")}
    assert set(starts) == {f"start:{s}@r{n}.csv" for s in "xv" for n in (1, 2)}
    assert abs(starts["start:x@r1.csv"]) < 0.01 and abs(starts["start:v@r1.csv"]) < 0.05
    assert outside_belief(result.base) == {}
