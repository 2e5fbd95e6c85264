"""The wheel, built from the sdist, installed into an empty environment and tried from a folder with an awkward name.

Needs the package index, as the set-up of a checkout does. What it installs comes from there or from pip's cache.
"""

from __future__ import annotations

from pathlib import Path
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
import zipfile

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
# One xdist worker builds once for all tests of this file.
pytestmark = [pytest.mark.xdist_group("wheel"), pytest.mark.timeout(900)]  # the set-up counts in the first test's time


def run(*command: str | Path, cwd: Path, status: int = 0) -> str:
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True, check=False, timeout=800)
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.fixture(scope="module")
def sdist(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of what git knows, so that nothing built in this checkout travels, as an sdist."""
    folder = tmp_path_factory.mktemp("sdist")
    names = run("git", "ls-files", "--cached", "--others", "--exclude-standard", "-z", cwd=ROOT).split("\0")
    for name in filter(None, names):
        if (ROOT / name).is_file():
            (folder / "tree" / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / "tree" / name)
    code = f"from scikit_build_core.build import build_sdist; build_sdist({str(folder)!r})"
    run(sys.executable, "-c", code, cwd=folder / "tree")
    return next(folder.glob("*.tar.gz"))


@pytest.fixture(scope="module")
def wheel(sdist: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    run(
        sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "-w", folder, sdist, cwd=folder
    )
    return next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def empty(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """bin/ of a fresh environment that holds the wheel and what it requires, no extra."""
    folder = tmp_path_factory.mktemp("empty")
    run(sys.executable, "-m", "venv", folder / "env", cwd=folder)
    run(folder / "env/bin/python", "-m", "pip", "install", "-q", "--prefer-binary", wheel, cwd=folder)
    return folder / "env" / "bin"


@pytest.fixture(scope="module")
def whole(empty: Path, wheel: Path) -> Path:
    """The same environment with every extra."""
    run(empty / "python", "-m", "pip", "install", "-q", "--prefer-binary", f"{wheel}[all]", cwd=empty)
    return empty


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv("LACUNA_BUILD", raising=False)
    monkeypatch.setenv("LACUNA_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "Prüfstand zwei"
    folder.mkdir()
    return folder


def test_sdist_holds_the_sources_and_nothing_built(sdist: Path) -> None:
    with tarfile.open(sdist) as archive:
        names = {str(Path(*Path(name).parts[1:])) for name in archive.getnames()}
    assert {"VERSION", "CMakeLists.txt", "runtime/src/simulate.c", "codegen/compile.py", "model/package.mo"} <= names
    assert [name for name in names if name.endswith((".so", ".o", ".pyc"))] == []


def test_wheel_holds_the_package_and_nothing_beside_it(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.split("/")[0] for name in names} == {"lacuna", re.sub(r"-py3.*", ".dist-info", wheel.name)}
    libraries = [name for name in names if name.endswith(".so")]
    assert sorted(libraries) == ["lacuna/lib/liblacuna_analysis.so", "lacuna/lib/liblacuna_runtime.so"]
    assert not wheel.name.endswith("-any.whl")
    wanted = ("runtime/include/mdl_abi.h", "model/package.mo", "analysis/settings/paper.toml", "py.typed")
    assert [name for name in wanted if f"lacuna/{name}" not in names] == []
    assert [name for name in names if re.search(r"tests?/|bench/|\.(cpp|hpp)$|CMakeLists", name)] == []
    carried = [name for name in names if name.endswith(".c")]  # an FMU holds its source
    assert {name.rsplit("/", 1)[0] for name in carried} == {"lacuna/runtime/src", "lacuna/fmi/src"}


def test_every_data_file_of_the_tree_travels(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    data = ("*.mo", "*.toml", "*.html.in", "*.css", "*.html")
    for stage in ("model", "codegen", "runtime", "analysis", "discovery", "fmi", "lsp", "cli", "lacuna"):
        folder = "lacuna" if stage == "lacuna" else f"lacuna/{stage}"
        tree = run(
            "git", "ls-files", "--", *(f"{stage}/**/{p}" for p in data), *(f"{stage}/{p}" for p in data), cwd=ROOT
        )
        missing = [f for f in tree.split() if f"{folder}/{f.removeprefix(stage + '/')}" not in names]
        assert missing == []


def test_nothing_in_the_wheel_is_gpl(wheel: Path, tmp_path: Path) -> None:
    zipfile.ZipFile(wheel).extract("lacuna/lib/liblacuna_analysis.so", tmp_path)
    assert "fftw" not in run("objdump", "-p", tmp_path / "lacuna/lib/liblacuna_analysis.so", cwd=tmp_path)


def test_required_packages_are_enough_to_simulate(empty: Path, place: Path) -> None:
    run(empty / "lacuna", "simulate", "Actuators.EccentricBldc", "-p", "zeta=0.3", "--stop", "0.01", cwd=place)
    assert list(place.rglob("*.csv"))


@pytest.mark.parametrize(
    "command", [["maps"], ["sweep", "missing.toml"], ["simulate", "Actuators.EccentricBldc", "--plot"]]
)
def test_a_missing_extra_is_named_in_one_line(empty: Path, place: Path, command: list[str]) -> None:
    if (empty / "dask").exists():
        pytest.skip("the extras are installed already: run this file whole")
    said = run(empty / "lacuna", *command, cwd=place, status=1)
    assert re.search(r"pip install 'lacuna\[\w+\]'", said), said
    assert "Traceback" not in said


def edited_as_the_tour_says(folder: Path) -> None:
    old, new = re.search(r"```diff\n-(.*)\n\+(.*)\n```", README).groups()
    file = folder / "lacuna-examples/Lacuna/Components/Drives/StarWinding.mo"
    text = file.read_text(encoding="utf-8")
    assert text.count(old) == 1
    file.write_text(text.replace(old, new), encoding="utf-8")


def test_the_readmes_ten_minutes_typed_from_the_wheel(whole: Path, place: Path) -> None:
    said = {}
    for line in re.findall(r"^    (lacuna [^#\n]*)", README, re.MULTILINE):
        command = shlex.split(line)
        if command[1:3] == ["maps", "-L"]:
            edited_as_the_tour_says(place)
        said[command[1]] = run(whole / command[0], *command[1:], cwd=place)
    assert set(said) == {"examples", "simulate", "maps", "compile", "assess", "explain", "case"}
    assert "moderate mode" in said["assess"]  # the test was made at 22 %
    assert "dry friction" in said["explain"]
    assert (place / "my-case/case.toml").is_file()


def test_a_sweep_runs_from_another_folder(whole: Path, place: Path) -> None:
    run(whole / "lacuna", "sweep", "--points", "4", "--chunk", "2", "--out", "Streuung", cwd=place)
    assert (place / "Streuung" / "results.parquet").exists()
