"""One recorded test in seven formats is one severity, to the last digit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import lacuna
from lacuna.analysis.severity.assessment import assess
from tests.analysis.reference import simulate
from tests.analysis.test_assessment import COLUMNS, write

RATE = 20000  # Hz


@pytest.mark.parametrize("name", ["b.csv", "b.mat", "b.parquet", "b.mf4", "b.tdms", "b.xlsx", "b73.mat"])
def test_the_assessment_is_the_same_in_every_format(map_folder: Path, tmp_path: Path, name: str) -> None:
    currents = simulate(0.27, step=1 / RATE, rows=RATE)[:3]
    source, other = write(tmp_path / "a.csv", currents, rate=RATE), tmp_path / name
    if name == "b73.mat":
        h5py = pytest.importorskip("h5py")
        table = np.loadtxt(source, delimiter=",", skiprows=1)
        with h5py.File(other, "w") as file:
            for k, column in enumerate(["time", *COLUMNS]):
                file[column] = table[None, :, k]
    else:
        pytest.importorskip({".mf4": "asammdf", ".tdms": "nptdms", ".xlsx": "openpyxl"}.get(other.suffix, "numpy"))
        lacuna.convert(source, other)
    expected, found = (assess(path, map_folder, columns=COLUMNS) for path in (source, other))
    assert found.estimate == expected.estimate
    assert found.features == expected.features and found.sentence == expected.sentence
