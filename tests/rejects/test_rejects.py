"""Every diagnostic has a model that earns it: the three comment lines on top say which code, where and what hint."""

from __future__ import annotations

from pathlib import Path
import re

import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library

FOLDER = Path(__file__).parent
MODELS = sorted(FOLDER.glob("*.mo"))
FRONT_END = FOLDER.parents[1] / "codegen"

# Codes that need more than one file; test_library.py and test_search_path.py in tests/codegen/front/ have them.
WITH_FOLDERS = {"F001", "F002", "F003", "F004", "F005", "F006", "F007"}


def expectation(path: Path) -> dict[str, str]:
    """code, line and hint of the header comment."""
    lines = path.read_text(encoding="utf-8").splitlines()[:3]
    return {key: value.strip() for key, value in (line.removeprefix("// ").split(":", 1) for line in lines)}


@pytest.mark.parametrize("path", MODELS, ids=lambda p: p.stem)
def test_is_refused_with_code_line_and_hint(path: Path) -> None:
    wanted = expectation(path)
    with pytest.raises(Diagnostic) as refused:
        flatten(Library([]), str(path))
    found = refused.value
    assert (found.code, found.span.line) == (wanted["code"], int(wanted["line"])), str(found)
    assert found.hint
    assert wanted["hint"] in found.hint
    assert f"{path}:{found.span.line}:{found.span.column}: error[{found.code}]" in str(found)
    assert "^" in str(found)


def test_every_code_of_the_front_end_is_covered() -> None:
    sources = [*FRONT_END.glob("syntax/*.py"), *FRONT_END.glob("flatten/**/*.py"), *FRONT_END.glob("units/*.py")]
    sources += list(FRONT_END.glob("library/*.py"))
    raised = {code for path in sources for code in re.findall(r'"([PRFU]\d{3})"', path.read_text(encoding="utf-8"))}
    covered = {expectation(path)["code"] for path in MODELS} | WITH_FOLDERS
    assert raised - covered == set()
    assert covered - raised == set()
