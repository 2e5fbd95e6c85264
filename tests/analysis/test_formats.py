"""One recording in every format that is read: the same numbers, names and units; and what is damaged is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
import time

import numpy as np
import pytest

from lacuna.analysis.recording.channel import RecordingError, on_one_time
from lacuna.analysis.recording.formats import read_recorded, write_recorded

TIME = np.round(np.arange(200) * 1e-3, 3)
CURRENT = np.round(np.sin(40 * TIME), 4)
SPEED = np.round(100 * TIME, 1)
COLUMNS = {"time": (TIME, "s"), "motor.i": (CURRENT, "A"), "w[1]": (SPEED, "rad/s")}


def csv(path: Path) -> Path:
    rows = [",".join(f"{name} [{unit}]" for name, (_, unit) in COLUMNS.items())]
    rows += [",".join(map(repr, row)) for row in zip(*(v.tolist() for v, _ in COLUMNS.values()), strict=True)]
    path.write_text("\n".join(rows) + "\n")
    return path


def mat5(path: Path) -> Path:
    from scipy.io import savemat

    names = list(COLUMNS)[1:]
    table = {
        "time": TIME,
        "names": np.array(names, dtype=object),
        "units": np.array([COLUMNS[n][1] for n in names], dtype=object),
        "data": np.column_stack([COLUMNS[n][0] for n in names]),
    }
    savemat(path, table, oned_as="column")
    return path


def parquet(path: Path) -> Path:
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow.parquet import write_table

    fields = [pyarrow.field(n, pyarrow.float64(), metadata={"unit": u}) for n, (_, u) in COLUMNS.items()]
    write_table(pyarrow.table([v for v, _ in COLUMNS.values()], schema=pyarrow.schema(fields)), path)
    return path


def mf4(path: Path) -> Path:
    asammdf = pytest.importorskip("asammdf")
    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal(v, TIME, name=n, unit=u) for n, (v, u) in list(COLUMNS.items())[1:]])
        file.save(path, overwrite=True)
    return path


def tdms(path: Path) -> Path:
    nptdms = pytest.importorskip("nptdms")
    with nptdms.TdmsWriter(path) as file:
        file.write_segment(
            [nptdms.ChannelObject("test", n, v, properties={"unit_string": u}) for n, (v, u) in COLUMNS.items()]
        )
    return path


def xlsx(path: Path) -> Path:
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    rows = [list(COLUMNS), [u for _, u in COLUMNS.values()]]
    rows += [list(row) for row in zip(*(v.tolist() for v, _ in COLUMNS.values()), strict=True)]
    pandas.DataFrame(rows).to_excel(path, header=False, index=False)
    return path


def mat73(path: Path) -> Path:
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w") as file:
        for name, (values, _) in COLUMNS.items():
            file[name] = values[None, :]
    return path


FORMATS: dict[str, Callable[[Path], Path]] = {
    "a.csv": csv, "a.mat": mat5, "a.parquet": parquet, "a.mf4": mf4, "a.tdms": tdms, "a.xlsx": xlsx, "b.mat": mat73,
}  # fmt: skip
WITHOUT_UNITS = ("b.mat",)


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_gives_the_same_recording(name: str, tmp_path: Path) -> None:
    recorded = read_recorded(FORMATS[name](tmp_path / name))
    assert {c.name for c in recorded.channels} == {"motor.i", "w[1]"}
    for channel in recorded.channels:
        values, unit = COLUMNS[channel.name]
        assert np.array_equal(channel.values, values)
        assert np.array_equal(channel.time, TIME)
        assert channel.unit == ("" if name in WITHOUT_UNITS else unit)


@pytest.mark.parametrize("name", ["a.csv", "a.mat", "a.parquet", "a.mf4", "a.tdms", "a.xlsx"])
def test_what_is_written_in_a_format_reads_back_the_same(name: str, tmp_path: Path) -> None:
    if name != "a.csv":
        FORMATS[name](tmp_path / name).unlink()  # skips where its package is missing
    source = read_recorded(csv(tmp_path / "source.csv"))
    write_recorded(source, tmp_path / name)
    again = read_recorded(tmp_path / name)
    for channel in source.channels:
        assert np.array_equal(again[channel.name].values, channel.values)
        assert np.array_equal(again[channel.name].time, channel.time)
        assert again[channel.name].unit == channel.unit


@pytest.mark.parametrize("name", ["a.csv", "a.mat", "a.parquet", "a.mf4", "a.tdms", "a.xlsx"])
def test_equal_recordings_are_equal_bytes(name: str, tmp_path: Path) -> None:
    FORMATS[name](tmp_path / name).unlink()  # skips where its package is missing
    source, made = read_recorded(csv(tmp_path / "source.csv")), []
    for _ in range(2):
        write_recorded(source, tmp_path / name)
        made.append((tmp_path / name).read_bytes())
        time.sleep(2.1)  # the resolution of times in an archive
    assert made[0] == made[1]


@pytest.mark.parametrize(("name", "instead"), [("a.ods", ".xlsx"), ("a.mdf", ".mf4"), ("a.mf3", ".mf4")])
def test_what_is_read_only_is_not_written_under_its_name(tmp_path: Path, name: str, instead: str) -> None:
    with pytest.raises(RecordingError, match=f"{name}: .* is read only; write {instead}"):
        write_recorded(read_recorded(csv(tmp_path / "source.csv")), tmp_path / name)
    assert not (tmp_path / name).exists()


@pytest.mark.parametrize("name", ["", " ", "a\nb"])
def test_a_channel_has_a_name_that_can_be_read_again(tmp_path: Path, name: str) -> None:
    source = read_recorded(csv(tmp_path / "source.csv"))
    named = replace(source, channels=(replace(source.channels[0], name=name),))
    with pytest.raises(RecordingError, match="cannot be called"):
        write_recorded(named, tmp_path / "a.csv")
    assert not (tmp_path / "a.csv").exists()


def test_a_file_has_one_time(tmp_path: Path) -> None:
    (tmp_path / "two.csv").write_text("time,time [s],u\n0,5,1\n1,6,2\n", encoding="utf-8")
    with pytest.raises(RecordingError, match="two columns called time"):
        write_recorded(read_recorded(tmp_path / "two.csv"), tmp_path / "out.csv")


@pytest.mark.parametrize("name", FORMATS)
def test_a_damaged_file_is_refused_by_name(name: str, tmp_path: Path) -> None:
    path = FORMATS[name](tmp_path / name)
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2] + b"\xff\x00broken\x00")
    with pytest.raises(RecordingError, match=name):
        read_recorded(path)


def test_a_formula_in_an_mdf_file_is_not_evaluated(tmp_path: Path) -> None:
    asammdf = pytest.importorskip("asammdf")
    signal = asammdf.Signal(np.arange(5.0), np.arange(5.0), name="x", conversion={"formula": "X1 * 2"})
    with asammdf.MDF(version="4.10") as file:
        file.append([signal])
        file.save(tmp_path / "f.mf4", overwrite=True)
    with pytest.raises(RecordingError, match="x is converted by more than a straight line"):
        read_recorded(tmp_path / "f.mf4")


def test_a_linear_conversion_of_an_mdf_file_is_applied(tmp_path: Path) -> None:
    asammdf = pytest.importorskip("asammdf")
    raw = np.arange(5, dtype=np.int16)
    signal = asammdf.Signal(raw, np.arange(5.0), name="x", unit="V", conversion={"a": 0.5, "b": 1.0})
    with asammdf.MDF(version="4.10") as file:
        file.append([signal])
        file.save(tmp_path / "l.mf4", overwrite=True)
    assert np.array_equal(read_recorded(tmp_path / "l.mf4")["x"].values, 0.5 * raw + 1)


def test_channels_keep_their_own_rates(tmp_path: Path) -> None:
    asammdf = pytest.importorskip("asammdf")
    fast, slow = np.arange(10) * 0.1, np.arange(4) * 0.25
    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal(fast * 2, fast, name="a", unit="V")])
        file.append([asammdf.Signal(slow * 3, slow, name="b", unit="A")])
        file.save(tmp_path / "r.mf4", overwrite=True)
    recorded = read_recorded(tmp_path / "r.mf4")
    assert np.array_equal(recorded["b"].time, slow)
    time, (a, b) = on_one_time(recorded.channels)
    assert np.array_equal(time, np.unique([*fast, *slow]))
    assert np.isfinite(a).sum() == 10 and np.isfinite(b).sum() == 4


def test_a_modelica_result_is_a_recording(tmp_path: Path) -> None:
    from scipy.io import savemat

    names = [name.ljust(6) for name in ("time", "body.v", "minus")]
    table = {
        "Aclass": np.array(["Atrajectory", "1.1", "", "binTrans"]),
        "name": np.array(["".join(letters) for letters in zip(*names, strict=True)]),
        "dataInfo": np.array([[0, 1, 0, -1], [2, 2, 0, -1], [2, -2, 0, -1]]).T.astype(np.int32),
        "data_2": np.vstack([TIME, SPEED]),
    }
    savemat(tmp_path / "r.mat", table, format="4")
    recorded = read_recorded(tmp_path / "r.mat")
    assert np.array_equal(recorded["body.v"].values, SPEED)
    assert np.array_equal(recorded["minus"].values, -SPEED)


@pytest.mark.parametrize("name", ["a.docx", "a"])
def test_an_unknown_format_is_refused_with_those_that_are_known(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text("x")
    with pytest.raises(RecordingError, match=r"there are \.csv"):
        read_recorded(tmp_path / name)


def test_unequal_vectors_are_refused(tmp_path: Path) -> None:
    from scipy.io import savemat

    savemat(tmp_path / "u.mat", {"time": np.arange(5.0), "a": np.arange(4.0)})
    with pytest.raises(RecordingError, match="differ in length: time 5, a 4"):
        read_recorded(tmp_path / "u.mat")


def simulated(path: Path) -> Path:
    path.write_text("time,w\n0,1\n1,2\n")
    path.with_suffix(".meta.json").write_text(
        '{"format": "lacuna-result-1", "columns": {"w": {"unit": "rad/s"}, "time": 7}}'
    )
    return path


def test_units_of_a_simulated_result_come_from_the_file_beside_it(tmp_path: Path) -> None:
    (speed,) = read_recorded(simulated(tmp_path / "run.csv")).channels
    assert (speed.name, speed.unit) == ("w", "rad/s")


def test_a_damaged_file_of_units_is_refused_by_name(tmp_path: Path) -> None:
    path = simulated(tmp_path / "run.csv")
    path.with_suffix(".meta.json").write_text('{"format": ')
    with pytest.raises(RecordingError, match=r"run\.meta\.json"):
        read_recorded(path)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("time,x\n0,1e999\n1,2\n", "largest number"),
        ("time,x\n0,inf\n1,2\n", ":2: `inf` is no number"),
        ("u;time\n-8,5e-07;1_0\n-2,1;1,9\n4,8;2,1\n", ":2: `1_0` is no number"),
        ("time,x\x1b[31m\n0,1\n1,2\n", "no text"),
    ],
)
def test_what_is_no_number_and_no_text_is_refused(tmp_path, text, reason):
    path = tmp_path / "hostile.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(RecordingError, match=reason):
        read_recorded(path)


def test_parquet_without_signals_rows_or_readable_units_is_refused(tmp_path):
    import pyarrow
    from pyarrow import parquet

    path, times = tmp_path / "hostile.parquet", pyarrow.array([0.0, 1.0])
    unit = pyarrow.field("x", pyarrow.float64(), metadata={"unit": b"\xff\xfe"})
    parquet.write_table(pyarrow.table([times, times], schema=pyarrow.schema([("time", pyarrow.float64()), unit])), path)
    assert read_recorded(path).channels[0].name == "x"
    for table in ({"time": times}, {"time": times[:0], "x": times[:0]}):
        parquet.write_table(pyarrow.table(table), path)
        with pytest.raises(RecordingError, match="there is no"):
            read_recorded(path)
    parquet.write_table(pyarrow.table({"time": times, "xyzzy": times}), path)
    path.write_bytes(path.read_bytes().replace(b"xyzzy", b"\xffyzzy"))
    with pytest.raises(RecordingError, match="can be read"):
        read_recorded(path)


def test_parquet_with_an_inexact_integer_or_a_name_twice_is_refused(tmp_path):
    import pyarrow
    from pyarrow import parquet

    path = tmp_path / "hostile.parquet"
    parquet.write_table(pyarrow.table({"time": [0, 1], "x": [2**63 - 1, 0]}), path)
    with pytest.raises(RecordingError, match="x holds whole numbers beyond"):
        read_recorded(path)
    columns = [pyarrow.array([0.0, 1.0])] * 3
    parquet.write_table(pyarrow.Table.from_arrays(columns, names=["time", "x", "x"]), path)
    with pytest.raises(RecordingError, match=r"hostile\.parquet"):
        read_recorded(path)


def test_a_mat_table_with_more_columns_than_names_is_refused(tmp_path):
    from scipy.io import savemat

    names = np.array(["a", "b"], object)
    savemat(tmp_path / "table.mat", {"time": np.arange(5.0), "names": names, "data": np.zeros((5, 3))})
    with pytest.raises(RecordingError, match="2 names, 5 times and data of 5 by 3 do not go together"):
        read_recorded(tmp_path / "table.mat")
