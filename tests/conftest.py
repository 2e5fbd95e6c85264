"""Fixtures that every part of the tests may use."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of published facts and recordings beside the checkout, which is no part of it."""
    folder = Path(os.environ.get("LACUNA_SHARED", ROOT.parent / "shared"))
    if not folder.is_dir():
        pytest.skip(f"needs the shared folder of benchmarks and recordings; not at {folder} (set LACUNA_SHARED)")
    return folder
