"""Fixtures that every part of the tests may use."""

from __future__ import annotations

import fcntl
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


@pytest.fixture(scope="session")
def map_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A map of the hand-written simulation, prepared for assessment: once for all workers of a run."""
    from tests.analysis.plants import prepare_small_map

    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "prepared"
    folder.mkdir(exist_ok=True)
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (folder / "map" / "severity.table").exists():
            prepare_small_map(folder)
    return folder / "map"
