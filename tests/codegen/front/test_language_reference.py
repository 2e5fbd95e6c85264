"""The examples of docs/language.md are models: each block is translated and simulated as it stands."""

from __future__ import annotations

from pathlib import Path
import re

import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import parse

ROOT = Path(__file__).parents[3]
REFERENCE = (ROOT / "docs/language.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```modelica\n(.*?)^```", REFERENCE, re.DOTALL | re.MULTILINE)


def title(block: str) -> str:
    return re.search(r"(?:model|function|record|package|connector) (\w+)", block)[1]


@pytest.fixture
def example(tmp_path: Path, request: pytest.FixtureRequest) -> tuple[Path, str]:
    """One example as a file, and the name of its last model."""
    (tmp_path / "load.csv").write_text("time,torque\n0,1\n1,2\n", encoding="utf-8")
    path = tmp_path / "example.mo"
    path.write_text(request.param.replace("within Lacuna.Components;\n", ""), encoding="utf-8")
    (*_, last) = parse(request.param, str(path))
    return path, f"{last.name}.{list(last.classes)[-1]}" if last.kind == "package" else last.name


@pytest.mark.parametrize("example", BLOCKS, ids=map(title, BLOCKS), indirect=True)
def test_example_is_a_sound_model(example: tuple[Path, str]) -> None:
    path, name = example
    model = flatten(Library([path]), name)
    assert model.variables
    assert model.warnings == []


@pytest.mark.parametrize("example", BLOCKS, ids=map(title, BLOCKS), indirect=True)
def test_example_can_be_simulated(example: tuple[Path, str]) -> None:
    path, name = example
    model = runtime.Model(compile_model(name, search_path=[str(path)], cache_directory=str(path.parent)).path)
    result = runtime.simulate(model, stop=0.5)
    assert result.complete, result.failure
    assert result.time[-1] == 0.5


def test_there_is_an_example_in_most_chapters() -> None:
    assert len(BLOCKS) >= 14


def test_contents_match_the_chapters() -> None:
    listed = re.findall(r"^- \[(.*)\]\(#(.*)\)", REFERENCE, re.MULTILINE)
    chapters = re.findall(r"^## (.*)", REFERENCE, re.MULTILINE)
    assert [name for name, _ in listed] == chapters
    assert [anchor for _, anchor in listed] == [re.sub(r"[^a-z -]", "", c.lower()).replace(" ", "-") for c in chapters]
