"""Recordings in units of their own beside models in theirs: inputs are driven, signals compared, in the model's."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import lacuna
from lacuna.cli.main import app

MODEL = """model Turn
  input Real u(unit="{unit}");
  Real y(unit="{unit}");
equation
  y = 2*u;
  annotation(experiment(StopTime=1, Interval=0.1));
end Turn;
"""


def turn(folder: Path, unit: str) -> Path:
    path = folder / "Turn.mo"
    path.write_text(MODEL.format(unit=unit), encoding="utf-8")
    return path


def recording(folder: Path, head: str, factor: float = 1.0) -> Path:
    path = folder / "r.csv"
    path.write_text(f"time [s];{head}\n0;0\n1;{60 * factor:g}\n".replace(".", ","), encoding="utf-8")
    return path


@pytest.mark.parametrize(("unit", "last"), [("rad/s", 4 * np.pi), ("rpm", 120.0)])
def test_an_input_is_driven_in_the_unit_that_it_declares(tmp_path: Path, unit: str, last: float) -> None:
    given = lacuna.recorded(recording(tmp_path, "n (rpm)"), "n")
    result = lacuna.load(turn(tmp_path, unit)).simulate(inputs={"u": given})
    assert result["y"][-1] == pytest.approx(last, rel=1e-12)


def test_samples_that_do_not_cover_the_run_are_held_with_a_word(tmp_path: Path) -> None:
    samples = recording(tmp_path, "n (rpm)")
    for stop, said in (("1", ""), ("2", ""), ("2.5", "input u: samples from 0 to 1 s")):
        words = ("--stop", stop, "--out", str(tmp_path))
        result = CliRunner().invoke(app, ["simulate", str(turn(tmp_path, "rpm")), "-u", f"u={samples}:n", *words])
        assert result.exit_code == 0
        assert said in result.output and ("is held" in result.output) == bool(said)


@pytest.mark.parametrize(("start", "said"), [(0.0, False), (0.25, True), (1e-15, False)])
def test_samples_that_begin_late_are_held_with_a_word(tmp_path: Path, start: float, said: bool) -> None:
    """Within one interval of the samples, too; rounding is not late."""
    (tmp_path / "late.csv").write_text(f"time,u\n{start},3\n0.5,4\n1,5\n", encoding="utf-8")
    result = lacuna.load(turn(tmp_path, "rpm")).simulate(inputs={"u": lacuna.recorded(tmp_path / "late.csv", "u")})
    assert result["y"][0] == pytest.approx(6)
    assert any("samples from 0.25 to 1 s" in w for w in result.warnings) == said


def test_one_sample_is_held_with_a_word(tmp_path: Path) -> None:
    (tmp_path / "one.csv").write_text("time,u\n0.5,3\n", encoding="utf-8")
    result = lacuna.load(turn(tmp_path, "rpm")).simulate(inputs={"u": lacuna.recorded(tmp_path / "one.csv", "u")})
    assert set(result["y"]) == {6.0}
    assert "samples from 0.5 to 0.5 s" in result.warnings[0]


def test_samples_outside_of_the_run_drive_nothing(tmp_path: Path) -> None:
    """Their first value was held all along, with a warning."""
    (tmp_path / "epoch.csv").write_text("time,u\n1700000000,0\n1700000001,2\n", encoding="utf-8")
    with pytest.raises(
        lacuna.UserError, match=r"samples from 1.7e\+09 .* none is in the run; begin it there by --start"
    ):
        lacuna.load(turn(tmp_path, "rpm")).simulate(inputs={"u": lacuna.recorded(tmp_path / "epoch.csv", "u")})


def test_an_input_is_not_driven_by_another_quantity(tmp_path: Path) -> None:
    given = lacuna.recorded(recording(tmp_path, "i [mA]"), "i")
    with pytest.raises(lacuna.UserError, match=r"r\.csv: i cannot drive u: A is no rad/s"):
        lacuna.load(turn(tmp_path, "rad/s")).simulate(inputs={"u": given})


@pytest.mark.parametrize("suffix", [".csv", ".mat", ".parquet", ".xlsx"])
def test_a_file_is_compared_in_the_units_of_the_model(tmp_path: Path, suffix: str) -> None:
    model, file = turn(tmp_path, "rad/s"), recording(tmp_path, "y (rpm)", factor=2)
    if suffix != ".csv":
        pytest.importorskip({".xlsx": "openpyxl", ".parquet": "pyarrow"}.get(suffix, "scipy"))
        lacuna.convert(file, file := file.with_suffix(suffix))
    drive = {"u": (np.array([0, 1.0]), np.array([0, 2 * np.pi]))}
    assert lacuna.compare_with_file(model, file, inputs=drive, tolerance=1e-12).beyond == []


def test_a_file_is_not_compared_in_another_quantity(tmp_path: Path) -> None:
    with pytest.raises(Exception, match=r"y \[V\]: V is no rad/s, which y is in") as refused:
        lacuna.compare_with_file(turn(tmp_path, "rad/s"), recording(tmp_path, "y [V]"))
    assert lacuna.is_user_error(refused.value)


@pytest.mark.parametrize(
    ("head", "unit"), [("n [Hz]", "rad/s"), ("n [kHz]", "rpm"), ("n [rpm]", "Hz"), ("n [rad/s]", "1/min")]
)
def test_a_frequency_is_no_speed(tmp_path: Path, head: str, unit: str) -> None:
    """2 pi lie between them, and nobody knows which way: it was taken as 1."""
    given = lacuna.recorded(recording(tmp_path, head), "n")
    with pytest.raises(lacuna.UserError, match=f"cannot drive u: 2 pi lie between them .* is no {unit}"):
        lacuna.load(turn(tmp_path, unit)).simulate(inputs={"u": given})
    with pytest.raises(Exception, match=f"2 pi lie between them .* is no {unit}"):
        lacuna.compare_with_file(turn(tmp_path, unit), recording(tmp_path, head.replace("n", "y", 1)))


@pytest.mark.parametrize(
    ("head", "unit"), [("n [Hz]", "1/s"), ("n [Hz]", "Hz"), ("n [rad/s]", "1/s"), ("n [1/s]", "rad/s")]
)
def test_what_may_be_either_is_taken_as_it_is(tmp_path: Path, head: str, unit: str) -> None:
    given = lacuna.recorded(recording(tmp_path, head), "n")
    assert lacuna.load(turn(tmp_path, unit)).simulate(inputs={"u": given})["y"][-1] == 120


@pytest.mark.parametrize(
    ("head", "unit", "last", "said"),
    [
        ("theta_d", "rad", 120, "theta_d is taken as it is, not in d"),  # it was 86400 times as much
        ("theta_d", "", 120, "theta_d is taken as it is, not in d"),
        ("phi_deg", "rad", np.deg2rad(120), "phi_deg is taken to be in deg"),
        ("phi_rad", "rad", 120, ""),
        ("u_in", "1", 120, "u_in is taken as it is, not in in"),
    ],
)
def test_a_unit_that_a_name_ends_like_is_believed_where_it_fits(
    tmp_path: Path, head: str, unit: str, last: float, said: str
) -> None:
    given = lacuna.recorded(recording(tmp_path, head), head)
    result = lacuna.load(turn(tmp_path, unit)).simulate(inputs={"u": given})
    assert result["y"][-1] == pytest.approx(last, rel=1e-12)
    assert [said in w for w in result.warnings] == [True] * bool(said)


def test_the_end_of_the_variables_own_name_is_no_unit(tmp_path: Path) -> None:
    (tmp_path / "M.mo").write_text("model M input Real y_in; Real y = y_in; end M;", encoding="utf-8")
    given = lacuna.recorded(recording(tmp_path, "y_in"), "y_in")
    assert lacuna.load(tmp_path / "M.mo").simulate(inputs={"y_in": given}).warnings == []


def test_a_column_called_as_a_variable_says_no_unit_by_its_end(tmp_path: Path) -> None:
    """theta_d was looked for as theta, in days."""
    (tmp_path / "M.mo").write_text("model M Real theta_d = 2; end M;", encoding="utf-8")
    (tmp_path / "r.csv").write_text("time,theta_d\n0,2\n1,2\n", encoding="utf-8")
    assert lacuna.compare_with_file(tmp_path / "M.mo", tmp_path / "r.csv").beyond == []


def test_a_unit_that_is_none_is_said(tmp_path: Path) -> None:
    (tmp_path / "r.csv").write_text("time,y\ns,furlong\n0,0\n1,0\n", encoding="utf-8")
    given = lacuna.recorded(tmp_path / "r.csv", "y")
    result = lacuna.load(turn(tmp_path, "rad/s")).simulate(inputs={"u": given})
    assert "furlong is no unit known here" in result.warnings[0]
    with pytest.raises(Exception, match="y is in furlong, which is no unit known here"):
        lacuna.compare_with_file(turn(tmp_path, "rad/s"), tmp_path / "r.csv")


def test_what_is_no_number_or_no_name_is_said_to_be_none(tmp_path: Path) -> None:
    model = lacuna.load(turn(tmp_path, "rad/s"))
    for name in ("start", "stop", "rtol", "interval"):
        with pytest.raises(lacuna.UserError, match=f"{name} cannot be '2': that is no number"):
            model.simulate(**{name: "2"})
    for function in (lacuna.compare, lacuna.load, lambda loaded: lacuna.compare_with_file(loaded, "r.csv")):
        with pytest.raises(
            lacuna.UserError, match="a model is given here by its name or file, not as Model; write 'Turn'"
        ):
            function(model)


@pytest.mark.parametrize(("hold", "how"), [(False, "bridged by a straight line"), (True, "held")])
def test_samples_that_lack_are_told(tmp_path: Path, hold: bool, how: str) -> None:
    """Not the cells that a channel of a lower rate leaves empty."""
    whole, lacking = [f"{k / 10},{k},{k if k % 2 == 0 else ''}" for k in range(21)], []
    for k, line in enumerate(whole):
        lacking.append(line if not 5 <= k <= 9 else f"{k / 10},,{k if k % 2 == 0 else ''}")
    for name, lines in (("whole", whole), ("lacking", lacking)):
        (tmp_path / f"{name}.csv").write_text("\n".join(["time,u,slow", *lines]) + "\n")
    model = lacuna.load(turn(tmp_path, "1"))
    for name, column, gap in (("whole", "u", 0), ("whole", "slow", 0), ("lacking", "u", 1)):
        driven = lacuna.recorded(tmp_path / f"{name}.csv", column, hold=hold)
        said = [w for w in model.simulate(inputs={"u": driven}, stop=2.0).warnings if "lacks samples" in w]
        assert len(said) == gap
        assert all(f"between 0.4 and 1 s, the longest gap; they are {how}" in w for w in said)


def test_what_was_assumed_of_a_file_is_told(tmp_path: Path) -> None:
    """Two samples have no rate that the others could lack by; a column that nobody calls time may be none."""
    model = lacuna.load(turn(tmp_path, "1"))
    (tmp_path / "two.csv").write_text("time,u\n0,0\n1,\n2,\n3,8\n")
    (tmp_path / "timeless.csv").write_text("k,u\n0,0\n1,1\n2,2\n3,8\n")
    said = {
        name: " ".join(model.simulate(inputs={"u": lacuna.recorded(tmp_path / name, "u")}, stop=2.0).warnings)
        for name in ("two.csv", "timeless.csv")
    }
    assert "lacks samples, between 0 and 3 s" in said["two.csv"]
    assert "`k` was taken for time" in said["timeless.csv"] and "taken for time" not in said["two.csv"]
