"""Names of version 3 of the Modelica Standard Library in models that are read with version 4 (or a later one)."""

from __future__ import annotations

from pathlib import Path

from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library

STANDARD = """package Modelica
  package Units
    package SI type Length = Real(unit="m"); end SI;
    package NonSI type Angle_deg = Real(unit="deg"); end NonSI;
    package Conversions
      function from_deg input NonSI.Angle_deg d; output Real y; algorithm y := d/180; end from_deg;
    end Conversions;
  end Units;
end Modelica;
"""
MODEL = """model M
  import SI = Modelica.SIunits;
  import Modelica.SIunits.Conversions.from_deg;
  parameter Modelica.SIunits.Conversions.NonSIunits.Angle_deg d = 90;
  SI.Length x = from_deg(d)*time;
end M;
"""


def place(folder: Path, standard: str, model: str) -> tuple[Library, str]:
    (folder / "Modelica.mo").write_text(standard, encoding="utf-8")
    (folder / "M.mo").write_text(model, encoding="utf-8")
    return Library([str(folder / "Modelica.mo")]), str(folder / "M.mo")


def test_old_names_are_read_as_the_new_ones_and_warned_of_once_each(tmp_path: Path) -> None:
    model = flatten(*place(tmp_path, STANDARD, MODEL))
    assert model.variables["x"].unit == "m" and model.variables["d"].unit == "deg"
    said = [(w.code, w.hint) for w in model.warnings if w.code == "W016"]
    assert sorted(said) == [
        ("W016", "write Modelica.Units.Conversions"),
        ("W016", "write Modelica.Units.NonSI"),
        ("W016", "write Modelica.Units.SI"),
    ]


def test_a_library_that_has_the_old_name_is_taken_at_its_word(tmp_path: Path) -> None:
    old = 'package Modelica package SIunits type Length = Real(unit="mm"); end SIunits; end Modelica;'
    model = flatten(*place(tmp_path, old, "model M Modelica.SIunits.Length x = time; end M;"))
    assert model.variables["x"].unit == "mm"
    assert not [w for w in model.warnings if w.code == "W016"]
