"""What is wrong with a table names the component that has it, not only the library that reads it."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten import flatten
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
