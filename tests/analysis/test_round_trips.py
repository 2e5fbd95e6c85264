"""Recordings written in each format and read again: values to the last digit, whatever shape and names they have."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.analysis.recording.channel import Channel, RecordingError, on_one_time
from lacuna.analysis.recording.formats import read_recorded, write_recorded
from lacuna.analysis.recording.heads import Head

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


def test_a_step_of_a_channel_with_a_clock_of_its_own_keeps_both_its_samples() -> None:
    def channel(name: str, time: list[float], values: list[float]) -> Channel:
        return Channel(name, "", np.array(time), np.array(values), Head(name, name, None, sure=False))

    step, other = channel("a", [0, 0.1, 0.1, 0.2], [1, 2, 3, 4]), channel("b", [0, 0.05, 0.1], [5, 6, 7])
    time, (a, b) = on_one_time([step, other])
    assert time.tolist() == [0.0, 0.05, 0.1, 0.1, 0.2]
    assert a.tolist()[2:] == [2.0, 3.0, 4.0] and np.isnan(a[1])
    assert b.tolist()[:3] == [5.0, 6.0, 7.0] and np.isnan(b[3:]).all()


def test_whole_numbers_that_no_real_holds_are_refused_in_every_format(tmp_path: Path) -> None:
    savemat = pytest.importorskip("scipy.io").savemat
    asammdf, nptdms = pytest.importorskip("asammdf"), pytest.importorskip("nptdms")
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow.parquet import write_table

    time, large = np.arange(4.0), np.array([1, 2, 3, 2**53 + 1])
    savemat(tmp_path / "a.mat", {"time": time, "n": large})
    write_table(pyarrow.table({"time": time, "n": large}), tmp_path / "a.parquet")
    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal(large, time, name="n")])
        file.save(tmp_path / "a.mf4")
    with nptdms.TdmsWriter(tmp_path / "a.tdms") as file:
        file.write_segment([nptdms.ChannelObject("g", "time", time), nptdms.ChannelObject("g", "n", large)])
    with pytest.importorskip("h5py").File(tmp_path / "a.hdf.mat", "w") as file:  # version 7.3
        file["time"], file["n"] = time[None, :], large[None, :]
    (tmp_path / "a.csv").write_text(f"time,n\n0,1\n1,{2**60}\n2,{2**53 + 1}\n")
    book = pytest.importorskip("openpyxl").Workbook()
    for row in (("time", "n"), (0, 1), (1, str(2**53 + 1))):
        book.active.append(row)
    book.active["B3"].data_type = "n"  # with all its digits, as other programs write it
    book.save(tmp_path / "a.xlsx")
    for form in ("mat", "parquet", "mf4", "tdms", "hdf.mat", "csv", "xlsx"):
        with pytest.raises(RecordingError, match=rf"a.{form}: n holds whole numbers beyond 2\^53"):
            read_recorded(tmp_path / f"a.{form}")


def test_whole_numbers_that_are_reals_are_read_however_large(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(f"time,n\n0,{2**60}\n1,{10**22}\n2,9007199254740993.5\n")
    assert read_recorded(tmp_path / "a.csv")["n"].values.tolist() == [2.0**60, 1e22, 9007199254740993.5]


@pytest.mark.parametrize("form", PACKAGES)
def test_a_unit_that_is_only_the_end_of_a_name_is_not_written_as_one(tmp_path: Path, form: str) -> None:
    """The current of phase C was written in coulomb."""
    pytest.importorskip(PACKAGES[form])
    (tmp_path / "source.csv").write_text("time,I_A,I_B,I_C,u_mV,T [K]\n0,1,2,3,4,5\n1,2,3,4,5,6\n")
    source = read_recorded(tmp_path / "source.csv")
    write_recorded(source, tmp_path / f"a.{form}")
    again = read_recorded(tmp_path / f"a.{form}")
    told = [(c.name, c.unit, c.head.sure) for c in source.channels]
    assert [(c.name, c.unit, c.head.sure) for c in again.channels] == told
    assert told[-2:] == [("u", "mV", False), ("T", "K", True)]


@pytest.mark.parametrize("unit", ["s", "ms", "us", "ns"])
def test_durations_are_seconds(tmp_path: Path, unit: str) -> None:
    """As pandas writes a Timedelta; a missing one is a missing time, one of a signal a missing value."""
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow.parquet import write_table

    second = {"s": 1, "ms": 10**3, "us": 10**6, "ns": 10**9}[unit]
    time = pyarrow.array([0, 2 * second, 3 * second], pyarrow.duration(unit))
    lag = pyarrow.array([second, None, 5 * second], pyarrow.duration(unit))
    write_table(pyarrow.table({"time": time, "lag": lag}), tmp_path / "a.parquet")
    recorded = read_recorded(tmp_path / "a.parquet")
    assert recorded["lag"].time == pytest.approx([0, 2, 3])
    assert recorded["lag"].values == pytest.approx([1, np.nan, 5], nan_ok=True)
    assert recorded["lag"].unit == "s"


def test_a_column_of_time_that_is_not_read_is_not_replaced_by_another(tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow.parquet import write_table

    rising = np.arange(3.0)
    for kind in (pyarrow.time64("us"), pyarrow.string()):
        time = pyarrow.array(["0", "1", "2"] if kind == pyarrow.string() else [0, 1, 2], kind)
        write_table(pyarrow.table({"Time": time, "phi": rising, "u": rising}), tmp_path / "a.parquet")
        with pytest.raises(RecordingError, match="`Time` holds neither numbers nor dates: write it in seconds"):
            read_recorded(tmp_path / "a.parquet")
        write_table(pyarrow.table({"Time": time, "t": rising, "u": rising}), tmp_path / "b.parquet")
        assert read_recorded(tmp_path / "b.parquet").time == "t"
