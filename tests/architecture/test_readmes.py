"""Each stage folder opens with a page that says what goes in, what comes out and what must not happen there."""

from __future__ import annotations

import pytest

from tests.architecture.sources import ROOT

STAGES = ("model", "lacuna", "codegen", "runtime", "analysis", "discovery", "fmi", "lsp", "cli", "bench")


@pytest.mark.parametrize("stage", STAGES)
def test_stage_has_a_short_contract(stage: str) -> None:
    lines = (ROOT / stage / "README.md").read_text(encoding="utf-8").splitlines()
    text = "\n".join(lines).lower()
    assert len(lines) <= 40
    missing = [word for word in ("input", "output", "invariant", "must not", "main file") if word not in text]
    assert missing == []
