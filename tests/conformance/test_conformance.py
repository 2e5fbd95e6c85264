"""Small models written from the text of the language specification (Modelica 3.6), section by section.

A model says on top what it shows:

    // section: 11.2.2.1
    // value: x[2] = 4, y at 0.5 = 1.5
    // refuse: R047 7

`value` lists results at the end of the run (1 s) or at a time; `refuse` gives code and line of the refusal at
translation. Numbers hold to 1e-6 of their size, the tolerance of the runs being 1e-9.
"""

from __future__ import annotations

from pathlib import Path
import re

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model, translate
from lacuna.codegen.errors import Diagnostic
from lacuna.runtime.model import Model
from lacuna.runtime.simulation import simulate

FOLDER = Path(__file__).parent
MODELS = sorted(FOLDER.glob("*/*.mo"))
_VALUE = re.compile(r"([\w.\[\],]+?)(?: at ([\d.]+))? = (\S+?)(?:, |$)")


def header(path: Path) -> dict[str, str]:
    """The keys of the comment lines on top."""
    entries: dict[str, str] = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line.startswith("// "):
            break
        key, _, value = line.removeprefix("// ").partition(": ")
        entries[key] = f"{entries[key]}, {value}" if key in entries else value
    return entries


def expected(text: str) -> list[tuple[str, float | None, float]]:
    """(variable, time or None for the end, value) of a line of values."""
    found = _VALUE.findall(text)
    assert found, text
    number = {"true": 1.0, "false": 0.0}
    return [(name, float(at) if at else None, number.get(v) if v in number else float(v)) for name, at, v in found]


@pytest.mark.parametrize("path", MODELS, ids=lambda p: f"{p.parent.name}/{p.stem}")
def test_conforms(path: Path) -> None:
    wanted = header(path)
    assert wanted["section"]
    if "refuse" in wanted:
        code, line = wanted["refuse"].split()
        with pytest.raises(Diagnostic) as refused:
            translate(str(path), search_path=[])
        assert (refused.value.code, refused.value.span.line) == (code, int(line)), str(refused.value)
        return
    compiled = compile_model(str(path), search_path=[])
    result = simulate(Model(compiled.path), stop=1.0, rtol=1e-9, interval=0.05)
    assert result.complete, result.failure
    assert all(" " not in name or "'" in name for name in result.model.variables), "a name that no model declares"
    for name, at, value in expected(wanted["value"]):
        constant = result.parameters.get(name)
        column = result[name] if constant is None else np.full(len(result.time), constant)
        found = column[-1] if at is None else np.interp(at, result.time, column)
        assert found == pytest.approx(value, rel=1e-6, abs=1e-7), f"{name} at {at}"


def test_every_chapter_has_models() -> None:
    chapters = {"arrays", "functions", "algorithms", "operators", "equations", "initial"}
    chapters |= {"classes", "connections", "inheritance", "redeclare", "scoping"}
    assert {p.parent.name for p in MODELS} >= chapters
