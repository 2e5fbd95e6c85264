"""A few texts of an editor with fixed seeds; more: python -m tests.fuzz.editor."""

from __future__ import annotations

from pathlib import Path
import shutil
import signal

import pytest

pytest.importorskip("pygls", reason="pygls is not installed")

from lacuna.codegen.library.search_path import MODEL_FOLDER
from tests.fuzz.editor import try_seed
from tests.fuzz.files import out_of_time


def test_every_question_about_mutated_texts_is_answered(tmp_path: Path) -> None:
    shutil.copytree(MODEL_FOLDER, tmp_path / "Lacuna")
    before = signal.signal(signal.SIGALRM, out_of_time)
    try:
        for seed in range(25):
            try_seed(seed, tmp_path / "Lacuna")
    finally:
        signal.signal(signal.SIGALRM, before)
