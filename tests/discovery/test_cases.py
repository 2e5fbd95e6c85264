"""Reading cases: SI units, and a clear refusal of what cannot be read."""

from __future__ import annotations

from pathlib import Path
import re
import shutil

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.searched import believed_structure
from lacuna.discovery.experiment.limits import ranges
from lacuna.discovery.experiment.waveforms import waveforms
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.steps import fitted
from lacuna.recorded_units import UnitError, to_si


def test_units_lead_to_si() -> None:
    assert to_si("deg") == (pytest.approx(np.pi / 180), "rad")
    assert to_si("mA") == (1e-3, "A")
    assert to_si("N.m.s/rad") == (1.0, "N.m.s/rad")
    assert to_si("rpm") == (pytest.approx(np.pi / 30), "rad/s")
    assert to_si("bar") == (1e5, "Pa")
    assert to_si("l/min") == (pytest.approx(1e-3 / 60), "m3/s")
    assert to_si("kN") == (1e3, "N")
    assert to_si("W/(m2.K)") == (1.0, "W/(m2.K)")
    with pytest.raises(UnitError, match="furlong"):
        to_si("furlong")


def test_a_case_is_read_in_si(consistent_case: Path) -> None:
    case = load(consistent_case)
    assert [s.column for s in case.outputs] == ["i", "theta"]
    assert case.fit[0].interval == pytest.approx(1e-3)
    assert case.sigma("R", 3.5) == pytest.approx(0.105)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('unit = "A"', "", r"signals\.i\] has no unit"),
        ('unit = "A"', 'unit = "bananas"', "bananas"),
        ('role = "input"', 'role = "inputt"', "inputt"),
        ("[signals.i]", "[signals.current]", "column `current` is missing"),
    ],
)
def test_slips_in_the_description_are_named(
    consistent_case: Path, tmp_path: Path, old: str, new: str, message: str
) -> None:
    for file in consistent_case.iterdir():
        if file.suffix in (".csv", ".toml"):
            text = file.read_text()
            (tmp_path / file.name).write_text(text.replace(old, new, 1) if file.suffix == ".toml" else text)
    with pytest.raises(CaseError, match=message):
        load(tmp_path)


def test_a_value_that_no_quantity_has_is_refused(consistent_case: Path, tmp_path: Path) -> None:
    """Its square is infinite, and what was made of it, an overflow."""
    shutil.copytree(consistent_case, tmp_path / "case")
    file = next((tmp_path / "case").glob("*.csv"))
    head, first, *rows = file.read_text().splitlines()
    fields = ["1e200" if name == "i" else value for name, value in zip(head.split(","), first.split(","), strict=True)]
    file.write_text("\n".join([head, ",".join(fields), *rows]) + "\n")
    with pytest.raises(CaseError, match="column `i` has a value beyond 1e"):
        load(tmp_path / "case")


def test_a_model_that_does_not_run_with_what_is_believed_is_said(consistent_case: Path, tmp_path: Path) -> None:
    shutil.copytree(consistent_case, tmp_path / "case")
    file = tmp_path / "case" / "case.toml"
    file.write_text(re.sub(r"(?<=\nR = )\S+", "1e140", file.read_text(), count=1))
    with pytest.raises(CaseError, match=r"cannot be simulated .* look at \[parameters\]"):
        fitted(load(tmp_path / "case"), lambda _: None)


def test_degrees_celsius_are_read_as_the_kelvin_of_the_variable(tmp_path: Path) -> None:
    """A variable that is in degrees Celsius itself keeps them; the noise is a difference of temperatures."""
    (tmp_path / "Plate.mo").write_text(
        'model Plate\n  Real T(unit="K", start=293, fixed=true);\n  Real C(unit="degC", start=20, fixed=true);\n'
        "  parameter Real r = 1;\nequation\n  der(T) = -r*(T - 293);\n  der(C) = -r*(C - 20);\nend Plate;\n"
    )
    (tmp_path / "r.csv").write_text("time,T,C\n0,20,20\n1,26.85,30\n2,,40\n")
    signal = '[signals.{0}]\nrole = "output"\nunit = "degC"\nnoise_std = 0.5\n'
    (tmp_path / "r2.csv").write_text("time,T,C\n0,20,20\n1,20,20\n")
    files = '[recordings]\nfit = ["r.csv"]\nvalidate = ["r2.csv"]\n'
    (tmp_path / "case.toml").write_text('model = "Plate.mo"\n' + signal.format("T") + signal.format("C") + files)
    case = load(tmp_path)
    assert (case.signals["T"].model_unit, case.signals["C"].model_unit) == ("K", "degC")
    np.testing.assert_allclose(case.fit[0].columns["T"], [293.15, 300.0, np.nan])
    np.testing.assert_allclose(case.fit[0].columns["C"], [20, 30, 40])
    assert case.signals["T"].noise_std == 0.5


def test_names_with_dots_need_no_quotes(consistent_case: Path, tmp_path: Path) -> None:
    for file in consistent_case.iterdir():
        if file.suffix == ".csv":
            (tmp_path / file.name).write_bytes(file.read_bytes())
    text = (consistent_case / "case.toml").read_text()
    name = load(consistent_case).fit[0].name
    text = text.replace("[signals.", "[uncertainty.shaft]\nJ = 0.2\n[signals.", 1)
    text += f'\n[recording."{name}"]\ninitial = {{shaft.w = 3.0}}\nparameters = {{shaft.disc.J = 2e-3}}\n'
    (tmp_path / "case.toml").write_text(text)
    case = load(tmp_path)
    assert case.uncertainty["shaft.J"] == 0.2
    assert case.own[name].initial == {"shaft.w": 3.0}
    assert case.own[name].parameters == {"shaft.disc.J": 2e-3}


def test_a_head_that_says_another_unit_than_the_description_is_refused(consistent_case: Path, tmp_path: Path) -> None:
    """i [mA] was read as A; i_mA may be a name."""
    shutil.copytree(consistent_case, tmp_path / "case")
    file = next((tmp_path / "case").glob("*.csv"))
    head, rest = file.read_text().split("\n", 1)
    for said, refused in (("i [A]", ""), ("i [mA]", "`i [mA]` is in mA by its head, and in A by case.toml")):
        file.write_text(",".join(said if name == "i" else name for name in head.split(",")) + "\n" + rest)
        if refused:
            with pytest.raises(CaseError, match=re.escape(refused)):
                load(tmp_path / "case")
        else:
            load(tmp_path / "case")


TANK = """model Tank "An accumulator, in the units of its makers"
  parameter Real k(unit="l/(s.bar)", min=0) = 2;
  parameter Real C(unit="l/bar", min=0) = 4;
  Real p(unit="bar", start=1, fixed=true);
  Real T(unit="degC", start=20, fixed=true);
  Real x(unit="deg") = p*30*one;
  constant Real one(unit="deg/bar") = 1;
  constant Real rate(unit="1/s") = 1;
  input Real q(unit="l/s");
equation
  C*der(p) = q - k*p;
  der(T) = -T*rate;
end Tank;
"""


def test_columns_come_in_the_units_that_the_model_declares(tmp_path: Path) -> None:
    """A model in bar, litres and degrees Celsius, recorded in pascal, cubic metres and kelvin, or as it is."""
    (tmp_path / "Tank.mo").write_text(TANK)
    for name in ("r1.csv", "r2.csv"):
        (tmp_path / name).write_text("time,q,p,T,x\n0,0.002,150000,293.15,0.5\n1,0.001,50000,273.15,0.25\n")
    signals = [("q", "input", "m3/s"), ("p", "output", "Pa"), ("T", "output", "K"), ("x", "output", "rad")]
    tables = [f'[signals.{c}]\nrole = "{r}"\nvariable = "{c}"\nunit = "{u}"\n' for c, r, u in signals]
    tables[1] += "noise_std = 1000\n"
    text = 'model = "Tank.mo"\n' + "".join(tables) + '[recordings]\nfit = ["r1.csv"]\nvalidate = ["r2.csv"]\n'
    (tmp_path / "case.toml").write_text(text)
    case = load(tmp_path)
    told = {c: list(v) for c, v in case.fit[0].columns.items()}
    assert told["q"] == pytest.approx([2, 1]) and told["p"] == pytest.approx([1.5, 0.5])
    assert told["T"] == pytest.approx([20, 0]) and told["x"] == pytest.approx([0.5 * 180 / np.pi, 45 / np.pi])
    assert [case.signals[c].model_unit for c in "qpTx"] == ["l/s", "bar", "degC", "deg"]
    assert case.signals["p"].noise_std == pytest.approx(0.01)
    Machine(case, Amendment(believed_structure(case, case.library())))  # refuses units that do not fit


SWITCHED = """model Heater "With a switch"
  input Boolean on;
  Real T(unit="K", start=293, fixed=true);
  Boolean hot = T > 310;
equation
  100*der(T) = (if on then 50 else 0) - (T - 293);
end Heater;
"""
SWITCHED_CASE = """model = "Heater.mo"
[signals.on]
role = "input"
variable = "on"
unit = "1"
[signals.{column}]
role = "output"
variable = "{column}"
unit = "{unit}"
[recordings]
fit = ["r1.csv"]
validate = ["r2.csv"]
"""


def switched(folder: Path, column: str, unit: str) -> Path:
    (folder / "Heater.mo").write_text(SWITCHED)
    (folder / "case.toml").write_text(SWITCHED_CASE.format(column=column, unit=unit))
    for name in ("r1.csv", "r2.csv"):
        (folder / name).write_text(f"time,on,{column}\n0,1,293\n1,0,293.5\n2,1,293.4\n")
    return folder


def test_a_switch_is_held_and_moved_by_no_part(tmp_path: Path) -> None:
    """Whatever case.toml says of it, there is nothing between its values; a proposed course has whole ones."""
    case = load(switched(tmp_path, "T", "K"))
    switch = case.signals["on"]
    assert switch.counts and switch.interpolation == "hold" and not case.signals["T"].counts
    drawn = waveforms(case, ranges(case), seed=3)
    assert drawn and all(set(np.unique(one.columns["on"])) <= {0.0, 1.0} for one in drawn)


def test_an_output_that_counts_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match=r"\[signals.hot\] hot is Boolean: only Reals are compared; leave it out"):
        load(switched(tmp_path, "hot", "1"))
