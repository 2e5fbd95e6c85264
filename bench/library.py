"""The whole Modelica Standard Library read: processor seconds of parsing and of looking every class up, and memory."""

from __future__ import annotations

from collections.abc import Sequence
import multiprocessing
from pathlib import Path
import resource
import time

from bench.msl import shared_folder
from bench.report import Row
from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.search_path import search_path


def read_whole(rounds: int) -> Sequence[Row]:
    """One row for each of at most three fresh processes; none where the library is not at hand."""
    try:
        folder = str(shared_folder())
    except FileNotFoundError:
        return []
    rows = []
    for _ in range(min(rounds, 3)):
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            rows.append(pool.apply(_measure, (folder,)))
    return rows


def _measure(folder: str) -> Row:
    before, start = _resident(), time.process_time()
    library = Library(search_path([folder]))
    classes = library.all_classes(library.find("Modelica"))
    parsed = time.process_time()
    for cls in classes:
        library.find(cls.path)
    done = time.process_time()
    return {
        "files": len(library.files), "classes": len(classes), "parse s": parsed - start,
        "lookup ms each": 1e3 * (done - parsed) / len(classes), "MB": _resident() - before,
    }  # fmt: skip


def _resident() -> float:
    """Memory of this process now, MB; a high-water mark would be the parent's."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * resource.getpagesize() / 2**20
