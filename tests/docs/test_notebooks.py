"""The notebooks run from beginning to end, and show figures. `python -m tests.docs.test_notebooks` runs them and keeps
what they show."""

from __future__ import annotations

import os
from pathlib import Path
import re
import tempfile

import pytest

nbformat = pytest.importorskip("nbformat", reason="the notebooks need nbclient and ipykernel: make setup")
nbclient = pytest.importorskip("nbclient", reason="the notebooks need nbclient and ipykernel: make setup")

FOLDER = Path(__file__).parents[2] / "docs" / "notebooks"
NOTEBOOKS = sorted(path.stem for path in FOLDER.glob("*.ipynb"))


def executed(name: str, folder: Path):
    """The notebook after all its cells ran in `folder`. Raises CellExecutionError where one fails."""
    book = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
    where = {"metadata": {"path": str(folder)}}
    nbclient.NotebookClient(book, timeout=600, kernel_name="python3", resources=where).execute()
    return book


def shown(book) -> list[str]:
    """What the cells display, as text."""
    outputs = [output for cell in book.cells for output in cell.get("outputs", [])]
    texts = [output.get("text", "") for output in outputs]
    return texts + [text for output in outputs for text in output.get("data", {}).values()]


@pytest.mark.timeout(900)
@pytest.mark.parametrize("name", NOTEBOOKS)
def test_the_notebook_runs_and_shows_figures(name: str, tmp_path: Path) -> None:
    found = shown(executed(name, tmp_path))
    assert any("<svg" in text for text in found)
    kept = shown(nbformat.read(FOLDER / f"{name}.ipynb", as_version=4))
    assert any("<svg" in text for text in kept)
    assert len(kept) == len(found)


def test_notebooks_say_nothing_of_the_machine_they_ran_on() -> None:
    for name in NOTEBOOKS:
        text = (FOLDER / f"{name}.ipynb").read_text(encoding="utf-8")
        assert not re.search(r"/(tmp|home|work|root)/", text), name


if __name__ == "__main__":
    os.environ.setdefault("PYTHONHASHSEED", "0")
    for stem in NOTEBOOKS:
        with tempfile.TemporaryDirectory() as scratch:
            done = executed(stem, Path(scratch))
        for cell in done.cells:
            cell.metadata = {}
        nbformat.write(done, FOLDER / f"{stem}.ipynb")
