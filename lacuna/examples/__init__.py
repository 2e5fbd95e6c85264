"""Examples to begin with: a small model, a case with something missing, a recorded pre-flight test; and the equations.

The recordings are simulated, with noise, by `make examples`.
"""

from __future__ import annotations

from pathlib import Path
import shutil

from lacuna.written import whole_files

HERE = Path(__file__).parent
NAMES = ("first-model", "missing-physics", "preflight")
LIBRARY = "Lacuna"  # the package of all models, to be edited: `-L FOLDER/Lacuna` uses the copy


class ExamplesError(Exception):
    """The examples cannot be put where they were asked for."""

    user_error = True


def copy_examples(folder: str | Path) -> list[Path]:
    """Copy the examples and the package Lacuna into `folder`, which is made, and return the folder of each: all of them
    or none. Nothing is overwritten.

    Raises ExamplesError where one of them is there already.
    """
    from lacuna.codegen.library.search_path import MODEL_FOLDER

    folder = Path(folder)
    sources = {folder / name: HERE / name for name in NAMES} | {folder / LIBRARY: MODEL_FOLDER}
    there = [target for target in sources if target.exists()]
    if there:
        raise ExamplesError(f"{there[0]} is there already; choose another folder")
    only_models = shutil.ignore_patterns("README.md")  # which is of our tree
    with whole_files(folder) as scratch:
        for target, source in sources.items():
            try:
                shutil.copytree(source, scratch / target.name, ignore=only_models)
            except shutil.Error as error:  # it goes on after the first, and lists them
                raise OSError(error.args[0][0][2]) from None
    return list(sources)
