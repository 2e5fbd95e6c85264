"""Every file of the library: it parses elsewhere too, is documented, and every model flattens."""

from __future__ import annotations

from pathlib import Path
import re

import pytest

from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library

MODEL = Path(__file__).parents[2] / "model"
FILES = sorted(MODEL.rglob("*.mo"))
WHOLE = [
    f for f in FILES if f.parent.parent.name == "Components" or f.parts[-2] in ("Actuators", "Benches", "Scenarios")
]


def qualified(file: Path) -> str:
    return ".".join(file.relative_to(MODEL).with_suffix("").parts)


@pytest.mark.parametrize("file", [f for f in WHOLE if f.name != "package.mo"], ids=qualified)
def test_flattens_without_a_finding(file: Path) -> None:
    """A component alone may lack values that only its user can give (W001); a whole model may not."""
    if "parameter String" in file.read_text() and "Components" in file.parts:
        pytest.skip("needs the name of a file")
    model = flatten(Library(), qualified(file))
    accepted = {"W001"} if "Components" in file.parts else set()
    assert [str(w) for w in model.warnings if w.code not in accepted] == []
    undescribed = [v.name for v in model.variables.values() if not v.description and v.variability != "constant"]
    assert undescribed == []


@pytest.mark.parametrize("file", FILES, ids=lambda f: str(f.relative_to(MODEL)))
def test_is_one_documented_class_in_its_package(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    name = file.parent.name if file.name == "package.mo" else file.stem
    name = "Lacuna" if file == MODEL / "package.mo" else name
    assert re.search(rf'\b(model|block|connector|package|function|type) {name}\b[^"\n]*"[^"]+"', text), "no description"
    assert text.rstrip().endswith(f"end {name};") or f"connector {name} =" in text
    assert text.isascii() and "\t" not in text


@pytest.mark.parametrize("file", FILES, ids=lambda f: str(f.relative_to(MODEL)))
def test_parses_in_another_translator(file: Path) -> None:
    rumoca = pytest.importorskip("rumoca", reason="needs rumoca, another translator of the same language")
    rumoca.format(file.read_text(encoding="utf-8"), filename=file.name)


@pytest.mark.parametrize(
    "model", ["Benches.DcServo", "Benches.ScrewEma", "Benches.BldcDrive", "Actuators.EccentricBldc"]
)
def test_compiles_in_another_translator(model: str) -> None:
    rumoca = pytest.importorskip("rumoca", reason="needs rumoca, another translator of the same language")
    loaded = rumoca.Session(roots=[str(MODEL)]).load(str(MODEL / "package.mo"), model=f"Lacuna.{model}")
    assert loaded.structure().is_balanced
