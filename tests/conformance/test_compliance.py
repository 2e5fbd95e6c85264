"""The Modelica Association's compliance library keeps the level it has: docs/compliance.md lists what is left."""

from __future__ import annotations

from pathlib import Path

import pytest

from bench import compliance, isolated
from lacuna.codegen import cache


@pytest.mark.slow
def test_cases_pass_and_are_refused_as_they_should(
    shared: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = shared / "compliance"
    if not folder.is_dir():
        pytest.skip(f"needs the compliance library; not at {folder}")
    monkeypatch.setattr(cache, "COMPILER", tuple(o for o in cache.COMPILER if o != "-O2"))
    verdicts = compliance.cases(folder)
    results = isolated.run_all(
        verdicts, lambda name: compliance.judge(name, folder), tmp_path, timeout=compliance.TIMEOUT, progress=False
    )
    crashed = [name for name, r in results.items() if r["status"] == "crash"]
    assert crashed == []
    for should, share in ((True, 0.9), (False, 0.85)):
        named = [name for name, verdict in verdicts.items() if verdict == should]
        good = sum(compliance.right(should, results[name]) for name in named)
        assert good >= share * len(named), f"{good} of {len(named)}"
