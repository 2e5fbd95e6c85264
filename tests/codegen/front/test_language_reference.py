"""The examples of docs/language.md are models: each block is translated as it stands."""

from __future__ import annotations

from pathlib import Path
import re

import pytest

from codegen.flatten import flatten
from codegen.library import Library
from codegen.syntax import parse

ROOT = Path(__file__).parents[3]
REFERENCE = (ROOT / "docs/language.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```modelica\n(.*?)^```", REFERENCE, re.DOTALL | re.MULTILINE)


def title(block: str) -> str:
    return re.search(r"(?:model|function|record|package|connector) (\w+)", block)[1]


@pytest.mark.parametrize("block", BLOCKS, ids=map(title, BLOCKS))
def test_example_is_a_model(tmp_path: Path, block: str) -> None:
    (tmp_path / "load.csv").write_text("time,torque\n0,1\n1,2\n", encoding="utf-8")
    path = tmp_path / "example.mo"
    path.write_text(block, encoding="utf-8")
    (*_, last) = parse(block, str(path))
    name = f"{last.name}.{list(last.classes)[-1]}" if last.kind == "package" else str(path)
    model = flatten(Library([path]), name)
    assert model.variables
    assert model.warnings == []


def test_there_is_an_example_in_most_chapters() -> None:
    assert len(BLOCKS) >= 14


def test_contents_match_the_chapters() -> None:
    listed = re.findall(r"^- \[(.*)\]\(#(.*)\)", REFERENCE, re.MULTILINE)
    chapters = re.findall(r"^## (.*)", REFERENCE, re.MULTILINE)
    assert [name for name, _ in listed] == chapters
    assert [anchor for _, anchor in listed] == [re.sub(r"[^a-z -]", "", c.lower()).replace(" ", "-") for c in chapters]
