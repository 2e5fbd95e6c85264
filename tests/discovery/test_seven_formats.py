"""The recordings of a case in seven formats give one fit, to the last digit."""

from __future__ import annotations

from pathlib import Path
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
    text = (source / "case.toml").read_text(encoding="utf-8")
    for file in source.glob("*.csv"):
        other = tmp_path / f"{file.stem}-again{ending}"
        _as(file, other)
        text = text.replace(file.name, other.name)
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    assert _fitted(tmp_path) == found
