"""A name that begins as those write it who import a package of the standard library is answered with the import."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library


@pytest.mark.parametrize(
    ("declared", "hint"),
    [
        ("parameter SI.Voltage v = 5;", "write import Modelica.Units.SI; in the class"),
        ("Blocks.Sources.Constant c(k=1);", "write import Modelica.Blocks; in the class"),
        ("parameter SI.Nonsense v = 5;", ""),
    ],
)
def test_the_import_that_lacks_is_named(tmp_path: Path, shared: Path, declared: str, hint: str) -> None:
    library, path = shared / "msl" / "Modelica", tmp_path / "M.mo"
    if not library.is_dir():
        pytest.skip("the Modelica Standard Library is not there")
    path.write_text(f"model M\n  {declared}\nend M;\n", encoding="utf-8")
    with pytest.raises(Diagnostic, match="there is no") as refused:
        flatten(Library([str(library)]), str(path))
    assert refused.value.hint == hint if hint else "Modelica" not in refused.value.hint
