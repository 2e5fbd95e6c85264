from __future__ import annotations

import pytest

pytest.importorskip("fmpy", reason="FMPy is not installed")

from tests.fmi.fmus import Fmus


@pytest.fixture(scope="session")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> Fmus:
    return Fmus(tmp_path_factory.mktemp("fmus"))
