"""Names that a library does not have: the copy lacks a package, or the model was written for another version."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library

PACKAGE = """package Modelica
  package Blocks
    model Gain end Gain;
    package Types constant Real e = 1; end Types;
  end Blocks;
  annotation(version="4.0.0");
end Modelica;
"""
FOR_THREE = '  annotation(uses(Modelica(version="3.2.3")));\n'
OTHER = "the model was written for Modelica 3.2.3, and this is 4.0.0, where names may be others"


def hint_of(folder: Path, body: str) -> str:
    (folder / "library").mkdir()
    (folder / "library" / "Modelica.mo").write_text(PACKAGE, encoding="utf-8")
    (folder / "M.mo").write_text(f"model M\n{body}end M;\n", encoding="utf-8")
    with pytest.raises(Diagnostic) as refused:
        flatten(Library([folder / "library"]), str(folder / "M.mo"))
    return refused.value.hint


@pytest.mark.parametrize("body", ["  Modelica.Fluid.System s;\n", "  import Modelica.Fluid.System;\n  System s;\n"])
def test_a_package_that_this_copy_of_the_library_lacks_is_said_to_be_so(tmp_path: Path, body: str) -> None:
    assert hint_of(tmp_path, body).startswith("this copy of the library Modelica has no Fluid")


def test_further_inside_it_is_not(tmp_path: Path) -> None:
    assert hint_of(tmp_path, "  Modelica.Blocks.Delay s;\n") == "Blocks has Gain, Types"


@pytest.mark.parametrize(
    ("used", "hint"),
    [
        ("Modelica.Blocks.Delay s;", f"Blocks has Gain, Types; {OTHER}"),
        ("Modelica.Blocks.Gains s;", f"did you mean Gain? {OTHER}"),
        ("Real x = Modelica.Blocks.f(time);", f"declare it, or import its package; {OTHER}"),
    ],
)
def test_a_model_for_another_main_version_is_told(tmp_path: Path, used: str, hint: str) -> None:
    assert hint_of(tmp_path, f"  {used}\n{FOR_THREE}") == hint


@pytest.mark.parametrize("uses", ["4.1.0", ""])
def test_one_for_this_is_not(tmp_path: Path, uses: str) -> None:
    annotation = FOR_THREE.replace("3.2.3", uses)
    assert "written for" not in hint_of(tmp_path, f"  Modelica.Blocks.Delay s;\n{annotation}")
