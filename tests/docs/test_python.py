"""The page of the Python API: its examples run, and every public name that it shows is there."""

from __future__ import annotations

import inspect
from pathlib import Path
import re

import pytest

import lacuna

PAGE = (Path(__file__).parents[2] / "docs" / "python.md").read_text(encoding="utf-8")


def test_the_page_s_python_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for code in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL):
        exec(code, names)
    assert (tmp_path / "run.csv").exists()


def test_the_page_names_what_there_is() -> None:
    calls = set(re.findall(r"^\| `(\w+)\(", PAGE, re.MULTILINE)) | set(re.findall(r"lacuna\.(\w+)\(", PAGE))
    assert {name for name in calls if not hasattr(lacuna, name)} == set()
    assert len(PAGE.splitlines()) <= 70  # it fits on a page


def test_every_public_name_has_its_words() -> None:
    found = [getattr(lacuna, name) for name in lacuna.__all__]
    assert [f for f in found if (inspect.isclass(f) or inspect.isfunction(f)) and not f.__doc__] == []
