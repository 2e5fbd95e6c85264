"""An input as it acts: late, in proportion, told as what was commanded and not as the balance that it drives."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import Case, load
from lacuna.discovery.efforts.guide import guide
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.efforts.located import Locator
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.law.empirical_law import fitted_law, race, unfitted
from lacuna.discovery.steps import fitted

from .recorded import record, truth

PLATE = """model Plate "Heated, on a wall"
  parameter Real C(unit="J/K", min=0) = 80;
  parameter Real G(unit="W/K", min=0) = 2;
  input Real P(unit="W");
  Real T(unit="K", start=300, fixed=true);
equation
  C*der(T) = P - G*(T - 300);
end Plate;
"""
CASE = """model = "Plate.mo"
[uncertainty]
C = 0.05
G = 0.05
[signals.P]
role = "input"
unit = "W"
[signals.T]
role = "output"
unit = "K"
noise_std = 0.2
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""
LATE, INTERVAL = 13.0, 2.0


@pytest.fixture(scope="module")
def plate(tmp_path_factory: pytest.TempPathFactory) -> Case:
    """A heater that does what it was told 13 s ago; the recordings begin at rest, as it is told to heat."""
    folder = tmp_path_factory.mktemp("plate")
    machine = truth(folder, "Plate", PLATE)
    (folder / "Plate.mo").write_text(PLATE, encoding="utf-8")
    (folder / "case.toml").write_text(CASE, encoding="utf-8")
    random, time = np.random.default_rng(3), np.arange(120) * INTERVAL
    for n in (1, 2, 3):
        told = np.interp(time, time[::12], random.uniform(50, 250, 10))
        acts = np.where(time >= LATE, np.interp(time - LATE, time, told), 0.0)
        file = folder / f"r{n}.csv"
        record(file, machine, time, {"P": acts}, {"T": "T"}, {"T": 0.2 * random.normal(size=120)})
        rows = np.genfromtxt(file, delimiter=",", names=True)
        np.savetxt(file, np.column_stack([time, told, rows["T"]]), delimiter=",", header="time,P,T", comments="")
    return load(folder)


def test_a_late_input_is_told_as_one(plate: Case) -> None:
    told = fitted(plate, lambda text: None)
    locator = Locator(plate, opened(plate, told.amendment, plate.library(), ["C", "G"]), told.base)
    site = next(s for s in locator.ranked() if s.place is not None)
    assert site.place.named("P") and site.place.named("T")
    guided = guide(locator, site)
    best, *others = next(proposals(locator, site, guided, 3))
    assert not any("delay(" in p.law.text() or "onset(" in p.law.text() for p in others)
    assert best.law.site.location == "P"
    found, *outdone = laws = [
        unfitted(plate, told.amendment, told.base, p.law, p.start, guided.point) for p in (best, *others)
    ]
    race(plate, told.base, laws, None)
    wholes = [fitted_law(plate, told.amendment, told.base, p.law, p.start, guided.point) for p in others]
    assert all(whole.fit.deviance() > 2 * found.fit.deviance() for whole in wholes)
    # The others were left where they were: they could not win any more.
    assert sum(law.fit.simulations for law in outdone) < sum(whole.fit.simulations for whole in wholes) / 2
    values = {n.rpartition(".")[2]: v for n, v in found.fit.point.items()}
    assert best.law.form(values) == "drive.delay"
    assert values["t_1"] == pytest.approx(LATE, abs=0.3)
    assert found.fit.level["T"] < 1.1


def test_an_input_that_is_read_elsewhere_is_said_to_be_closed(plate: Case, tmp_path: Path) -> None:
    text = PLATE.replace("equation\n", '  Real P2(unit="W") = 2*P;\nequation\n').replace("= P -", "= P2 - P -")
    (tmp_path / "Plate.mo").write_text(text, encoding="utf-8")
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    for file in plate.folder.glob("r*.csv"):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    case = load(tmp_path)
    door = opened(case, fitted(case, lambda text: None).amendment, case.library(), ["C", "G"])
    assert ("P", "it is read elsewhere than in equations of the class") in door.closed
    assert "input" not in {site.kind for site in door.sites}
