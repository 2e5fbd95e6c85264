"""The recordings of a case in seven formats give one fit and one diagnosis, to the last digit."""

from __future__ import annotations

import json
from pathlib import Path
import re
from typing import Any

import numpy as np
import pytest

import lacuna

FORMATS = [".csv", ".mat", ".parquet", ".mf4", ".tdms", ".xlsx", ".h5.mat"]


def _as(source: Path, out: Path) -> None:
    if out.name.endswith(".h5.mat"):
        h5py = pytest.importorskip("h5py")
        names = source.read_text(encoding="utf-8").splitlines()[0].split(",")
        table = np.loadtxt(source, delimiter=",", skiprows=1)
        with h5py.File(out, "w") as file:
            for k, name in enumerate(names):
                file[name] = table[None, :, k]
        return
    pytest.importorskip({".mf4": "asammdf", ".tdms": "nptdms", ".xlsx": "openpyxl"}.get(out.suffix, "numpy"))
    lacuna.convert(source, out)


def _fitted(case: Path) -> tuple[Any, Any]:
    found = lacuna.open_case(case).fit(out=case / "out")
    return found.parameters, found.nrmse


@pytest.fixture(scope="module")
def expected(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, tuple[Any, Any]]:
    examples = {path.name: path for path in lacuna.copy_examples(tmp_path_factory.mktemp("case") / "examples")}
    return examples["missing-physics"], _fitted(examples["missing-physics"])


@pytest.mark.parametrize("ending", FORMATS)
def test_the_fit_is_the_same_in_every_format(expected: tuple[Path, Any], tmp_path: Path, ending: str) -> None:
    source, found = expected
    _case_as(source, tmp_path, ending)
    assert _fitted(tmp_path) == found


def _case_as(source: Path, folder: Path, ending: str) -> None:
    text = (source / "case.toml").read_text(encoding="utf-8")
    for file in source.glob("*.csv"):
        other = folder / f"{file.stem}-again{ending}"
        _as(file, other)
        text = text.replace(file.name, other.name)
    (folder / "case.toml").write_text(text, encoding="utf-8")


@pytest.mark.slow
@pytest.mark.timeout(3000)
def test_the_diagnosis_is_the_same_in_every_format(expected: tuple[Path, Any], tmp_path: Path) -> None:
    """Whole: verdict, findings, values, intervals, errors. Nothing of it may hang on how much time there was."""
    told = {}
    for ending in FORMATS:
        folder = tmp_path / ending.strip(".").replace(".", "-") / "case"  # the diagnosis says the folder's name
        folder.mkdir(parents=True)
        _case_as(expected[0], folder, ending)
        diagnosis = lacuna.open_case(folder).explain(out=folder / "out", limit=1e6).diagnosis
        told[ending] = re.sub(r"-again[.\w]+", "", json.dumps({**diagnosis, "case": "", "seconds": 0}))
    assert set(told.values()) == {told[".csv"]}
