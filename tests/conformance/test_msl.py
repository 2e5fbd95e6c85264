"""The Modelica Standard Library: what its page calls right is right still."""

from __future__ import annotations

from pathlib import Path
import re

import pytest

from bench import isolated, msl
from lacuna.codegen import cache

PAGE = Path(__file__).parents[2] / "docs" / "msl.md"


def right() -> list[str]:
    """Full names of the examples that the page calls right."""
    found, package = [], ""
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            package = line[3:]
        elif row := re.match(r"\| (\S+) \| right, ", line):
            found.append(f"Modelica.{package}.Examples.{row[1]}")
    return found


@pytest.mark.xdist_group("msl")
@pytest.mark.timeout(900)  # sixty examples count in one test's time
def test_what_was_right_is_right(shared: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = shared / "msl"
    if not folder.is_dir():
        pytest.skip(f"needs the Modelica Standard Library with its reference results; not at {folder}")
    monkeypatch.setattr(cache, "COMPILER", tuple(cache.QUICK.get(o, o) for o in cache.COMPILER))
    names = right()
    assert len(names) > 60
    results = isolated.run_all(
        names, lambda name: msl.measure(name, folder, "error"), tmp_path, timeout=msl.TIMEOUT, progress=False
    )
    assert {n: r for n, r in results.items() if r["status"] != "right"} == {}
