"""Every command on models that are not ours: classes in files and package folders, libraries on two paths, constant
inputs, and a folder whose name has a space and umlauts; what cannot be used is said in a line."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from typer.testing import CliRunner

from lacuna import runtime
from lacuna.cli.main import app
from tests.results import read_result

SETTINGS = Path(__file__).parents[2] / "analysis" / "settings" / "paper.toml"
FILES = {
    "libA/Alpha/package.mo": "package Alpha partial model Lag parameter Real k = 3; Real y(start=0, fixed=true); "
    "input Real u; equation der(y) = k*(u - y); end Lag; end Alpha;",
    "libB/Beta/package.mo": "package Beta end Beta;",
    "libB/Beta/Sub/package.mo": "within Beta; package Sub end Sub;",
    "libB/Beta/Sub/Plant.mo": 'within Beta.Sub; model Plant "Of two libraries" extends Alpha.Lag; Real z = -y; '
    "annotation(experiment(StopTime=1)); end Plant;",
    "Drives/package.mo": "package Drives end Drives;",
    "Drives/Motor.mo": "within Drives; model Motor extends Lacuna.Actuators.PreflightEma; end Motor;",
    "Box.mo": "package Box model Small Real x(start=1, fixed=true); equation der(x) = -x; end Small; end Box;",
    "Names.mo": 'model Names parameter Real p(unit="m") = 2; Real v(unit="m/s", start=1, fixed=true); Real back = -v; '
    'Real a = p + p; Real e = v*v/p; parameter Real T(unit="s") = 3; constant Real c = 3; '
    "equation der(v) = -v/T; end Names;",
    "Row.mo": "model Row parameter Integer n = 2; parameter Real v[n] = fill(1, n); Real s = sum(v)*time; end Row;",
    "Open.mo": "model Open parameter Integer n; parameter Real v[n]; Real s = sum(v)*time; end Open;",
    "Rows.mo": "model Rows parameter Integer k[2] = {1, 2}; parameter Boolean on[2] = {true, false}; "
    "final parameter Integer f[1] = {1}; constant Integer c[1] = {1}; model Part parameter Integer n = 1; "
    "Real x[n] = fill(1.0, n); end Part; Part part[2]; Real s = if on[2] then 100*time else 0; "
    "Real x[k[1]] = ones(k[1]); Real y = sum(x) + 10*k[2] + s + 1000*sum(part[2].x); end Rows;",
    "again/Alpha/package.mo": "package Alpha end Alpha;",
    "Folder.mo/readme.txt": "no model",
    "empty/readme.txt": "no package",
    "Wrong.mo": "model Wrong Real x; equation der(x) = -xx; end Wrong;",
}
BETA = ["-L", "libA", "-L", "libB"]


@pytest.fixture(autouse=True)
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "Prüf stand Öl"
    for name, text in FILES.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(folder)
    monkeypatch.delenv("MODELICAPATH", raising=False)
    return folder


def lacuna(*words: str):
    return CliRunner().invoke(app, list(words))


def answer(*words: str) -> dict:
    """What a command that goes well says as JSON."""
    result = lacuna(*words, "--json")
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


def refused(*words: str) -> str:
    result = lacuna(*words)
    assert result.exit_code == 1, result.output
    assert isinstance(result.exception, SystemExit), result.exception
    return result.output


@pytest.mark.parametrize("words", [("v[3]=9", "n=3"), ("n=3", "v[3]=9")])
def test_sizes_are_set_before_what_they_make(words: tuple[str, str]) -> None:
    given = [part for word in words for part in ("-p", word)]
    assert answer("simulate", "Row.mo", *given, "--out", "run")["last"]["s"] == 11
    assert "no parameter called v[4]" in refused("simulate", "Row.mo", *given, "-p", "v[4]=1")


def test_elements_are_set_that_decide_the_structure(place: Path) -> None:
    given = ["-p", "k[1]=3", "-p", "part[2].n=2", "-p", "on[2]=1"]
    assert answer("simulate", "Rows.mo", *given, "--out", "run")["last"]["y"] == 3 + 20 + 100 + 2000
    assert answer("simulate", "Open.mo", "-p", "v[2]=5", "-p", "n=2", "-p", "v[1]=2", "--out", "run")["last"]["s"] == 7
    assert "f is final" in refused("simulate", "Rows.mo", "-p", "f[1]=3")
    assert "constant" in refused("simulate", "Rows.mo", "-p", "c[1]=3")
    assert "v[3]" in refused("simulate", "Open.mo", "-p", "n=2", "-p", "v[3]=1")


@pytest.mark.parametrize(
    "model",
    [["Beta.Sub.Plant", *BETA], ["libB/Beta", "--model", "Beta.Sub.Plant", "-L", "libA"],
     ["libB/Beta/Sub/Plant.mo", "-L", "libA"]],
)  # fmt: skip
def test_one_model_by_its_names(model: list[str]) -> None:
    assert answer("check", *model)["name"] == "Beta.Sub.Plant"
    assert answer("compile", *model)["name"] == "Beta.Sub.Plant"
    done = answer("simulate", *model, "-u", "u=12", "-p", "k=2", "--rtol", "1e-8", "--out", "run")
    assert done["last"]["y"] == pytest.approx(12 * (1 - 0.1353352832366127), rel=1e-6)  # 12 (1 - exp(-2))
    assert done["last"]["z"] == -done["last"]["y"]
    columns, meta = read_result(done["written"][0])
    assert {"time", "y", "z", "u"} <= set(columns)
    assert len(columns["time"]) == 501
    assert meta["solver"]["rtol"] == 1e-8
    same = answer("compare", *model, "--against", "run/Plant.csv", "-u", "u=12", "-p", "k=2", "--tolerance", "1e-4")
    assert same["beyond"] == []
    assert "y" in refused("compare", *model, "--against", "run/Plant.csv", "-u", "u=11", "-p", "k=2")


def test_every_declared_variable_is_in_the_file_with_what_is_known_of_it() -> None:
    written = answer("simulate", "Names.mo", "--out", "run")["written"][0]
    columns, meta = read_result(written)
    assert list(columns) == ["time", "v", "back", "a", "e"]  # neither parameters nor constants
    assert (columns["back"] == -columns["v"]).all()
    assert (columns["a"] == 4).all()  # which parameters alone decide
    said = {name: (c["unit"], c.get("unit_inferred", False)) for name, c in meta["columns"].items()}
    assert said["v"] == ("m/s", False)
    assert (said["back"], said["a"], said["e"]) == (("m/s", True), ("m", True), ("m/s2", True))
    assert (meta["solver"]["rtol"], meta["parameters"]["p"]) == (1e-6, 2.0)


def test_an_actuator_s_whole_second_is_a_file_that_one_can_mail() -> None:
    written = Path(answer("simulate", "Actuators.EccentricBldc", "--out", "run")["written"][0])
    assert written.stat().st_size < 5e6  # bytes, all its variables


def test_a_class_in_a_file_and_what_the_file_offers() -> None:
    assert answer("simulate", "Box.mo", "--model", "Box.Small", "--out", "a")["model"] == "Box.Small"
    assert answer("simulate", "Box.mo", "--model", "Small", "--out", "b")["model"] == "Box.Small"
    assert "name a model in it, such as Box.Small" in refused("simulate", "Box.mo")


def test_modelicapath_is_looked_up(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MODELICAPATH", os.pathsep.join([str(place / "libA"), str(place / "libB")]))
    assert answer("check", "Beta.Sub.Plant")["states"] == 3


def test_maps_and_sweep_of_an_actuator_in_a_users_package(place: Path) -> None:
    text = SETTINGS.read_text(encoding="utf-8").replace("step = 0.01", "step = 0.25")
    (place / "small.toml").write_text(text, encoding="utf-8")
    words = ["Drives", "--model", "Drives.Motor", "--settings", "small.toml"]
    done = answer("maps", *words, "--no-figures", "--out", "map")
    assert done["severities"] == [0.0, 0.25, 0.5]
    extended = answer("maps", "Actuators.PreflightEma", "--settings", "small.toml", "--no-figures", "--out", "other")
    assert done["features"]["rms_mean"] == pytest.approx(extended["features"]["rms_mean"], rel=1e-12)
    swept = answer("sweep", *words, "--points", "2", "--out", "swept")
    assert (swept["tests"], swept["failed"]) == (2, 0)


def test_lists() -> None:
    found = answer("list", "models", *BETA)["models"]
    assert {"name": "Beta.Sub.Plant", "description": "Of two libraries"} in found
    assert "Lacuna.Actuators.EccentricBldc" in [entry["name"] for entry in found]
    assert answer("list", "models", "Box.mo")["models"] == [{"name": "Box.Small", "description": ""}]
    parameters = answer("list", "parameters", "Beta.Sub.Plant", *BETA)["parameters"]
    assert [(p["name"], p["value"]) for p in parameters] == [("k", 3.0), ("u", "input")]
    assert "z" in [v["name"] for v in answer("list", "variables", "Beta.Sub.Plant", *BETA)["variables"]]
    assert "friction.coulomb" in [e["name"] for e in answer("list", "effects")["effects"]]
    assert [s["name"] for s in answer("list", "solvers")["solvers"]] == list(runtime.SOLVERS)


def test_quiet_says_nothing_and_the_version_is_said() -> None:
    result = lacuna("simulate", "Box.mo", "--model", "Small", "--quiet", "--out", "run")
    assert (result.exit_code, result.output) == (0, "")
    assert lacuna("--version").output.startswith("lacuna ")


@pytest.mark.parametrize("ending", ["csv", "parquet", "mat"])
def test_formats(place: Path, ending: str) -> None:
    assert answer("simulate", "Box.mo", "--model", "Small", "--format", ending, "--out", "run")["written"] == [
        f"run/Small.{ending}"
    ]
    assert (place / "run" / "Small.meta.json").exists()


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["simulate", "Beta.Sub.Plant", "-L", "empty"], "empty holds no package"),
        (["simulate", "Beta.Sub.Plant", "-L", "nowhere"], "there is no library at"),
        (["simulate", "Beta.Sub.Plant", *BETA, "-L", "again"], "two libraries are called Alpha"),
        (["simulate", "Folder.mo"], "Folder.mo is a folder and holds no package.mo"),
        (["simulate", "Wrong.mo"], "Wrong.mo:1:"),
        (["simulate", "Beta.Sub.Plant", *BETA, "-p", "u=12"], "u is an input of Beta.Sub.Plant, not a parameter"),
        (["simulate", "Beta.Sub.Plant", *BETA, "-u", "k=12"], "k is a parameter of Beta.Sub.Plant, not an input"),
        (["simulate", "Beta.Sub.Plant", *BETA, "-u", "v=12"], "no input called v"),
        (["simulate", "Box.mo", "--model", "Box.Smal"], "did you mean Small?"),
        (["list", "models", "Nothing"], "there is no class Nothing"),
        (["simulate", "Modelica.Blocks.Examples.PID_Controller"], "by --library, or in MODELICAPATH"),
        (["sweep", "--points", "2", "--solver", "rk4"], "a sweep is solved by ida, dopri5, rodas4, not by rk4"),
        (["simulate", "Beta.Sub.Plant", *BETA, "--step", "0.1"], "ida chooses its steps itself"),
    ],
)
def test_what_cannot_be_used_is_one_line_with_its_place(words: list[str], expected: str) -> None:
    for option in ([], ["--json"]):
        said = refused(*words, *option)
        assert expected in said
        assert "Traceback" not in said


def test_an_error_is_json_too() -> None:
    result = lacuna("check", "Wrong.mo", "--json")
    assert result.exit_code == 1
    assert "Wrong.mo:1:" in json.loads(result.stdout)["error"]


def test_names_are_completed() -> None:
    def completed(*words: str) -> str:
        text = " ".join(("lacuna", *words))
        variables = {"_LACUNA_COMPLETE": "complete_bash", "COMP_WORDS": text, "COMP_CWORD": str(len(words))}
        return CliRunner().invoke(app, [], prog_name="lacuna", env=variables).output

    assert "Actuators.EccentricBldc" in completed("simulate", "Actuators.Ecc")
    assert "k=" in completed("simulate", "libB/Beta/Sub/Plant.mo", "-L", "libA", "-p", "k")
    assert "u=" in completed("simulate", "libB/Beta/Sub/Plant.mo", "-L", "libA", "-u", "")
