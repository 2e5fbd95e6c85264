"""Recordings written in each format and read again: values to the last digit, whatever shape and names they have."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.analysis.recording.channel import RecordingError
from lacuna.analysis.recording.formats import read_recorded, write_recorded

PACKAGES = {
    "csv": "numpy",
    "mat": "scipy",
    "parquet": "pyarrow",
    "mf4": "asammdf",
    "tdms": "nptdms",
    "xlsx": "openpyxl",
}
TEXT = """time [s],"=SUM(A1:A3) [m]",NA [A],TRUE [V]
0.1,333.49537138177413,,1
0.30000000000000004,0.14285714285714285,3,1e300
0.7,-1e-300,5,0.1
"""


@pytest.mark.parametrize("form", PACKAGES)
def test_as_many_rows_as_channels_odd_names_and_all_digits(tmp_path: Path, form: str) -> None:
    pytest.importorskip(PACKAGES[form])
    (tmp_path / "source.csv").write_text(TEXT)
    source = read_recorded(tmp_path / "source.csv")
    write_recorded(source, tmp_path / f"a.{form}")
    again = read_recorded(tmp_path / f"a.{form}")
    assert [c.name for c in again.channels] == [c.name for c in source.channels] == ["=SUM(A1:A3)", "NA", "TRUE"]
    for channel in source.channels:
        found, there = again[channel.name], np.isfinite(channel.values)
        kept = np.isfinite(found.values)
        assert found.values[kept].tolist() == channel.values[there].tolist()
        assert found.time[kept].tolist() == channel.time[there].tolist()


def test_a_text_of_a_spreadsheet_is_never_a_formula(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    (tmp_path / "source.csv").write_text(TEXT)
    write_recorded(read_recorded(tmp_path / "source.csv"), tmp_path / "a.xlsx")
    head = openpyxl.load_workbook(tmp_path / "a.xlsx").active[1]
    assert [c.data_type for c in head] == ["s"] * 4


def test_a_mat_table_whose_time_has_another_length_is_refused(tmp_path: Path) -> None:
    savemat = pytest.importorskip("scipy.io").savemat
    table = {"time": np.arange(4.0), "names": np.array(["a", "b"], dtype=object), "data": np.ones((3, 2))}
    savemat(tmp_path / "a.mat", table)
    with pytest.raises(RecordingError, match="2 names, 4 times and data of 3 by 2 do not go together"):
        read_recorded(tmp_path / "a.mat")
