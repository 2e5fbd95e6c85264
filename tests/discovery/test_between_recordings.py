"""Laws that go with what differs between recordings, and a signal that is late as a whole."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read as read_structure
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.explain import explain
from lacuna.discovery.explanation.drawn_laws import _drawn
from lacuna.discovery.law.law import law_at

from .recorded import record, truth

SLED = """model Sled "Carries another load in each recording"
  parameter Real m(unit="kg", min=0) = {m};
  parameter Real d(unit="N.s/m", min=0) = 3;
  input Real F(unit="N");
  Real v(unit="m/s", start=0, fixed=true);
equation
  m*der(v) = F - d*v{more};
end Sled;
"""
LOADS = {"r1": 2.0, "r2": 5.0, "r3": 9.0, "r4": 3.5}


@pytest.fixture(scope="module")
def sleds(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A drag of the runners that goes with the load: 0.4 N.s2/m2 of each kilogram."""
    folder = tmp_path_factory.mktemp("sleds")
    (folder / "Sled.mo").write_text(SLED.format(m=2, more=""))
    random, time = np.random.default_rng(8), np.arange(0.0, 30.0, 0.05)
    own = ""
    for name, m in LOADS.items():
        force = 4 * m * np.repeat(random.uniform(-1, 1, 20), 30)
        machine = truth(folder / name, "Sled", SLED.format(m=m, more=" - 0.4*m*v*abs(v)"))
        record(folder / f"{name}.csv", machine, time, {"F": force}, {"v": "v"}, {"v": random.normal(0, 0.01, 600)})
        own += f'[recording."{name}.csv"]\nparameters = {{m = {m}}}\nuncertainty = {{m = 0.0}}\n'
    (folder / "case.toml").write_text(
        'model = "Sled.mo"\n[uncertainty]\nd = 0.2\n[signals.F]\nrole = "input"\nvariable = "F"\nunit = "N"\n'
        '[signals.v]\nrole = "output"\nvariable = "v"\nunit = "m/s"\nnoise_std = 0.01\n'
        f'[recordings]\nfit = ["r1.csv", "r2.csv", "r3.csv"]\nvalidate = ["r4.csv"]\n{own}'
    )
    return folder


def test_a_recording_is_linearised_about_its_own_parameters(sleds: Path) -> None:
    """The speed to a constant force: (1 - exp(-d t / m)) / d, m that of the recording (it was that of the first)."""
    case = load(sleds)
    door = opened(case, Amendment(read_structure(case.library(), case.base)), case.library(), ["d"])
    place = next(k for k, s in enumerate(door.sites) if s.kind == "equation")
    for recording in case.fit:
        m = LOADS[recording.name.removesuffix(".csv")]
        along = door.linear.along({"d": 3.0, f"m@{recording.name}": m}, recording)
        answer = along.response(np.array([place]), np.ones((len(recording.time), 1)))[:, 0, 0]
        np.testing.assert_allclose(answer, (1 - np.exp(-3 * recording.time / m)) / 3, atol=1e-6)


def test_a_drag_that_goes_with_the_load_is_found_and_drawn(sleds: Path) -> None:
    found = explain(load(sleds))
    assert found.verdict == "missing_physics", found.reason
    (finding,) = found.findings
    assert finding.ranked.attachment.location == "v"
    law = law_at(finding.ranked.attachment, found.final.point)
    for m in (2.0, 9.0):
        said = eval(law.replace("^", "**"), {"sign": np.sign, "abs": np.abs, "v": 1.5, "m": m})
        assert said == pytest.approx(-0.4 * m * 1.5**2, rel=0.05), law
    (drawn,) = _drawn(found, found.opened.locator, found.findings)
    assert drawn.unit == "N" and drawn.variable == "v  (m/s)"
    off = (drawn.law - drawn.effort) / drawn.error
    assert np.mean(np.abs(off) < 2) > 0.9  # the band is that of an effort of any course
    assert np.std(drawn.error) < 0.2 * np.std(drawn.law)  # and tells the law from none


LAGGING = """model Lagging "A stage that is slow"
  parameter Real K(unit="1") = 2;
  parameter Real T(unit="s", min=0) = 0.5;
  input Real u(unit="V");
  Real y(unit="V", start=0, fixed=true);
equation
  T*der(y) = K*u - y;
end Lagging;
"""


def test_a_late_command_is_not_told_from_a_late_sensor(tmp_path: Path) -> None:
    """In a linear chain from rest: how much of the command is late is no number that could speak against it."""
    (tmp_path / "Lagging.mo").write_text(LAGGING)
    machine, random = truth(tmp_path / "machine", "Lagging", LAGGING), np.random.default_rng(2)
    time = np.arange(0.0, 40.0, 0.02)
    for name in ("r1", "r2", "r3"):
        steps = np.repeat(random.uniform(-1, 1, 40), 50)
        steps[:50] = 0.0
        file, none = tmp_path / f"{name}.csv", np.zeros(len(time))
        record(file, machine, time, {"u": steps}, {"y": "y"}, {"y": none})
        rows = np.loadtxt(file, delimiter=",", skiprows=1)
        rows[:, 2] = np.interp(time - 0.2, time, rows[:, 2]) + random.normal(0, 0.01, len(time))
        np.savetxt(file, rows, "%.8g", ",", header="time,u,y", comments="")
    (tmp_path / "case.toml").write_text(
        'model = "Lagging.mo"\n[uncertainty]\nK = 0.05\nT = 0.1\n'
        '[signals.u]\nrole = "input"\nvariable = "u"\nunit = "V"\n'
        '[signals.y]\nrole = "output"\nvariable = "y"\nunit = "V"\nnoise_std = 0.01\n'
        '[recordings]\nfit = ["r1.csv", "r2.csv"]\nvalidate = ["r3.csv"]\n'
    )
    found = explain(load(tmp_path))
    assert found.verdict == "undetermined"
    assert "at u explains as much" in found.reason and "sensor" in found.reason
