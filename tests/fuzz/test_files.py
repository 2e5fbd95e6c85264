"""What stands in the place of a file that a command reads is one, or refused in a line; more: -m tests.fuzz.files."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
import random
import signal

import pytest

from tests.fuzz.files import TARGETS, lay_out, out_of_time, try_file

DEEP = {".json": "[" * 100_000, ".toml": "a = " + "[" * 100_000}


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory, map_folder: Path) -> Iterator[Path]:
    here, folder = Path.cwd(), tmp_path_factory.mktemp("files")
    before = signal.signal(signal.SIGALRM, out_of_time)
    lay_out(folder, map_folder)
    yield folder
    os.chdir(here)
    signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("kind", ["pipe", "folder", "device"])
@pytest.mark.parametrize("name", TARGETS)
def test_what_is_no_file_is_refused(name: str, kind: str, place: Path) -> None:
    """A pipe that nobody writes to, a folder, a device without an end: each would hang, or take all memory."""
    path = place / TARGETS[name].file
    path.rename(path.with_name("kept"))
    try:
        {"pipe": os.mkfifo, "folder": Path.mkdir, "device": lambda p: p.symlink_to("/dev/zero")}[kind](path)
        formatted = (name, kind) == ("format", "folder")  # every file below it, and there is none
        assert try_file(name, None, place) == ("taken" if formatted else "refused")
    finally:
        path.rmdir() if kind == "folder" else path.unlink()
        path.with_name("kept").rename(path)


@pytest.mark.parametrize("name", [n for n, t in TARGETS.items() if Path(t.file).suffix in DEEP])
def test_what_nests_without_end_is_refused(name: str, place: Path) -> None:
    path = place / TARGETS[name].file
    good = path.read_text()
    path.write_text(DEEP[path.suffix])
    assert try_file(name, None, place) == "refused"
    path.write_text(good)


def test_mutated_files_are_taken_or_refused(place: Path) -> None:
    outcomes = [try_file(name, random.Random(seed), place) for seed in range(3) for name in TARGETS]
    assert set(outcomes) == {"taken", "refused"}
