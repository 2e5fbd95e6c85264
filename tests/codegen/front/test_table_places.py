"""What is wrong with a table names the component that has it, not only the library that reads it."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten import flatten
from lacuna.codegen.flatten.functions.library.tables.files import FileError, read_matrix
from lacuna.codegen.library.classes import Library

MODEL = """model M
  Modelica.Blocks.Tables.CombiTable1Ds tab(table=[0, 1; 1, 2; 0.5, 4]);
equation
  tab.u = time;
end M;
"""


def test_a_table_that_is_refused_names_its_component(tmp_path: Path, shared: Path) -> None:
    library, path = shared / "msl" / "Modelica", tmp_path / "M.mo"
    if not library.is_dir():
        pytest.skip("the Modelica Standard Library is not there")
    path.write_text(MODEL, encoding="utf-8")
    with pytest.raises(Diagnostic, match="does not come after") as refused:
        flatten(Library([str(library)]), str(path))
    assert any(span.file == str(path) and span.line == 2 and "tab" in said for span, said in refused.value.notes)


@pytest.mark.parametrize("rows", ["0 0\n1 1", "0 0\n1 1\n2 4\n3 9", "0,0 0,0\n1,0 1,0\n2,0 4,0"])
def test_a_table_of_another_size_than_its_head_says_is_refused(tmp_path: Path, rows: str) -> None:
    path = tmp_path / "tables.txt"
    path.write_text(f"#1\ndouble other(1,2)\n7 8\ndouble tab(3,2)\n{rows}\ndouble next(1,1)\n9\n", encoding="utf-8")
    with pytest.raises(FileError, match=r"tab has \d+ numbers, its head says 3x2"):
        read_matrix(path, "tab")
    assert read_matrix(path, "other") == [[7, 8]]


def test_two_tables_of_one_name_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "tables.txt"
    path.write_text("#1\ndouble tab(1,2)\n0 1\ndouble tab(1,2)\n0 5\n", encoding="utf-8")
    with pytest.raises(FileError, match="two tables are called tab"):
        read_matrix(path, "tab")
