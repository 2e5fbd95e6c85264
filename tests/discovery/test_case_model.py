"""Cases on models that are not ours: where the class is looked up, what its file may say, and how it ends."""

from __future__ import annotations

import json
import os
from pathlib import Path
import re
import shutil

import numpy as np
import pytest

import lacuna
from lacuna.codegen.compile import compile_model
from lacuna.codegen.errors import Diagnostic
from lacuna.discovery.case import case_keys
from lacuna.discovery.case.cases import load
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.case.recordings_check import check_case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.explain import explain, judge_written, write_amended
from lacuna.discovery.explanation import diagnosis, report
from lacuna.discovery.fit.fit import believed
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.naming.judge import judge_file

from .recorded import TANK

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("LACUNA_SHARED", ROOT.parent / "shared"))
CASE = """title = "Tank"
model = "{model}"
{libraries}
[parameters]
k = 2.8e-4
[uncertainty]
A = 0.02
k = 0.2
[signals.q]
role = "input"
unit = "m3/s"
[signals.h]
role = "output"
unit = "m"
noise_std = 0.002
[recordings]
fit = ["r1.csv"]
validate = ["r2.csv"]
"""


def tank_case(folder: Path, model: str = "Tank.mo", libraries: str = "", source: str = TANK, k: float = 3e-4) -> Path:
    """A case of a linear tank, from its closed form: h relaxes to q/k with the time constant A/k."""
    folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(1)
    time = np.arange(200) * 1.0
    for n, q in ((1, 9e-5), (2, 3e-5)):
        h = q / k + (0.2 - q / k) * np.exp(-time * k / 0.01) + 0.002 * random.normal(size=200)
        np.savetxt(folder / f"r{n}.csv", np.column_stack([time, np.full(200, q), h]), "%.6g", ",",
                   header="time,q,h", comments="")  # fmt: skip
    (folder / "case.toml").write_text(CASE.format(model=model, libraries=libraries), encoding="utf-8")
    if source:
        (folder / "Tank.mo").write_text(source.format(outflow="k*h"), encoding="utf-8")
    return folder


def simulated(folder: Path) -> float:
    """RMS error of the case's believed model, in units of noise, with the true values put in."""
    case = load(folder)
    machine = Machine(case, Amendment(read(case.library(), case.base)))
    residual = case.fit[0].columns["h"] - machine.simulate({"k": 3e-4}, case.fit[0])["h"]
    return float(np.sqrt(np.mean(residual**2))) / 0.002


def test_a_file_beside_the_case(tmp_path: Path) -> None:
    assert simulated(tank_case(tmp_path / "ä case")) == pytest.approx(1.0, abs=0.15)


def test_two_models_of_one_name_in_two_cases_are_two_models(tmp_path: Path) -> None:
    right, wrong = tank_case(tmp_path / "a"), tank_case(tmp_path / "b")
    (wrong / "Tank.mo").write_text(TANK.format(outflow="2*k*h"), encoding="utf-8")
    assert simulated(right) == pytest.approx(1.0, abs=0.15)
    assert simulated(wrong) > 10
    assert simulated(right) == pytest.approx(1.0, abs=0.15)


def test_a_class_in_a_package_file_and_in_a_package_folder(tmp_path: Path) -> None:
    one = tank_case(tmp_path / "one", "Plant.mo:Plant.Tank", source="")
    (one / "Plant.mo").write_text(f"package Plant\n{TANK.format(outflow='k*h')}end Plant;\n", encoding="utf-8")
    assert simulated(one) == pytest.approx(1.0, abs=0.15)
    folder = tmp_path / "lib" / "Works"
    folder.mkdir(parents=True)
    (folder / "package.mo").write_text("package Works\nend Works;\n", encoding="utf-8")
    (folder / "Tank.mo").write_text("within Works;\n" + TANK.format(outflow="k*h"), encoding="utf-8")
    for model, libraries in (("Works.Tank", 'libraries = ["../lib/Works"]'), ("../lib/Works/Tank.mo", "")):
        case = tank_case(tmp_path / f"case{len(libraries)}", model, libraries, source="")
        assert load(case).base == "Works.Tank"
        assert simulated(case) == pytest.approx(1.0, abs=0.15)


PLANT = """package Plant
  model Wall "Loses heat" parameter Real G(unit="W/K") = 2; parameter Real a(unit="1") = 1; Real q(unit="W");
    input Real dT(unit="K") = 1; equation q = a*G*dT; end Wall;
  model Tank
    parameter Real A(unit="m2") = 0.01;
    parameter Real k(unit="m2/s") = 3e-4;
    parameter Real G(unit="W/K") = 3;
    input Real q(unit="m3/s");
    Real h(unit="m", start=0.2, fixed=true);
    Wall north(G=2*2.5), south(G=G), east[2](G={5.0, 6.0}), west;
  equation
    A*der(h) = q - k*h;
  end Tank;
end Plant;
"""


def test_what_is_believed_is_what_the_model_writes(tmp_path: Path) -> None:
    """Its own parameters, and numbers that it gives to its components; what a component's class says is exact."""
    folder = tank_case(tmp_path, "Plant.mo:Plant.Tank", source="")
    (folder / "Plant.mo").write_text(PLANT, encoding="utf-8")
    case = load(folder)
    free, _ = believed(case, Machine(case, Amendment(read(case.library(), case.base))))
    sigmas = {f.name: f.sigma for f in free if f.name.endswith("G") or "." in f.name}
    assert sigmas == pytest.approx({"G": 0.15, "north.G": 0.25, "east[1].G": 0.25, "east[2].G": 0.3})


def test_a_library_given_to_the_command(tmp_path: Path) -> None:
    folder = tmp_path / "lib" / "Works"
    folder.mkdir(parents=True)
    (folder / "package.mo").write_text("package Works\nend Works;\n", encoding="utf-8")
    (folder / "Tank.mo").write_text("within Works;\n" + TANK.format(outflow="k*h"), encoding="utf-8")
    case = tank_case(tmp_path / "case", "Works.Tank", "", source="")
    with pytest.raises(Diagnostic, match="Works"):
        lacuna.open_case(case)
    assert lacuna.open_case(case, libraries=[folder]).model == "Works.Tank"


def test_a_model_that_extends_one_of_ours(tmp_path: Path, consistent_case: Path) -> None:
    shutil.copytree(consistent_case, tmp_path / "case")
    (tmp_path / "case" / "Mine.mo").write_text("model Mine\n  extends Lacuna.Benches.DcServo;\nend Mine;\n")
    file = tmp_path / "case" / "case.toml"
    file.write_text(file.read_text().replace("Benches.DcServo", "Mine.mo"))
    result = explain(load(tmp_path / "case"))
    assert result.verdict == "consistent"
    path = write_amended(result, tmp_path)
    assert (tmp_path / "Mine.mo").is_file()  # so that both open together
    compile_model(str(path))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[uncertainty]", "[uncertanty]", "no table `uncertanty`; did you mean uncertainty"),
        ('title = "Tank"', 'titel = "Tank"', "no key `titel`; did you mean title"),
        ('role = "input"', 'roles = "input"', r"\[signals.q\] has no role"),
        ('role = "input"', 'role = "input"\nnoise_sd = 1', r"\[signals.q\] there is no key `noise_sd`; did you mean"),
        ("k = 2.8e-4", 'k = "much"', r"\[parameters\] k = 'much'; it must be a finite number"),
        ("A = 0.02", "A = -1", "must be a finite number of at least 0"),
        ('fit = ["r1.csv"]', "fit = []", "must be a list of at least one file"),
        ('fit = ["r1.csv"]', 'fit = ["r1.csv", "r1.csv"]', "r1.csv is named twice"),
        ('fit = ["r1.csv"]', 'fit = ["r2.csv"]', "r2.csv is named twice in .recordings.; none judges what was fitted"),
        ("k = 2.8e-4", "k = 1e300", "must be a finite number of at most 1e150"),
        ("k = 2.8e-4", f"k = {'9' * 400}", "whole number of more than 18 digits"),
        ('role = "input"', 'role = "input"\nnoise_std = 1e-300', "must be a positive number from 1e-150"),
        ("[recordings]", '[recording."r3.csv"]\nparameters = {k = 1}\n[recordings]', "none of the recordings"),
        ("[recordings]", "[limits.q]\nmaximum = 1\n[recordings]", r"\[limits.q\] there is no key `maximum`"),
        ('model = "Tank.mo"', 'model = "Tanks.mo"', "cannot read .*Tanks.mo"),
        ('model = "Tank.mo"', 'model = "Tank.mo"\nlibraries = ["nowhere"]', "no library at .*nowhere"),
        ('model = "Tank.mo"', 'model = "Tank.mo"\nlibraries = ["empty"]', "empty holds no package"),
        (
            'model = "Tank.mo"',
            'model = "Tank.mo"\nlibraries = ["a/X", "b/X"]',
            "two libraries are called X: .*a/X and .*b/X",
        ),
        ('model = "Tank.mo"', 'model = "empty.mo"', "empty.mo is a folder"),
        ('model = "Tank.mo"', 'model = "Benches.DcServ"', "no class DcServ"),
    ],
)
def test_what_case_toml_may_not_say_is_named(tmp_path: Path, old: str, new: str, message: str) -> None:
    tank_case(tmp_path)
    (tmp_path / "empty").mkdir()
    (tmp_path / "empty.mo").mkdir()
    for library in ("a/X", "b/X"):
        (tmp_path / library).mkdir(parents=True)
        (tmp_path / library / "package.mo").write_text("package X\nend X;\n", encoding="utf-8")
    file = tmp_path / "case.toml"
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises((CaseError, Diagnostic), match=message):
        load(tmp_path)


def test_what_holds_in_one_recording_only(tmp_path: Path) -> None:
    tank_case(tmp_path)
    with (tmp_path / "case.toml").open("a", encoding="utf-8") as file:
        file.write(
            '[recording."r1.csv"]\nparameters = {A = 0.02}\nuncertainty = {A = 0.0, k = 0.1}\ninitial = {h = 0.4}\n'
        )
    case = load(tmp_path)
    machine = Machine(case, Amendment(read(case.library(), case.base)))
    free, fixed = believed(case, machine)
    assert fixed["A@r1.csv"] == 0.02
    assert {f.name: f.sigma for f in free}["k@r1.csv"] == pytest.approx(2.8e-5)
    point = fixed | {f.name: f.centre for f in free} | {"k@r1.csv": 4e-4}
    r1, r2 = case.fit[0], case.validate[0]
    own = 9e-5 / 4e-4 + (0.4 - 9e-5 / 4e-4) * np.exp(-r1.time * 4e-4 / 0.02)
    common = 3e-5 / 2.8e-4 + (0.2 - 3e-5 / 2.8e-4) * np.exp(-r2.time * 2.8e-4 / 0.01)
    np.testing.assert_allclose(machine.simulate(point, r1)["h"], own, rtol=1e-5)
    np.testing.assert_allclose(machine.simulate(point, r2)["h"], common, rtol=1e-5)


def test_the_reference_says_what_the_reader_accepts() -> None:
    assert (ROOT / "docs" / "guide" / "case-file.md").read_text(encoding="utf-8") == case_keys.reference()


@pytest.mark.parametrize("name", ["q04", "q05", "q06"])
def test_cases_on_machines_of_others_end_honestly(name: str, tmp_path: Path) -> None:
    folder = SHARED / "recordings" / "own" / name
    if not folder.is_dir():
        pytest.skip(f"{folder} is not there; LACUNA_SHARED names the folder of shared data")
    result = explain(load(folder), limit=60)
    path = write_amended(result, tmp_path)
    judge_written(result, path)
    written = json.loads(diagnosis.write(result, tmp_path, path).read_text())
    assert report.write(result, tmp_path, path).is_file()
    assert not any(f["location"].startswith("sensor:") for f in written["findings"])
    assert (written["verdict"] == "consistent") == (name == "q06")
    judged = judge_file(result.case, Amendment(read(result.case.library(), result.case.base)), path, {})
    assert judged.validate[""] <= 1.001 * written["nrmse"]["validate"]["after"]


def copied_out(case: Path, folder: Path, style: str) -> Path:
    """A case on a bench of ours, its model copied beside it as a user would: as it is, or with imports of its own."""
    shutil.copytree(case, folder)
    text = (folder / "case.toml").read_text(encoding="utf-8")
    bench = re.search(r"Benches\.(\w+)", text)[1]
    source = (ROOT / "model" / "Benches" / f"{bench}.mo").read_text(encoding="utf-8")
    if style == "import":
        source = re.sub(r"^within .*\n", "", source)
        source = re.sub(rf"^(model|end) {bench}\b", r"\1 Mine", source, flags=re.MULTILINE)
        imports = "  import Lacuna.Types;\n  import Lacuna.Components;\n"
        source = source.replace("\n", f"\n{imports}", 1)
    name = "Mine" if style == "import" else bench
    (folder / f"{name}.mo").write_text(source, encoding="utf-8")
    (folder / "case.toml").write_text(text.replace(f"Benches.{bench}", f"{name}.mo"), encoding="utf-8")
    return folder


@pytest.mark.parametrize("style", ["within", "import"])
@pytest.mark.parametrize("name", ["p01", "p06", "p09"])
def test_a_bench_copied_out_is_the_same_machine(name: str, style: str, shared: Path, tmp_path: Path) -> None:
    original = shared / "recordings" / "practice" / name
    theirs, ours = load(copied_out(original, tmp_path / "Prüf stand", style)), load(original)
    structures = [read(case.library(), case.base) for case in (theirs, ours)]
    assert (structures[0].shafts, structures[0].lines) == (structures[1].shafts, structures[1].lines)
    machines = [Machine(case, Amendment(s)) for case, s in zip((theirs, ours), structures, strict=True)]
    runs = [machine.simulate(ours.parameters, ours.fit[0]) for machine in machines]
    for signal in ours.outputs:
        np.testing.assert_array_equal(runs[0][signal.column], runs[1][signal.column])


@pytest.mark.parametrize("style", ["within", "import"])
def test_what_is_edited_in_a_copied_bench_counts(style: str, consistent_case: Path, tmp_path: Path) -> None:
    folder = copied_out(consistent_case, tmp_path / "case", style)
    file = next(folder.glob("*.mo"))
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("shaft(J=J,", "shaft(J=2*J,"), encoding="utf-8")
    case = load(folder)
    machine = Machine(case, Amendment(read(case.library(), case.base)))
    halved = {**case.parameters, "J": case.parameters["J"] / 2}
    original = load(consistent_case)
    believed = Machine(original, Amendment(read(original.library(), original.base)))
    for column, values in believed.simulate(original.parameters, original.fit[0]).items():
        np.testing.assert_allclose(machine.simulate(halved, case.fit[0])[column], values, rtol=1e-5, atol=1e-6)
    found = lacuna.open_case(folder).fit(out=tmp_path / "out")
    assert found.parameters["J"]["value"] == pytest.approx(3.7e-6, rel=0.03)  # half of what moves it
    file.write_text(text.replace("winding.i", "windng.i"), encoding="utf-8")
    with pytest.raises(Diagnostic, match=rf"{file.name}:\d+:\d+:.*no variable windng"):
        lacuna.open_case(folder).fit(out=tmp_path / "out")


@pytest.mark.slow
@pytest.mark.parametrize("style", ["within", "import"])
def test_a_bench_copied_out_is_explained(style: str, shared: Path, tmp_path: Path) -> None:
    case = copied_out(shared / "recordings" / "practice" / "p03", tmp_path / "Prüf stand", style)
    found = lacuna.explain(case, out=tmp_path / "out")
    assert [(f["effect"], f["location"]) for f in found.findings] == [("friction.coulomb", "shaft")]
    compile_model(str(found.amended))
    assert found.report.is_file()


def test_a_copy_of_a_recording_is_told(tmp_path: Path) -> None:
    tank_case(tmp_path)
    shutil.copy(tmp_path / "r1.csv", tmp_path / "r2.csv")
    (found,) = [p for p in check_case(load(tmp_path)) if p.kind == "copy"]
    assert str(found) == "r2.csv: it holds the samples of r1.csv: what it judges was fitted to it"
