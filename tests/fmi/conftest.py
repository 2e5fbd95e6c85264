from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("fmpy", reason="FMPy is not installed")

from tests.fmi.fmus import Fmus


@pytest.fixture(scope="session")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> Fmus:
    return Fmus(tmp_path_factory.mktemp("fmus"))


@pytest.fixture(scope="session")
def msl(shared: Path) -> Path:
    """The Modelica Standard Library, which is no part of the repository."""
    if not (shared / "msl").is_dir():
        pytest.skip(f"needs the Modelica Standard Library in {shared / 'msl'}")
    return shared / "msl"
