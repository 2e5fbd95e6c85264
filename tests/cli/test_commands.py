"""What a user types, sees, and gets as an exit status."""

from __future__ import annotations

from pathlib import Path
import subprocess
import sys

import numpy as np
import pytest
from typer.testing import CliRunner

from lacuna.cli.main import app
from tests.results import read_result

ROOT = Path(__file__).parents[2]
SERVO = str(ROOT / "tests" / "models" / "SquareWaveServo.mo")
MOTOR = str(ROOT / "tests" / "models" / "SixStepMotor.mo")


@pytest.fixture(autouse=True)
def in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def lacuna(*words: str):
    return CliRunner().invoke(app, list(words))


def refused(*words: str) -> str:
    """Output of a command that must end with status 1, by a message and not by a traceback."""
    result = lacuna(*words)
    assert result.exit_code == 1, result.output
    assert isinstance(result.exception, SystemExit), result.exception
    return result.output


def test_every_command_has_help() -> None:
    names = [command.name for command in app.registered_commands]
    assert {
        "check",
        "compile",
        "simulate",
        "compare",
        "maps",
        "assess",
        "explain",
        "fit",
        "locate",
        "name",
        "judge",
    } <= set(names)
    for name in names:
        assert lacuna(name, "--help").exit_code == 0
        assert lacuna("--help").output.count(name) >= 1


def test_help_loads_no_stage() -> None:
    stages = ("numpy", "lacuna.codegen", "lacuna.runtime", "lacuna.analysis", "lacuna.discovery")
    code = f"import sys, lacuna.cli.main; sys.exit(any(m in sys.modules for m in {stages}))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_check_accepts_a_model() -> None:
    result = lacuna("check", SERVO)
    assert result.exit_code == 0
    assert "SquareWaveServo" in result.output
    assert "no errors" in result.output


def test_check_shows_line_caret_and_hint(tmp_path: Path) -> None:
    file = tmp_path / "Slip.mo"
    file.write_text("model Slip\n  Real x(start=0, fixed=true);\nequation\n  der(x) = -xx;\nend Slip;\n")
    output = refused("check", str(file))
    assert "Slip.mo:4:" in output
    assert "der(x) = -xx;" in output
    assert "^" in output
    assert "hint" in output


def test_units_can_be_made_a_warning(tmp_path: Path) -> None:
    file = tmp_path / "Mixed.mo"
    file.write_text(
        'model Mixed\n  Real x(unit="m", start=0, fixed=true);\n  parameter Real t(unit="s") = 1;\n'
        "equation\n  der(x) = t;\nend Mixed;\n"
    )
    assert "Mixed.mo:5" in refused("check", str(file))
    assert lacuna("check", "--units", "warn", str(file)).exit_code == 0


@pytest.mark.parametrize("kind", ["flat", "structure", "c"])
def test_dump_is_the_same_each_time(kind: str) -> None:
    first, second = lacuna("compile", MOTOR, "--dump", kind), lacuna("compile", MOTOR, "--dump", kind)
    assert first.exit_code == 0
    assert "ia" in first.output
    assert first.output == second.output


def test_compile_reports_the_passes_once(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("LACUNA_CACHE", str(tmp_path / "cache"))
    assert "in all" in lacuna("compile", SERVO).output
    assert "unchanged" in lacuna("compile", SERVO).output


def test_simulate_says_what_ended_a_run(tmp_path: Path) -> None:
    Path("Ends.mo").write_text(
        "model Ends\n  Real x(start=0, fixed=true);\nequation\n  der(x) = 1;\n"
        '  when x > 0.3 then\n    terminate("[b]enough");\n  end when;\nend Ends;\n'
    )
    said = lacuna("simulate", "Ends.mo", "--stop", "1", "--interval", "0.25", "--out", "run").output
    assert "ended by the model" in said and "[b]enough, at time 0.3 s" in said and "0.3 s in" in said


def test_simulate_writes_csv_metadata_and_figure(tmp_path: Path) -> None:
    result = lacuna("simulate", SERVO, "--stop", "0.05", "-p", "U=6", "--signal", "w", "--plot", "--out", "run")
    assert result.exit_code == 0, result.output
    columns, meta = read_result(tmp_path / "run" / "SquareWaveServo.csv")
    assert columns["time"][-1] == 0.05
    assert meta["complete"]
    assert meta["parameters"]["U"] == 6.0
    assert (tmp_path / "run" / "SquareWaveServo.svg").stat().st_size > 1000


def test_structural_parameter_is_translated_anew(tmp_path: Path) -> None:
    for pairs in (2, 3):
        assert lacuna("simulate", MOTOR, "--stop", "0.05", "-p", f"pp={pairs}", "--out", f"pp{pairs}").exit_code == 0
    speeds = [read_result(tmp_path / f"pp{pairs}" / "SixStepMotor.csv")[0]["w"][-1] for pairs in (2, 3)]
    assert abs(speeds[0] - speeds[1]) > 0.1


def test_recorded_input_drives_a_model(tmp_path: Path) -> None:
    (tmp_path / "Lag.mo").write_text(
        "model Lag\n  input Real u;\n  Real y(start=0, fixed=true);\nequation\n  der(y) = u - y;\nend Lag;\n"
    )
    time = np.linspace(0.0, 1.0, 11)
    np.savetxt(tmp_path / "ramp.csv", np.column_stack([time, time]), delimiter=",", header="time,u", comments="")
    words = ["simulate", "Lag.mo", "-u", "u=ramp.csv", "--rtol", "1e-9", "--out", "run"]
    assert lacuna(*words).exit_code == 0
    y = read_result(tmp_path / "run" / "Lag.csv")[0]["y"][-1]
    assert y == pytest.approx(np.exp(-1.0), rel=1e-6)  # y = t - 1 + exp(-t)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["check", "Actuators.EccentricBldd"], "EccentricBldc"),
        (["check", "missing.mo"], "missing.mo"),
        (["simulate", SERVO, "-p", "tauk=1"], "tauc"),
        (["simulate", SERVO, "-p", "qqq=1"], "no parameter called qqq; there are "),
        (["simulate", SERVO, "-p", "qqq=1"], " R, L, Ke, J, b and 3 more"),
        (["simulate", SERVO, "--signal", "qqq"], "no variable called qqq; there are "),
        (["simulate", SERVO, "-p", "R"], "NAME=VALUE"),
        (["simulate", SERVO, "-p", "R=big"], "big"),
        (["simulate", SERVO, "-p", "R=1", "-p", "R=2"], "twice"),
        (["simulate", SERVO, "--solver", "rk4"], "step"),
        (["simulate", SERVO, "--rtol", "-1"], "rtol"),
        (["simulate", SERVO, "--start", "2", "--stop", "1"], "cannot begin at 2 s and end at 1 s"),
        (["simulate", SERVO, "--start", "-1e308", "--stop", "1e308"], "is longer than any number of seconds"),
        (["simulate", SERVO, "--signal", "speed"], "speed"),
        (["simulate", SERVO, "-u", "u=missing.csv"], "missing.csv"),
        (["compare", "--only", "helthy"], "helthy"),
        (["maps", "--settings", "missing.toml"], "missing.toml"),
        (["assess", "missing.csv", "--map", "nowhere"], "nowhere"),
        (["explain", "nowhere"], "nowhere"),
    ],
)
def test_mistakes_are_said_in_a_sentence(words: list[str], expected: str) -> None:
    assert expected in refused(*words)


def test_limits_that_contradict_each_other_are_shown(tmp_path: Path) -> None:
    (tmp_path / "Limited.mo").write_text(
        "model Limited\n  Lacuna.Components.Control.Limiter limiter(y_min=0, y_max=1);\n"
        "  parameter Real k(min=0) = 1;\nequation\n  limiter.u = k*time;\nend Limited;\n"
    )
    said = refused("simulate", "Limited.mo", "-p", "limiter.y_max=-2")
    assert "limiter: assertion violated" in said
    assert "y_min must not exceed y_max (limiter.y_min = 0, limiter.y_max = -2)" in said
    assert "k = -1 is outside its bounds [0, inf]" in refused("simulate", "Limited.mo", "-p", "k=-1")
    assert not (tmp_path / "out").exists()


def test_failed_run_keeps_what_it_has(tmp_path: Path) -> None:
    (tmp_path / "Escape.mo").write_text(
        "model Escape\n  Real x(start=1, fixed=true);\nequation\n  der(x) = x^2;\n"
        "  annotation(experiment(StopTime=2, Interval=0.1));\nend Escape;\n"
    )
    refused("simulate", "Escape.mo", "--out", "run")
    columns, meta = read_result(tmp_path / "run" / "Escape.csv")
    assert not meta["complete"]
    assert 0.5 < columns["time"][-1] < 1.0


def test_compare_with_a_file_has_a_tolerance(tmp_path: Path) -> None:
    assert lacuna("simulate", SERVO, "--stop", "0.2", "--signal", "w", "--out", "run").exit_code == 0
    file = str(tmp_path / "run" / "SquareWaveServo.csv")
    assert lacuna("compare", SERVO, "--against", file, "--tolerance", "1e-4").exit_code == 0
    assert "w" in refused("compare", SERVO, "--against", file, "--tolerance", "1e-4", "-p", "R=3.4")
    head, first, *rows = Path(file).read_text(encoding="utf-8").splitlines()
    Path(file).write_text("\n".join([head, first, *(f"{row.split(',')[0]}," for row in rows)]) + "\n", encoding="utf-8")
    done = lacuna("compare", SERVO, "--against", file, "--tolerance", "1e-4")
    assert f"w: the file has no sample at {len(rows)} of {len(rows) + 1} instants" in done.output


def test_compare_a_model_of_ones_own(tmp_path: Path) -> None:
    result = lacuna("compare", SERVO, "--stop", "0.15", "--step", "1e-4", "--step", "5e-5", "--out", "own")
    assert result.exit_code == 0, result.output
    assert "rk4" in result.output
    assert (tmp_path / "own" / "report.html").exists()


def test_fit_of_a_practice_case_is_looked_at_alone(shared: Path, tmp_path: Path) -> None:
    result = lacuna("fit", str(shared / "recordings" / "practice" / "p01"), "--out", "fit")
    assert result.exit_code == 0, result.output
    assert "believed" in result.output
    assert (tmp_path / "fit" / "report.html").stat().st_size > 10_000


@pytest.mark.parametrize(
    "words",
    [
        ["simulate", "/dev/zero"],
        ["simulate", SERVO, "-u", "u=/dev/zero:u"],
        ["compare", SERVO, "--against", "/dev/zero"],
        ["maps", "--settings", "/dev/zero"],
        ["explain", "case"],
    ],
)
def test_a_device_is_no_file(words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("case").mkdir()
    Path("case/case.toml").symlink_to("/dev/zero")
    assert "is not a file" in refused(*words)


def test_time_alone_is_a_signal(tmp_path: Path) -> None:
    assert lacuna("simulate", SERVO, "--signal", "time", "--plot", "--out", str(tmp_path)).exit_code == 0
    assert (tmp_path / "SquareWaveServo.csv").read_text(encoding="utf-8").splitlines()[0] == "time"
    assert (tmp_path / "SquareWaveServo.svg").exists()


NUMBERS = [
    (["simulate", SERVO, "--stop", "1_0"], "no finite number"),
    (["simulate", SERVO, "--interval", "0.1_0"], "no finite number"),
    (["simulate", SERVO, "--rtol", "nan"], "no finite number"),
    (["simulate", SERVO, "--stop", "\N{ARABIC-INDIC DIGIT TWO}"], "no finite number"),
    (["forecast", "h.csv", "--risk", "1e999"], "no finite number"),
    (["sweep", "--points", "9" * 20], "is not within 1 and 2147483647"),
    (["sweep", "--chunk", "0"], "0 is not within 1 and"),
    (["compare", "Actuators.EccentricBldc", "--tolerance", "-1"], "-1 is not within 0 and"),
    (["sweep", "--points", "1_000"], "no whole number"),
    (["maps", "--jobs", "9" * 5000], "no whole number"),
    (["assess", "test.csv", "--cycles", "1_0"], "no finite number"),
]


@pytest.mark.parametrize(("words", "expected"), NUMBERS)
def test_numbers_are_read_as_those_of_files_are(words: list[str], expected: str) -> None:
    result = lacuna(*words)
    assert result.exit_code == 2 and expected in " ".join(result.output.replace("│", " ").split()), result.output


def test_truth_is_no_number(tmp_path: Path) -> None:
    model = tmp_path / "T.mo"
    parameters = "parameter Boolean b = true; parameter Real k = 2;"
    model.write_text(f"model T {parameters} input Real u; Real y = if b then k*u else 0; end T;")
    simulate = ["simulate", str(model), "--stop", "1", "--out", str(tmp_path / "out")]
    assert "k cannot be true: it is Real" in refused(*simulate, "-p", "k=true")
    assert "u cannot be false: it is Real" in refused(*simulate, "-u", "u=false")
    assert lacuna(*simulate, "-p", "b=false").exit_code == 0
