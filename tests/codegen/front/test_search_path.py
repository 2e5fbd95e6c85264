"""Models and libraries from anywhere: library paths, MODELICAPATH, classes in files, package folders."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import lacuna
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.search_path import MODEL_FOLDER, WITHOUT_MODELICA, search_path


def write(folder: Path, **files: str) -> Path:
    """Files by name, `__` for a slash and without `.mo`; the folder."""
    for name, text in files.items():
        path = folder / f"{name.replace('__', '/')}.mo"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder


def package(folder: Path, name: str, value: float) -> Path:
    """A package with a model M in a file of its own and a model Sub.N in a folder below, which uses M."""
    return write(
        folder,
        package=f"package {name} end {name};",
        M=f"within {name}; model M Real x = {value}*time; end M;",
        Sub__package=f"within {name}; package Sub end Sub;",
        Sub__N=f"within {name}.Sub; model N extends M; end N;",
    )


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder whose name has a space and umlauts, and which is the present one."""
    folder = tmp_path / "Prüf stand Öl"
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.delenv("MODELICAPATH", raising=False)
    return folder


def factor(library: Library, name: str) -> float:
    """k of `x = k*time`, by which the test tells which class was found."""
    rhs = flatten(library, name).equations[0].rhs
    return float(next(a.value for a in rhs.args if a.op == "const"))


@pytest.mark.parametrize("given", ["Anything", "Anything/package.mo", "Anything/Sub", "."])
def test_a_library_is_named_by_its_folder_its_file_or_the_folder_around_it(place: Path, given: str) -> None:
    package(place / "Anything", "Anything", 3)
    library = Library(search_path([given]))
    assert factor(library, "Anything.Sub.N") == 3
    assert flatten(library, "Lacuna.Actuators.EccentricBldc").name == "Lacuna.Actuators.EccentricBldc"


def test_a_class_in_a_file_of_several(place: Path) -> None:
    write(
        place, Box="package Box model A Real x = 2*time; end A; package In model B extends A; end B; end In; end Box;"
    )
    for name in ("Box.mo:Box.In.B", "Box.mo:In.B", f"{place}/Box.mo:Box.In.B"):
        assert factor(Library(), name) == 2
    with pytest.raises(Diagnostic) as refused:
        flatten(Library(), "Box.mo")
    assert "Box is a package" in refused.value.message
    assert "Box.A or Box.In.B" in refused.value.hint


def test_a_package_folder_of_the_user_needs_no_library_path(place: Path) -> None:
    package(place / "Own", "Own", 5)
    for name in ("Own/Sub/N.mo", "Own:Own.Sub.N", "./Own:Sub.N", "Own/package.mo:Own.M"):
        assert factor(Library(), name) == 5


def test_modelicapath_is_searched_in_order_and_after_named_libraries(place: Path, monkeypatch) -> None:
    for folder, value in (("first", 2), ("second", 3), ("named", 4)):
        package(place / folder / "Lib", "Lib", value)
    package(place / "second" / "Other 2.1.0", "Other", 7)
    package(place / "second" / "Other 10.0", "Other", 8)
    monkeypatch.setenv("MODELICAPATH", os.pathsep.join(["nowhere", str(place / "first"), str(place / "second")]))
    assert factor(Library(), "Lib.M") == 2
    assert factor(Library(), "Other.M") == 8  # the newest of its versions
    assert factor(Library(search_path(["named"])), "Lib.M") == 4


@pytest.mark.parametrize("text", ["Modelica.Blocks.Math.Gain g;", "import Modelica.Blocks; Blocks.Math.Gain g;"])
def test_where_the_standard_library_is_to_be_named_is_said_however_it_is_used(place: Path, text: str) -> None:
    (place / "A.mo").write_text(f"model A {text} end A;")
    with pytest.raises(Diagnostic) as found:
        flatten(Library(), "A.mo")
    assert found.value.hint == WITHOUT_MODELICA


def test_a_copy_of_lacuna_stands_in_for_the_one_that_came(place: Path) -> None:
    write(place, copy__package="package Lacuna model M Real x = 4*time; end M; end Lacuna;")
    assert factor(Library(search_path(["copy"])), "Lacuna.M") == 4
    assert search_path(["copy"]) == [str(place / "copy"), str(MODEL_FOLDER)]


def test_the_file_of_a_model_hides_nothing_of_another_model(place: Path) -> None:
    write(place, a__Part="model Part Real x = 3*time; end Part;", a__M="model M extends Part; end M;")
    write(place, b__Part="model Part Real x = 2*time; end Part;", b__M="model M extends Part; end M;")
    assert [factor(Library(), f"{folder}/M.mo") for folder in "ab"] == [3, 2]


@pytest.mark.parametrize(
    ("libraries", "code", "said"),
    [
        (["nowhere"], "F005", "there is no library at"),
        (["empty"], "F005", "holds no package"),
        (["notes.txt"], "F005", "holds no package"),
        (["one", "two"], "F006", "two libraries are called Lib"),
        (["one/Lib", "two"], "F006", "two libraries are called Lib"),
    ],
)
def test_library_paths_that_cannot_be_used(place: Path, libraries: list[str], code: str, said: str) -> None:
    (place / "empty").mkdir()
    (place / "notes.txt").write_text("no model", encoding="utf-8")
    for folder in ("one", "two"):
        package(place / folder / "Lib", "Lib", 1)
    with pytest.raises(Diagnostic) as refused:
        search_path(libraries)
    assert (refused.value.code, said in refused.value.message) == (code, True)
    assert str(place / libraries[-1]) in refused.value.message


@pytest.mark.parametrize(
    ("name", "code"),
    [("Folder.mo", "F007"), ("./Folder.mo", "F007"), (".", "F007"), ("", "F007"), ("no/such.mo", "F001")],
)
def test_a_model_file_that_is_none(place: Path, name: str, code: str) -> None:
    (place / "Folder.mo").mkdir()
    with pytest.raises(Diagnostic) as refused:
        Library().find(name)
    assert refused.value.code == code
    assert refused.value.hint


ONE_FILE = """package Tabs
  model Sched
    parameter String f = Modelica.Utilities.Files.loadResource("modelica://Tabs/sched.txt");
    Modelica.Blocks.Sources.CombiTimeTable t(tableOnFile=true, tableName="s", fileName=f);
  end Sched;
end Tabs;
"""


def test_data_of_a_package_in_one_file_lie_in_the_folder_of_that_file(tmp_path: Path, shared: Path) -> None:
    if not (shared / "msl" / "Modelica").is_dir():
        pytest.skip("the Modelica Standard Library is not there")
    (tmp_path / "Tabs.mo").write_text(ONE_FILE, encoding="utf-8")
    (tmp_path / "sched.txt").write_text("#1\ndouble s(2,2)\n0 1\n2 5\n", encoding="utf-8")
    result = lacuna.load(f"{tmp_path / 'Tabs.mo'}:Tabs.Sched", libraries=[str(shared / "msl")]).simulate(stop=1.0)
    assert result["t.y[1]"][-1] == pytest.approx(3)
