"""A machine that slips out of phase: the sum of squares has a dip for every period that it may be off by."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.signal import cont2discrete

from lacuna.discovery.case.cases import load
from lacuna.discovery.case.gaps import in_pieces
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.efforts.find import places_of
from lacuna.discovery.efforts.instruments import locator_of
from lacuna.discovery.explain import explain
from lacuna.discovery.fit.evidence import astray
from lacuna.discovery.fit.fit import believed, fit
from lacuna.discovery.fit.lead import fit_believed, joined
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import noise_of

MASS = """model Mass "On a spring, pushed"
  parameter Real m(unit="kg", min=0) = 2;
  parameter Real k(unit="N/m", min=0) = 800;
  parameter Real d(unit="N.s/m", min=0) = 0.8;
  input Real F(unit="N");
  Real x(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
equation
  der(x) = v;
  m*der(v) = F - k*x - d*v;
end Mass;
"""
STIFFER = 990.0  # N/m: five times what is believed of its error


@pytest.fixture(scope="module")
def mass(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Sixty periods of a mass on a spring a quarter stiffer than believed, pushed in steps, in closed form."""
    folder, random, interval, noise = tmp_path_factory.mktemp("mass"), np.random.default_rng(8), 0.02, 2e-4
    (folder / "Mass.mo").write_text(MASS)
    model = np.array([[0.0, 1.0], [-STIFFER / 2, -0.4]]), np.array([[0.0], [0.5]]), np.eye(2), np.zeros((2, 1))
    step, drive, *_ = cont2discrete(model, interval)
    for name in ("r1", "r2", "r3"):
        push, state, rows = np.repeat(random.uniform(-10.0, 10.0, 12), 84), np.zeros(2), []
        for number, force in enumerate(push):
            rows.append((number * interval, force, state[0] + random.normal(0.0, noise)))
            state = step @ state + drive[:, 0] * force
        np.savetxt(folder / f"{name}.csv", rows, "%.8g", ",", header="time,F,x", comments="")
    (folder / "case.toml").write_text(
        'model = "Mass.mo"\n[signals.F]\nrole = "input"\nvariable = "F"\nunit = "N"\ninterpolation = "hold"\n'
        '[signals.x]\nrole = "output"\nvariable = "x"\nunit = "m"\n'
        '[recordings]\nfit = ["r1.csv", "r2.csv"]\nvalidate = ["r3.csv"]\n'
    )
    return folder


def test_pieces_that_are_joined_lead_to_where_a_whole_run_does_not(mass: Path) -> None:
    case = load(mass)
    machine = Machine(case, Amendment(read(case.library(), case.base)))
    free, fixed = believed(case, machine)
    assert astray(fit(machine, case.fit, noise_of(case), free, fixed))  # in a dip
    found = joined(machine, case, noise_of(case), free, fixed)
    assert max(found.level.values()) < 1.05
    assert found.point["k"] / found.point["m"] == pytest.approx(STIFFER / 2, rel=1e-3)


def test_a_stiffness_that_is_off_is_no_missing_physics(mass: Path) -> None:
    found = explain(load(mass))
    assert (found.verdict, found.findings) == ("parameters", [])


def test_pieces_are_driven_as_the_whole_is(mass: Path) -> None:
    """An input is written where it changes only: a piece knows what it was before."""
    case = load(mass)
    for recording in case.fit:
        column = recording.columns["F"]
        column[1:][np.diff(column) == 0.0] = np.nan
    pieces = in_pieces(case, 8).fit
    whole = case.fit[0]
    assert [len(p.time) for p in pieces[:8]] == [126] * 8
    assert [p.after_gap for p in pieces[:9]] == [False] + [True] * 7 + [False]
    assert pieces[0].piece == whole.piece and len({p.piece for p in pieces}) == len(pieces)
    kept = np.isfinite(whole.columns["F"])
    held = whole.columns["F"][kept][np.searchsorted(whole.time[kept], whole.time, side="right") - 1]
    for number, piece in enumerate(pieces[:8]):
        time, values = piece.drive("F")
        here = values[np.searchsorted(time, piece.time, side="right") - 1]
        assert np.array_equal(here, held[126 * number : 126 * (number + 1)])


def test_a_machine_without_states_begins_nowhere(tmp_path: Path) -> None:
    (tmp_path / "Resistor.mo").write_text(
        'model Resistor\n  parameter Real R(unit="Ohm") = 2;\n  input Real i(unit="A");\n  Real u(unit="V");\n'
        "equation\n  u = R*i;\nend Resistor;\n"
    )
    (tmp_path / "case.toml").write_text(
        'model = "Resistor.mo"\n[signals.i]\nrole = "input"\nvariable = "i"\nunit = "A"\n'
        '[signals.u]\nrole = "output"\nvariable = "u"\nunit = "V"\nnoise_std = 0.01\n'
        '[recordings]\nfit = ["r1.csv"]\nvalidate = ["r2.csv"]\n'
    )
    random, time = np.random.default_rng(2), 0.01 * np.arange(400)
    for name in ("r1", "r2"):
        current = np.sin(3.0 * time) + random.normal(0.0, 0.1)
        table = np.column_stack([time, current, 2.0 * current + current**3 + random.normal(0.0, 0.01, 400)])
        np.savetxt(tmp_path / f"{name}.csv", table, "%.8g", ",", header="time,i,u", comments="")
    case = load(tmp_path)
    machine = Machine(case, Amendment(read(case.library(), case.base)))
    found = fit_believed(case, machine)[0]
    assert astray(found)
    where = places_of(case, machine.amendment, found, case.library())
    assert not where.sites and "no state" in where.reason
    assert locator_of(case, machine.amendment, found) is None
