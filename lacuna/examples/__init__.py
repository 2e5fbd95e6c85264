"""Three examples to begin with: a small model, a case with something missing, a recorded pre-flight test.

The recordings are simulated, with noise, by `make examples`.
"""

from __future__ import annotations

from pathlib import Path
import shutil

HERE = Path(__file__).parent
NAMES = ("first-model", "missing-physics", "preflight")


class ExamplesError(Exception):
    """The examples cannot be put where they were asked for."""

    user_error = True


def copy_examples(folder: str | Path) -> list[Path]:
    """Copy the examples into `folder`, which is made, and return the folder of each. Nothing is overwritten.

    Raises ExamplesError where one of them is there already.
    """
    folder = Path(folder)
    there = [folder / name for name in NAMES if (folder / name).exists()]
    if there:
        raise ExamplesError(f"{there[0]} is there already; choose another folder")
    return [Path(shutil.copytree(HERE / name, folder / name)) for name in NAMES]
