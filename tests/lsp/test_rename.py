"""A new name goes where the old one is meant, and nowhere else; where that cannot be, it is refused."""

from __future__ import annotations

from pathlib import Path

from lsprotocol import types as lsp
import pytest

from lacuna.codegen.library.search_path import MODEL_FOLDER
from lacuna.lsp.features import Workspace
from lacuna.lsp.positions import Positions
from lacuna.lsp.rename import Refused, rename

MODEL = """function f
  input Real k;
  input Real x;
  output Real y;
algorithm
  y := k*x;
end f;
record Rec
  Real k;
end Rec;
model A
  parameter Real k = 2;
  parameter Real L = 3;
  Real x(start = k, fixed = true);
  Rec r = Rec(k = 4);
equation
  der(x) = -f(k = k, x = x) + L*sum(i*k for i in 1:3);
end A;
"""


def renamed(tmp_path: Path, marked: str, new: str, text: str = MODEL) -> str:
    """The text with another name for what is at the `|` in `marked`, which is part of the text without it."""
    path = (tmp_path / "A.mo").resolve()
    path.write_text(text, encoding="utf-8")
    offset = text.index(marked.replace("|", "")) + marked.index("|")
    line, character = text.count("\n", 0, offset), offset - (text.rfind("\n", 0, offset) + 1)
    lines = text.split("\n")
    places = rename(Workspace([str(MODEL_FOLDER)]), path, line, character, new)
    for _, span in sorted(places, key=lambda p: (p[1].line, -p[1].column)):
        row, start = lines[span.line - 1], span.column - 1
        lines[span.line - 1] = row[:start] + new + row[start + span.length :]
    return "\n".join(lines)


def test_names_of_arguments_are_those_of_the_function_and_of_the_record(tmp_path: Path) -> None:
    found = renamed(tmp_path, "parameter Real |k", "gain")
    assert "f(k = gain, x = x)" in found and "Rec(k = 4)" in found and "i*gain for" in found
    found = renamed(tmp_path, "input Real |k", "gain")
    assert "f(gain = k, x = x)" in found and "y := gain*x" in found and "parameter Real k" in found
    found = renamed(tmp_path, "Rec(|k", "gain")
    assert "Rec(gain = 4)" in found and "  Real gain;" in found and "f(k = k" in found


@pytest.mark.parametrize("new", ["L", "i", "x", "time", "der"])
def test_a_name_that_stands_for_something_else_is_refused(tmp_path: Path, new: str) -> None:
    with pytest.raises(Refused):
        renamed(tmp_path, "parameter Real |k", new)


def test_another_name_by_an_import_is_not_the_class(tmp_path: Path) -> None:
    text = "package P\n  package Q\n    constant Real c = 1;\n  end Q;\n  model M\n    import S = P.Q;\n"
    text += "    Real x = S.c;\n  end M;\nend P;\n"
    with pytest.raises(Refused, match="another name"):
        renamed(tmp_path, "x = |S", "T", text)
    assert "constant Real d" in (found := renamed(tmp_path, "constant Real |c", "d", text)) and "S.d" in found


def test_places_are_counted_in_utf_16(tmp_path: Path) -> None:
    path = (tmp_path / "A.mo").resolve()
    path.write_text('model A "𝛼"\n  Real x "😀😀"; Real L = x;\nend A;\n', encoding="utf-8")
    workspace = Workspace([str(MODEL_FOLDER)])
    positions = Positions(workspace.text)
    units = len('  Real x "😀😀"; Real '.encode("utf-16-le")) // 2
    assert positions.place(path, lsp.Position(1, units)) == (1, len('  Real x "😀😀"; Real '))
    (place,) = rename(workspace, path, *positions.place(path, lsp.Position(1, units)), "M")
    assert positions.range(place[1]) == lsp.Range(lsp.Position(1, units), lsp.Position(1, units + 1))
    assert positions.marked(path, positions.range(place[1])) == "L"
    assert positions.place(path, lsp.Position(1, 1000)) == (1, 1000 - 2) and positions.marked(
        path, lsp.Range(lsp.Position(9, 0), lsp.Position(9, 4))
    ) == ""  # fmt: skip
