"""The README's tour is run as it stands there, and its numbers are compared with what the code gives."""

from __future__ import annotations

from pathlib import Path
import re
import shutil

import numpy as np
import pytest

from bench.tolerance import Study
from lacuna.codegen.compile import compile_model
from lacuna.codegen.errors import Diagnostic

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
EDITED = "Components/Drives/StarWinding.mo"
ACTUATOR = "Actuators.EccentricBldc"


def block(language: str) -> list[str]:
    match = re.search(rf"```{language}\n(.*?)```", README, re.DOTALL)
    assert match, f"the README has no {language} block"
    return match[1].splitlines()


@pytest.fixture
def edit(tmp_path: Path):
    """Replace a text in a copy of the models and give the copy's path."""

    def apply(old: str, new: str) -> Path:
        copy = tmp_path / "model"
        shutil.copytree(ROOT / "model", copy)
        file = copy / EDITED
        text = file.read_text(encoding="utf-8")
        assert text.count(old) == 1, "the README edits a line that is not in the model"
        file.write_text(text.replace(old, new), encoding="utf-8")
        return copy

    return apply


def test_the_edit_of_the_tour_makes_another_model(edit) -> None:
    old, new = (line[1:] for line in block("diff"))
    changed = compile_model(ACTUATOR, search_path=[str(edit(old, new))])
    assert changed.hash != compile_model(ACTUATOR).hash


def test_the_slip_of_the_tour_is_answered_as_printed(edit) -> None:
    with pytest.raises(Diagnostic) as refusal:
        compile_model(ACTUATOR, search_path=[str(edit("hall.theta_e - pi/3", "hall.thetae - pi/3"))])
    place = re.compile(r":\d+:\d+:")  # lines move with every edit of the model; the rest must be as printed
    printed = place.sub(":", "\n".join(block("text")))
    assert place.sub(":", str(refusal.value)).endswith(printed)


def test_the_reproduced_rises_are_those_of_the_model() -> None:
    rises = re.findall(r"^\| (?:rise|over).* \| \d+ \| ([\d.]+) \|$", README, re.MULTILINE)
    edges = [0.0, 0.1, 0.11, 0.26, 0.27, 0.33, 0.34, 0.5]
    study = Study(edges)
    runs = study.variable(study.settings.solver, study.settings.relative_tolerance, study.settings.absolute_tolerance)
    mean = np.mean(runs.rms, axis=1)
    assert np.round(1e3 * (mean[1::2] - mean[::2]), 1).tolist() == [float(value) for value in rises]


def test_links_lead_somewhere() -> None:
    for page in [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]:
        for target in re.findall(r"\]\(([\w./-]+)\)", page.read_text(encoding="utf-8")):
            assert (page.parent / target).exists(), f"{page.relative_to(ROOT)} links to {target}"


def test_the_guide_s_python_runs() -> None:
    guide = (ROOT / "docs" / "guide" / "README.md").read_text(encoding="utf-8")
    code = re.search(r"```python\n(.*?)```", guide, re.DOTALL)[1]
    names: dict[str, object] = {}
    exec(code, names)
    assert names["result"].complete
