"""Small files and small functions; where one is longer, the reason stands here.

The limits are for readers, so nothing is split at a number: an exception is fine when it can be argued."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
import re

import pytest

from tests.architecture.sources import FOLDERS, ROOT, files

FILE_LIMIT, FUNCTION_LIMIT = 300, 50
ROOMS = 12

LONG_FILES = {
    "codegen/symbolic/expr.py": "one table of node types, their builders, rules and printer: they change together",
    "tests/codegen/back/test_hybrid.py": "one test a hybrid phenomenon, each beside the small model that shows it",
}
_TABLE = "small makers of concealed effects side by side, which share what the function computes first"
LONG_FUNCTIONS = {
    "tests/proof/effects/drive.py:winding_and_drive": _TABLE,
    "tests/proof/effects/friction.py:frictions": _TABLE,
    "tests/proof/effects/loads.py:loads": _TABLE,
    "tests/proof/effects/sensors.py:sensors": _TABLE,
    "tests/proof/effects/three_phase.py:three_phase": _TABLE,
}

_C_FUNCTION = re.compile(r"^(?!typedef|enum|struct|static const|namespace|extern|class|TEST)[A-Za-z].*\b(\w+)\(.*")


def test_files_are_small() -> None:
    long = {
        str(path.relative_to(ROOT)): lines
        for folder in FOLDERS
        for path in files(folder, ".py", ".c", ".h", ".cpp", ".hpp", ".mo")
        if (lines := len(path.read_text(encoding="utf-8").splitlines())) > FILE_LIMIT
    }
    assert {name: lines for name, lines in long.items() if name not in LONG_FILES} == {}
    assert set(LONG_FILES) <= set(long), "an exception that is no longer needed"


@pytest.mark.parametrize("stage", ["codegen", "analysis", "discovery"])
def test_every_folder_opens_to_a_dozen_rooms(stage: str) -> None:
    modules = {path for path in files(stage, ".py") if path.name != "__init__.py"}
    rooms = modules | {path.parent for path in modules if path.parent != ROOT / stage}
    inside = Counter(str(room.parent.relative_to(ROOT)) for room in rooms)
    assert inside[stage] > 1
    assert {folder: count for folder, count in inside.items() if count > ROOMS} == {}


def python_functions(path: Path) -> Iterator[tuple[str, int]]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            yield node.name, node.end_lineno - node.lineno + 1


def c_functions(path: Path) -> Iterator[tuple[str, int]]:
    """A function of clang-formatted C or C++ begins at the margin and ends with a brace at the margin."""
    name, begin = "", 0
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if match := _C_FUNCTION.match(line):
            name, begin = match[1], number
        if line.startswith("}") and name:
            yield name, number - begin + 1
            name = ""


def test_functions_are_short() -> None:
    long = {
        f"{path.relative_to(ROOT)}:{name}": lines
        for folder in FOLDERS
        for path in files(folder, ".py", ".c", ".cpp")
        for name, lines in (python_functions(path) if path.suffix == ".py" else c_functions(path))
        if lines > FUNCTION_LIMIT
    }
    assert {name: lines for name, lines in long.items() if name not in LONG_FUNCTIONS} == {}
    assert set(LONG_FUNCTIONS) <= set(long), "an exception that is no longer needed"
