"""From files as loggers write them to a case that explains itself and runs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import lacuna
from lacuna.analysis.recording.channel import RecordingError
from lacuna.analysis.recording.formats import read_recorded
from lacuna.analysis.recording.heads import read_head
from lacuna.analysis.recording.text import read_text
from lacuna.discovery.case.cases import load
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.draft.case import new_case
from lacuna.discovery.draft.match import Target, matched

PLATE = """model Plate "A heated plate in a room"
  input Real P(unit="W") "Heating power";
  parameter Real C(unit="J/K") = 200 "Plate";
  parameter Real G(unit="W/K") = 0.5 "To the room";
  Real T(unit="K", start=293.15, fixed=true) "Temperature of the plate";
equation
  C*der(T) = P - G*(T - 293.15);
end Plate;
"""

HEATER = """model Heater
  input Boolean on;
  parameter Real C(unit="J/K") = 500;
  parameter Real G(unit="W/K") = 2;
  parameter Real P(unit="W") = 100;
  Real T(unit="K", start=293, fixed=true);
  Boolean warm = T > 300;
equation
  C*der(T) = (if on then P else 0) - G*(T - 293);
end Heater;
"""


@pytest.fixture
def plate(tmp_path: Path) -> Path:
    path = tmp_path / "Plate.mo"
    path.write_text(PLATE)
    return path


def logged(path: Path, header: str, row, rows: int = 400, encoding: str = "utf-8") -> Path:
    path.write_text(header + "\n" + "\n".join(row(k) for k in range(rows)) + "\n", encoding=encoding)
    return path


@pytest.mark.parametrize(
    ("text", "name", "unit"),
    [
        ("Time [s]", "Time", "s"),
        ("n (rpm)", "n", "rpm"),
        ("I_A/mA", "I_A", "mA"),
        ("Drehzahl in 1/min", "Drehzahl", "rpm"),
        ("T {°C}", "T", "degC"),
        ("p, bar", "p", "bar"),
        ("q (m3/(s.Pa))", "q", "m3/(s.Pa)"),
        ("moment [Nm]", "moment", "N.m"),
        ("u_V", "u", "V"),
        ("phi_a/phi_b", "phi_a/phi_b", None),
        ("gear.phi_rel", "gear.phi_rel", None),
        ("x_1", "x_1", None),
        ("phase[1]", "phase[1]", None),
        ("phase[1] [A]", "phase[1]", "A"),
    ],
)
def test_heads_are_read_as_people_write_them(text: str, name: str, unit: str | None) -> None:
    head = read_head(text)
    assert (head.name, head.unit) == (name, unit)


@pytest.mark.parametrize(
    ("encoding", "separator", "decimal"),
    [("utf-8", ",", "."), ("utf-8-sig", ";", ","), ("utf-16", "\t", ","), ("cp1252", ";", ".")],
)
def test_dialects_give_the_same_numbers(tmp_path: Path, encoding: str, separator: str, decimal: str) -> None:
    rows = [(0.5, -1.25e-3), (1.5, None), (2.5, 3e4)]

    def field(value: float | None) -> str:
        return "" if value is None else repr(value).replace(".", decimal)

    lines = ["Zeit [s]" + separator + "ϑ".encode(encoding, "replace").decode(encoding) + " [°C]"]
    lines += [separator.join(map(field, row)) for row in rows]
    (tmp_path / "log.csv").write_bytes("\r\n".join(lines).encode(encoding))
    table = read_text(tmp_path / "log.csv")
    assert np.array_equal(table.values, np.array([[0.5, 1.5, 2.5], [-1.25e-3, np.nan, 3e4]]), equal_nan=True)
    assert table.header[1].endswith("[°C]")
    assert (table.dialect.separator, table.dialect.decimal) == (separator, decimal)


def test_a_row_of_units_and_lines_above_the_header_are_understood(tmp_path: Path) -> None:
    (tmp_path / "log.txt").write_text("Logger 7\nSerial;12\nTime;Speed;\ns;rpm;\n0,0;1,5;\n0,1;2,5;\n")
    table = read_text(tmp_path / "log.txt")
    assert (table.header, table.units, table.skipped) == (("Time", "Speed"), ("s", "rpm"), 2)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time,a\n0,1\n1,2_0\n", r":3: field 2, `2_0`, is no number"),
        ("time,a\n0,1\n1,0x10\n", r":3: field 2, `0x10`"),
        ("time,a\n0,1\n1\n", r":3: 1 fields where the first row has 2"),
        ("time,a,a\n0,1,2\n1,2,3\n", r"columns 2 and 3 are both called `a`"),
        ("0,1\n1,2\n", r":1: numbers without a header"),
        ("time,a\nx,y\n", r"no row of numbers"),
        ("time,\n0,1\n", r"column 2 has no name"),
        ("time,a\n0,1\0\n", r"no text"),
        ("time,a\n0,1\n1,inf\n", r":3: field 2, `inf`"),
    ],
)
def test_what_is_no_table_of_numbers_is_refused_with_its_place(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "bad.csv").write_text(text)
    with pytest.raises(RecordingError, match=words):
        read_recorded(tmp_path / "bad.csv")


def test_units_decide_where_names_say_nothing() -> None:
    targets = [Target("u", "V", True), Target("motor.w", "rad/s", False), Target("motor.i", "A", False)]
    heads = [read_head(text) for text in ("Kanal 1 [V]", "Kanal 2 [rpm]", "Kanal 3 [mA]")]
    assert [m.target.name for m in matched(heads, targets) if m.target] == ["u", "motor.w", "motor.i"]
    assert all(m.sure for m in matched(heads, targets))


def test_a_name_in_another_dimension_is_no_match() -> None:
    assert matched([read_head("w [V]")], [Target("w", "rad/s", False)])[0].target is None


@pytest.mark.parametrize(
    ("text", "target", "unit"),
    [
        ("I_C", Target("I_C", "A", False), None),  # it was in coulomb, and fitted nothing
        ("theta_d", Target("theta_d", "rad", False), None),
        ("w_rpm", Target("w", "rad/s", False), "rpm"),
    ],
)
def test_the_end_of_a_name_is_a_unit_where_the_variable_is_of_its_quantity(
    text: str, target: Target, unit: str | None
) -> None:
    (found,) = matched([read_head(text)], [target])
    assert found.target == target and found.head.unit == unit


@pytest.mark.parametrize(("head", "unit"), [("n [Hz]", "rad/s"), ("w [Hz]", "rad/s"), ("f [rad/s]", "Hz")])
def test_a_frequency_is_no_speed(head: str, unit: str) -> None:
    """2 pi lie between them: such a case was drafted, and then refused."""
    assert matched([read_head(head)], [Target(head[0], unit, False)])[0].target is None


def test_a_variable_records_one_column_only() -> None:
    matches = matched([read_head("T [K]"), read_head("T2 [K]")], [Target("T", "K", False)])
    assert [m.target.name if m.target else None for m in matches] == ["T", None]


def test_a_drafted_case_is_read_as_it_is(plate: Path, tmp_path: Path) -> None:
    random = np.random.default_rng(3)
    noise = random.normal(0, 0.2, 1000)

    def row(k: int) -> str:
        return f"{500 * k};{20 + 10 * (1 - np.exp(-k / 80)) + noise[k]:.3f};{5 if k else 0:.1f}".replace(".", ",")

    header = "Time [ms];Temp plate (°C);P [W]"
    data = [logged(tmp_path / f"run {k}.csv", header, row, encoding="cp1252") for k in (1, 2)]
    made = new_case(str(plate), data, tmp_path / "Fälle")
    case = load(tmp_path / "Fälle")
    assert case.model == "Plate.mo" and (tmp_path / "Fälle" / "Plate.mo").read_text() == PLATE
    assert [(s.column, s.role, s.variable) for s in case.signals.values()] == [
        ("Temp plate", "output", "T"), ("P", "input", "P"),
    ]  # fmt: skip
    assert ([r.name for r in case.fit], [r.name for r in case.validate]) == (["run 1.csv"], ["run 2.csv"])
    assert case.fit[0].time[1] == 0.5
    assert case.fit[0].columns["Temp plate"][0] == pytest.approx(293.15, abs=1)
    assert case.initial == {"T": "recorded"}
    text = (tmp_path / "Fälle" / "case.toml").read_text()
    assert all(f"# ? {sentence}" in text for sentence in made.unsure)
    assert any("converted from degC to K" in sentence for sentence in made.unsure)


def test_an_epoch_loses_no_digits(plate: Path, tmp_path: Path) -> None:
    data = logged(
        tmp_path / "a.csv", "timestamp [s],T [K],P [W]", lambda k: f"{1.7e9 + k * 1e-6:.6f},{293.15 + k % 7},0"
    )
    new_case(str(plate), [data], tmp_path / "case")
    assert load(tmp_path / "case").fit[0].time[0] == 0


def test_a_single_recording_is_parted(plate: Path, tmp_path: Path) -> None:
    data = logged(tmp_path / "one.csv", "t [s],T [K],P [W]", lambda k: f"{k},{293 + k % 7},{k % 3}")
    made = new_case(str(plate), [data], tmp_path / "case")
    case = load(tmp_path / "case")
    assert len(case.fit[0].time) + len(case.validate[0].time) == 400
    assert case.fit[0].time[-1] < case.validate[0].time[0]
    assert any("one recording" in sentence for sentence in made.unsure)


def test_nothing_is_written_where_something_is_wrong(plate: Path, tmp_path: Path) -> None:
    good = logged(tmp_path / "a.csv", "time,T [K]", lambda k: f"{k},{293 + k % 7}")
    other = logged(tmp_path / "b.csv", "time,X [K]", lambda k: f"{k},{k % 7}")
    with pytest.raises(CaseError, match=r"recordings of one case record the same signals"):
        new_case(str(plate), [good, other], tmp_path / "case")
    volts = logged(tmp_path / "c.csv", "time,z [V]", lambda k: f"{k},{k % 7}")
    with pytest.raises(CaseError, match=r"no column of c.csv fits"):
        new_case(str(plate), [volts], tmp_path / "case")
    short = logged(tmp_path / "d.csv", "time [s],T [K]", lambda k: f"{1.7e9 + k:.6e},{293 + k % 7}")
    with pytest.raises(CaseError, match=r"d.csv: time does not increase after sample 1 .* too few digits"):
        new_case(str(plate), [short], tmp_path / "case")
    assert lacuna.convert(short, tmp_path / "e.csv")[-1].startswith("time does not increase after sample 1 ")
    assert not (tmp_path / "case").exists()
    new_case(str(plate), [good], tmp_path / "case")
    with pytest.raises(CaseError, match="is there already"):
        new_case(str(plate), [good], tmp_path / "case")


def test_a_switch_drives_where_the_model_declares_one(tmp_path: Path) -> None:
    model = tmp_path / "Heater.mo"
    model.write_text(HEATER)
    recording = logged(
        tmp_path / "run.csv", "time [s],on,T [K],warm", lambda k: f"{k},{k // 90 % 2},{293 + 0.1 * k},{k // 70}"
    )
    made = new_case(str(model), [recording], tmp_path / "case")
    case = load(made.path.parent)
    assert [(s.column, s.role, s.interpolation) for s in case.inputs] == [("on", "input", "hold")]
    assert [s.column for s in case.outputs] == ["T"]  # a switch that only reads says nothing that T does not
    assert "`warm` fits no variable" in made.path.read_text()
