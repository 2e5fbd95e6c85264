"""Finding classes: folders as packages, single files, names that are not there."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from tests.codegen.front.helpers import equations


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """Package Lacuna with a class of its own, a file and a nested folder."""
    files = {
        "package.mo": "package Lacuna constant Real g = 9.81; model Tiny Real x = g*time; end Tiny; end Lacuna;",
        "Big.mo": "within Lacuna; model Big Parts.Wheel wheel; Tiny tiny; end Big;",
        "Parts/package.mo": "within Lacuna; package Parts end Parts;",
        "Parts/Wheel.mo": "within Lacuna.Parts; model Wheel extends Tiny; end Wheel;",
    }
    for name, text in files.items():
        path = tmp_path / "model" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return tmp_path / "model"


@pytest.mark.parametrize("name", ["Lacuna.Big", "Big", "{tree}/Big.mo"])
def test_a_class_has_several_names(tree: Path, name: str) -> None:
    model = flatten(Library([tree]), name.format(tree=tree))
    assert model.name == "Lacuna.Big"
    assert equations(model) == ["wheel.x = Lacuna.g * time", "tiny.x = Lacuna.g * time"]


def test_only_what_is_needed_is_read(tree: Path) -> None:
    library = Library([tree])
    flatten(library, "Parts.Wheel")
    assert sorted(Path(f).name for f in library.files) == ["Wheel.mo", "package.mo", "package.mo"]
    assert all(len(digest) == 64 for digest in library.files.values())


def test_every_class_is_listed(tree: Path) -> None:
    found = [cls.path for cls in Library([tree]).all_classes()]
    assert found == ["Lacuna", "Lacuna.Big", "Lacuna.Parts", "Lacuna.Parts.Wheel", "Lacuna.Tiny"]


def test_a_changed_file_is_read_again(tree: Path) -> None:
    flatten(Library([tree]), "Big")
    wheel = tree / "Parts/Wheel.mo"
    wheel.write_text("within Lacuna.Parts; model Wheel Real y = 2*time; end Wheel;", encoding="utf-8")
    assert equations(flatten(Library([tree]), "Big"))[0] == "wheel.y = 2 * time"


@pytest.mark.parametrize(
    ("name", "hint"),
    [("Bog", "did you mean Big?"), ("Parts.Weel", "did you mean Wheel?"), ("Lacuna.Parts.Zzz", "there is Wheel")],
)
def test_an_unknown_name_is_answered_with_known_ones(tree: Path, name: str, hint: str) -> None:
    with pytest.raises(Diagnostic) as refused:
        Library([tree]).find(name)
    assert (refused.value.code, refused.value.hint) == ("R001", hint)


@pytest.mark.parametrize(
    ("file", "text", "name", "code"),
    [
        (None, "", "nowhere.mo", "F001"),
        ("Latin.mo", b"model Latin \xe9 end Latin;", "Latin", "F001"),
        ("Bare/Thing.mo", "within Lacuna.Bare; model Thing end Thing;", "Bare.Thing", "F002"),
        ("Shaft.mo", "within Lacuna; model Axle end Axle;", "Shaft", "F003"),
        ("Shaft.mo", "model Shaft end Shaft;", "Shaft", "F004"),
        ("Parts/Hub.mo", "within Lacuna; model Hub end Hub;", "Parts.Hub", "F004"),
        ("Two.mo", "within Lacuna; model Two end Two; model Three end Three;", "Two", "F003"),
        ("Half.mo", "within Lacuna; partial model Half end Half;", "Half", "F003"),
    ],
)
def test_misplaced_files_are_refused(tree: Path, file: str | None, text: str | bytes, name: str, code: str) -> None:
    if file is not None:
        path = tree / file
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(Diagnostic) as refused:
        flatten(Library([tree]), name)
    assert refused.value.code == code
    assert refused.value.hint


def test_a_package_without_a_class_of_that_name_says_what_it_has(tmp_path: Path) -> None:
    path = tmp_path / "M.mo"
    path.write_text("model M package P model Cuboid end Cuboid; end P; P.AirGap gap; end M;", encoding="utf-8")
    with pytest.raises(Diagnostic) as refused:
        flatten(Library([tmp_path]), str(path))
    assert (refused.value.code, refused.value.hint) == ("R001", "P has Cuboid")
