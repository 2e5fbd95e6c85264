"""A map of the hand-written simulation, prepared for assessment."""

from __future__ import annotations

import pytest

from lacuna.analysis.map.maps import build_map
from lacuna.analysis.severity.preparation import prepare_assessment
from tests.analysis.plants import ReferencePlant, paper_settings


@pytest.fixture(scope="session")
def map_folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("assessment")
    fewer = [("conditions = 7", "conditions = 3"), ("every = 10", "every = 13")]
    settings = paper_settings(folder, *fewer)
    plant = ReferencePlant()
    prepare_assessment(plant, settings, build_map(plant, settings, folder / "map", figures=False))
    return folder / "map"
