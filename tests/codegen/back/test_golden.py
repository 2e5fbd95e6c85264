"""The dumps of three tiny models, byte for byte: any change of what is generated is seen and meant.

Write them anew with `python -m tests.codegen.back.test_golden` after looking at the difference.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.compile import translate
from lacuna.codegen.structure.report import dump

FOLDER = Path(__file__).parent / "golden"
MODELS = sorted(p.stem for p in FOLDER.glob("*.mo"))
KINDS = {"flat": "flat.txt", "structure": "structure.txt", "c": "c"}


def dumped(model: str, kind: str) -> str:
    """One dump, free of the folder that the model lies in."""
    text = dump(translate(str(FOLDER / f"{model}.mo"))[0], kind)
    return text.replace(str(FOLDER) + "/", "")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("model", MODELS)
def test_dump_is_as_recorded(model: str, kind: str) -> None:
    recorded = (FOLDER / f"{model}.{KINDS[kind]}").read_text(encoding="utf-8")
    assert dumped(model, kind) == recorded


def test_three_models_cover_the_back_end() -> None:
    everything = "".join(dumped(m, "structure") for m in MODELS)
    features = (
        "linear block",
        "nonlinear block",
        "d/dt of",
        "rel[0] root",
        "rel[0] time",
        "sample clocks (1)",
        "when for",
    )
    for feature in features:
        assert feature in everything


if __name__ == "__main__":
    for name in MODELS:
        for what, suffix in KINDS.items():
            (FOLDER / f"{name}.{suffix}").write_text(dumped(name, what), encoding="utf-8")
