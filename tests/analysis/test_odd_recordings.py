"""Recordings as loggers of users write them: read whole, with what was assumed, or refused by place."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from lacuna.analysis.recording.channel import Recorded, RecordingError
from lacuna.analysis.recording.formats import read_recorded

TIME = np.arange(5) * 0.1


def read(path: Path, text: str, encoding: str = "utf-8") -> Recorded:
    path.write_bytes(text.encode(encoding))
    return read_recorded(path)


def found(recorded: Recorded) -> dict[str, tuple[str, list[float]]]:
    return {c.name: (c.unit, c.values.tolist()) for c in recorded.channels}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("time speed\n0 1\n1 2\n", {"speed": ("", [1, 2])}),
        ("   time [s]   u[V]\n   0.0   1.5\n   0.1   2.5\n".replace(" [s]", "[s]"), {"u": ("V", [1.5, 2.5])}),
        ("time;M [µNm];n / min⁻¹\n0;1,5;2\n1;2,5;3\n", {"M": ("uN.m", [1.5, 2.5]), "n": ("rpm", [2, 3])}),
        (",time,u\n0,0.0,1\n1,0.1,2\n", {"u": ("", [1, 2])}),
        ("sep=;\ntime;u\n0;1,5\n1;2,5\n", {"u": ("", [1.5, 2.5])}),
        ('"Time (s)","Current, A","w ""rotor"" [rad/s]"\n"0","1","2"\n"1","1.5","3"\n',
         {"Current": ("A", [1, 1.5]), 'w "rotor"': ("rad/s", [2, 3])}),
        ("time,on,q\n0,true,10\n1,FALSE,11\n2,,12\n", {"on": ("", [1, 0, None]), "q": ("", [10, 11, 12])}),
    ],
)  # fmt: skip
def test_dialects_of_text(tmp_path: Path, text: str, expected: dict[str, tuple[str, list[float]]]) -> None:
    told = found(read(tmp_path / "r.txt", text))
    assert {n: (u, [None if x != x else x for x in values]) for n, (u, values) in told.items()} == expected


@pytest.mark.parametrize(
    ("text", "begins"),
    [
        ("Time,u\n2024-01-01T23:59:59.9,1\n2024-01-02T00:00:00,2\n2024-01-02T00:00:00.100,3\n",
         "2024-01-01T23:59:59.9"),
        ("stamp;u\n01.03.2024 08:00:00,25;1\n01.03.2024 08:00:00,35;2\n01.03.2024 08:00:00,45;3\n",
         "01.03.2024 08:00:00,25"),
        ("made 2020-01-01 00:00:00\nt u\n08:00:00.25 1\n08:00:00.35 2\n08:00:00.45 3\n", "08:00:00.25"),
        ("t,u\n2024-06-01 10:00:00+02:00,1\n2024-06-01 08:00:00.1Z,2\n2024-06-01 09:00:00.2+0100,3\n",
         "2024-06-01 10:00:00+02:00"),
        ("t,u\n10:00:00,1\n10:00:00.1,2\n10:00:00.2,3\n", "10:00:00"),
    ],
)  # fmt: skip
def test_instants_are_seconds_since_the_first(tmp_path: Path, text: str, begins: str) -> None:
    recorded = read(tmp_path / "r.csv", text)
    (channel,) = recorded.channels
    assert channel.time == pytest.approx([0.0, 0.1, 0.2], abs=1e-9) and channel.values.tolist() == [1, 2, 3]
    assert recorded.notes[-1] == f"time begins at 0, which is {begins}"


@pytest.mark.parametrize(
    ("head", "first", "factor"),
    [("time", "1764000000.001", 1), ("t [s]", "1764000000,001", 1), ("time [ns]", "1764000000000000001", 1e-9),
     ("stamp", "1764000000.5", 1)],
)  # fmt: skip
def test_times_far_from_zero_keep_all_their_digits(tmp_path: Path, head: str, first: str, factor: float) -> None:
    """They were rounded before the first was taken away: by 1e-7 s of seconds since 1970, and by 100 ns of ns."""
    stem, digit = first[:-1], int(first[-1])
    rows = "".join(f"{stem}{digit + k};{k}\n" for k in range(4))
    recorded = read(tmp_path / "r.csv", f"{head};u\n{rows}")
    step = factor * 10.0 ** -len(first.replace(",", ".").partition(".")[2])
    assert recorded["u"].time.tolist() == [k * step for k in range(4)] or head == "stamp"
    assert recorded["u"].time == pytest.approx([k * step for k in range(4)], rel=1e-15)
    assert f"time begins at 0; the file's begins at {first} {'ns' if factor < 1 else 's'}" in recorded.notes


def test_a_time_that_never_increases_is_refused(tmp_path: Path) -> None:
    """Seconds since 1970 in seven digits: all rows were written at 0 s, and lost their times without a word."""
    with pytest.raises(RecordingError, match=r"the time `time` is the same in all 3 rows: write more of its digits"):
        read(tmp_path / "r.csv", "time,u\n1.700000e+09,1\n1.700000e+09,2\n1.700000e+09,3\n")


def test_clock_times_go_on_past_midnight(tmp_path: Path) -> None:
    text = "t,u\n23:59:59.8,1\n23:59:59.9,2\n00:00:00,3\n00:00:00.1,4\n12:00:00,5\n23:59:59,6\n00:00:00,7\n"
    recorded = read(tmp_path / "r.csv", text)
    assert recorded["u"].time == pytest.approx([0, 0.1, 0.2, 0.3, 43200.2, 86399.2, 86400.2], abs=1e-9)
    assert recorded.notes[-1] == "clock times fall back 2 times by more than half a day: taken for midnight"
    late = read(tmp_path / "late.csv", "t,u\n10:00:01,1\n10:00:00,2\n")  # a clock that was set is none
    assert late["u"].time.tolist() == [0, -1] and len(late.notes) == 1


def test_a_column_that_counts_the_rows_is_left_out_with_a_word(tmp_path: Path) -> None:
    said = ("column 1, which has no name and counts the rows, is left out",)
    assert read(tmp_path / "r.csv", ",time,u\n0,0.0,1\n1,0.1,2\n").notes == said
    assert read(tmp_path / "e.csv", "time,u,\n0.0,1,\n0.1,2,\n").notes == ()
    pandas = pytest.importorskip("pandas")
    pandas.DataFrame({"time": TIME, "u": TIME}).to_excel(tmp_path / "r.xlsx")
    assert read_recorded(tmp_path / "r.xlsx").notes == said


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("time;n;i;u\n0,0;1.234,5;1,5;2,5\n", "line 2 `1.234,5` is none"),
        ("time,u\n2024/01/02 00:00:00,1\n", "line 2 `2024/01/02 00:00:00` is none"),
        ("time,u\n2024-13-01T00:00:00,1\n", ":2: `2024-13-01T00:00:00` is no instant: month must be in 1..12"),
        ("time,u\n0,1\n0.1,00:00:01\n", ":3: a time, where the first row, line 2, has no instant"),
        ("time,u\n0,1\n00:00:01,2\n", ":3: a time, where the first row, line 2, has no instant"),
        ("time,u\n10:00:00,1\n1,2\n", ":3: no instant, where the first row, line 2, has a time"),
        (
            "time,u\n2024-01-01 10:00:00,1\n10:00:01,2\n",
            ":3: a time, where the first row, line 2, has a day and a time",
        ),
        ("time,u\n10:00:00,1\n10:00:01Z,2\n", ":3: a time with its zone, where the first row, line 2, has a time"),
        ("time,u\n10:00:00,1\n1,10:00:01\n", ":3: its instant is not in column 1, as in the first row"),
        ('time,u\n0,"1\n1,2\n2,3\n', ":2: 1 fields where the header has 2"),
        ("time,u\n0;1\n1,2\n2,3\n", ":2: 1 fields where the header has 2"),
        ("time,u\n24:00:01,1\n", ":2: `24:00:01` is no instant"),
        ("time,on\n0,open\n", "line 2 `open` is none"),
        ("time,u\n0,inf\n1,2\n2,3\n", ":2: `inf` is no number, but `0` beside it is one"),
        ("time,u\n0,0x10\n1,2\n2,3\n", ":2: `0x10` is no number, but `0` beside it is one"),
        ("time,u,\ns,V,\n0,inf,\n1,2,\n", ":3: `inf` is no number, but `0` beside it is one"),
        ("time,5\n0,1\n1,2\n", ":1: `time` is no number, but `5` beside it is one"),
        ("time,u\n11:59:59 AM,1\n12:00:00 PM,2\n", "line 2 `11:59:59 AM` is none"),  # it was -1000000000 AM
        (",time,u\n7,0.0,1\n8,0.1,2\n", "column 1 has no name"),
        ("time,u\n0,1\n1,2\nEnd of file\n", ":4: 1 fields"),
        ("time,u,n\nERR,1,1\n0.1,2,3\n", ":2: no row of units and none of numbers: `ERR` is in neither"),
        ("time,u\n-00:00:01,1\n0.1,2\n", ":2: no row of units and none of numbers: `-00:00:01` is in neither"),
        ("time;n;u\n0,0;950;1,5\n0,1;1.020;1,8\n", ":3: field 2, `1.020`, is no number"),
        ("time;n\n0,0;950\n0,1;980\n0.2;980\n", ":4: field 1, `0.2`, is no number"),
        ('time,u,n\n0,1,2\n0.1,1"2,5\n', ':3: field 2, `1"2`, is no number'),
        ('time,u,n\n0,1,2\n0.1,"3""4",4\n', ':3: field 2, `3"4`, is no number'),
        ('time,u,n\n0,1,2\n0.1,"1,5"\n', ":3: 2 fields where the first row has 3"),
    ],
)
def test_what_is_no_number_is_named_with_its_line(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(RecordingError, match=said.replace(".", r"\.")):
        read(tmp_path / "r.csv", text)


def test_structures_and_matrices_of_matlab(tmp_path: Path) -> None:
    from scipy.io import savemat

    log = {"time": TIME, "u": 2 * TIME, "inner": {"x": 3 * TIME}, "note": "abc", "y": np.column_stack([TIME, TIME + 1])}
    savemat(tmp_path / "s.mat", {"log": log})
    recorded = read_recorded(tmp_path / "s.mat")
    assert {n: v for n, (_, v) in found(recorded).items()} == {
        "u": (2 * TIME).tolist(), "inner.x": (3 * TIME).tolist(), "y[1]": TIME.tolist(), "y[2]": (TIME + 1).tolist(),
    }  # fmt: skip
    assert recorded.notes == ("left out, for they hold no series of numbers: note",)


def test_a_structure_of_matlab_7_3(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "s.mat", "w") as file:
        group = file.create_group("log")
        group["time"], group["u"] = TIME[None, :], 2 * TIME[None, :]
        file.create_group("#refs#")["a"] = np.ones((1, 3))
    assert found(read_recorded(tmp_path / "s.mat")) == {"u": ("", (2 * TIME).tolist())}


def test_instants_are_time_and_truth_is_0_or_1(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    index = pandas.date_range("2024-01-01", periods=5, freq="100ms")
    pandas.DataFrame({"u": TIME, "on": [True, False] * 2 + [True], "s": list("abcde")}, index).to_parquet(
        tmp_path / "r.parquet"
    )
    recorded = read_recorded(tmp_path / "r.parquet")
    assert found(recorded) == {"u": ("", TIME.tolist()), "on": ("", [1, 0, 1, 0, 1])}
    assert np.allclose(recorded["u"].time, TIME, atol=1e-12)
    assert recorded.notes[0].endswith("numbers: s") and recorded.notes[1].startswith("time begins at 0, which is 2024")


def test_truth_in_a_spreadsheet_is_0_or_1(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    for row in (["time", "on"], [0.0, True], [0.1, False], [0.2, True]):
        book.active.append(row)
    book.save(tmp_path / "r.xlsx")
    assert found(read_recorded(tmp_path / "r.xlsx")) == {"on": ("", [1, 0, 1])}


def test_a_waveform_without_a_start_begins_at_zero(tmp_path: Path) -> None:
    nptdms = pytest.importorskip("nptdms")
    channels = [("a", "V", TIME, 0.1), ("b", "Nm", TIME[:3], 0.2)]
    with nptdms.TdmsWriter(tmp_path / "w.tdms") as file:
        said = [{"unit_string": unit, "wf_increment": step} for _, unit, _, step in channels]
        file.write_segment(
            [nptdms.ChannelObject("g", c[0], c[2], properties=p) for c, p in zip(channels, said, strict=True)]
        )
    recorded = read_recorded(tmp_path / "w.tdms")
    assert found(recorded) == {"a": ("V", TIME.tolist()), "b": ("N.m", TIME[:3].tolist())}
    assert np.allclose(recorded["b"].time, [0, 0.2, 0.4])


def test_a_channel_of_words_in_an_mdf_file_is_left_out_by_name(tmp_path: Path) -> None:
    asammdf = pytest.importorskip("asammdf")
    words = {"val_0": 0, "text_0": "N", "val_1": 1, "text_1": "D", "default": b"?"}
    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal(TIME, TIME, name="u", unit="V")])
        file.append([asammdf.Signal(np.arange(5), TIME, name="gear", conversion=words)])
        file.save(tmp_path / "w.mf4", overwrite=True)
    recorded = read_recorded(tmp_path / "w.mf4")
    assert found(recorded) == {"u": ("V", TIME.tolist())}
    assert "gear is converted by more than a straight line" in recorded.notes[0]


def test_no_row_of_a_spreadsheet_is_lost(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    path = tmp_path / "r.xlsx"
    pandas.DataFrame({"time": TIME, "u [V]": 2 * TIME}).to_excel(path)  # with the index of its rows
    assert found(read_recorded(path)) == {"u": ("V", (2 * TIME).tolist())}
    dates = pandas.date_range("2024-01-01", periods=5, freq="100ms")
    pandas.DataFrame({"when": dates, "u": TIME}).to_excel(path, index=False)
    assert np.allclose(read_recorded(path)["u"].time, TIME, atol=1e-3)
    pandas.DataFrame({"time": TIME, "u": TIME, "remark": ["begin", *[None] * 4]}).to_excel(path, index=False)
    with pytest.raises(RecordingError, match="column 3 of its row 2"):
        read_recorded(path)


@pytest.mark.parametrize("step", ["x", 0.0, -0.1, math.nan])
def test_a_waveform_that_has_no_time_is_refused(tmp_path: Path, step: str | float) -> None:
    nptdms = pytest.importorskip("nptdms")
    with nptdms.TdmsWriter(tmp_path / "w.tdms") as file:
        file.write_segment([nptdms.ChannelObject("g", "u", TIME, properties={"wf_increment": step})])
    with pytest.raises(RecordingError, match=f"channel u has no waveform time: .*{step}"):
        read_recorded(tmp_path / "w.tdms")


def test_a_name_in_two_groups_is_refused(tmp_path: Path) -> None:
    nptdms = pytest.importorskip("nptdms")
    with nptdms.TdmsWriter(tmp_path / "w.tdms") as file:
        file.write_segment([nptdms.ChannelObject(g, "u", TIME, properties={"wf_increment": 0.1}) for g in "ab"])
    with pytest.raises(RecordingError, match="u occurs more than once"):
        read_recorded(tmp_path / "w.tdms")


def test_a_file_whose_parts_do_not_fit_is_refused_in_a_sentence(tmp_path: Path) -> None:
    """As one of our own layout that was damaged, or made by hand: NumPy's error was a fault of ours."""
    from scipy.io import savemat

    savemat(tmp_path / "r.mat", {"time": TIME, "names": ["a", "b"], "data": np.array(["x", "y"])})
    with pytest.raises(RecordingError, match=r"r.mat: damaged, or laid out as no recording is \(ValueError"):
        read_recorded(tmp_path / "r.mat")
