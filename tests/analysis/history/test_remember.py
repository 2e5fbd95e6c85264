"""`lacuna assess --store`: recordings to a history, a forecast from it, and what a newer map makes of it."""

from __future__ import annotations

import shutil
import struct
import zlib

import numpy as np
import pytest
from typer.testing import CliRunner

import lacuna
from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.store import Entry, Store, file_hash
from lacuna.analysis.severity.preparation import TABLE_FILE
from lacuna.cli.main import app
from tests.analysis.reference import simulate

HEADER = "time,filter[1].y,filter[2].y,filter[3].y"
TRUTH = {100: 0.05, 200: 0.10, 300: 0.15, 400: 0.20}  # cycles: severity


@pytest.fixture(scope="module")
def recordings(tmp_path_factory):
    folder = tmp_path_factory.mktemp("recordings")
    for cycles, zeta in TRUTH.items():
        columns = np.vstack([np.arange(100000) / 1e5, simulate(zeta)[:3]]).T
        np.savetxt(folder / f"{cycles}.csv", columns, delimiter=",", fmt="%.9g", header=HEADER, comments="")
    return folder


def assessed(recording, map_folder, store, out, *more):
    arguments = ["assess", str(recording), "--map", str(map_folder), "--store", str(store), "--out", str(out), *more]
    return CliRunner().invoke(app, arguments)


def newer(map_folder, folder, factor):
    """The same map, made again: it calls every severity `factor` times what it was."""
    shutil.copytree(map_folder, folder)
    data = bytearray((folder / TABLE_FILE).read_bytes()[:-4])
    count = struct.unpack_from("<8s8I", data)[2]
    start = struct.calcsize("<8s8I") + struct.calcsize("<5d")
    values = np.frombuffer(data, "<f8", count, start) * factor
    data[start : start + values.nbytes] = values.tobytes()
    (folder / TABLE_FILE).write_bytes(bytes(data) + struct.pack("<I", zlib.crc32(data)))
    return folder


def test_from_recordings_to_a_forecast_and_again_by_a_newer_map(tmp_path, map_folder, recordings):
    store = tmp_path / "history.db"
    options = ["--actuator", "A17", "--cycles", "100"]
    for said in ("stored: 1 new", "stored before"):
        done = assessed(recordings / "100.csv", map_folder, store, tmp_path / "out", *options)
        assert done.exit_code == 0 and said in done.output, done.output
    for cycles in list(TRUTH)[1:]:
        assert lacuna.remember(recordings / f"{cycles}.csv", map_folder, store, actuator="A17", cycles=cycles) == 1
    (history,) = Store(store).histories()
    assert history.use.tolist() == list(TRUTH) and history.severity == pytest.approx(list(TRUTH.values()), abs=0.005)
    own = lacuna.forecast(str(store), map_folder)["A17"]
    low, high = own["violet"]["interval95"]
    assert own["verdict"] == "forecast" and low < 280 < high  # the limit, 0.34, is at 680 cycles
    assert lacuna.refresh(store, map_folder) == 0
    (recordings / "400.csv").rename(tmp_path / "400.csv")  # is no longer where it was: its old reading stays
    assert lacuna.refresh(store, newer(map_folder, tmp_path / "newer", 0.9)) == 3
    (tmp_path / "400.csv").rename(recordings / "400.csv")
    (again,) = Store(store).histories()
    assert again.severity[:3] == pytest.approx(0.9 * history.severity[:3], rel=1e-3)
    assert again.severity[3] == history.severity[3] and len(Store(store).entries(all_maps=True)) == 7


def test_a_history_of_recordings_is_assessed(tmp_path, map_folder, recordings):
    rows = "\n".join(f"A,{cycles},{recordings / f'{cycles}.csv'}" for cycles in TRUTH)
    (tmp_path / "history.csv").write_text(f"actuator,cycles,recording\n{rows}\n")
    own = lacuna.forecast(tmp_path, map_folder)["A"]
    assert own["tests"] == 4 and own["severity"]["value"] == pytest.approx(0.2, abs=0.01)


def test_an_assessment_without_actuator_or_use_is_not_stored(tmp_path, map_folder, recordings):
    for actuator, cycles in (("", 3.0), ("A", None)):
        with pytest.raises(AnalysisError, match="needs its actuator, and its cycles or hours"):
            lacuna.remember(recordings / "100.csv", map_folder, tmp_path / "h.db", actuator=actuator, cycles=cycles)


def test_a_recording_that_a_newer_map_refuses_keeps_its_reading(tmp_path, map_folder, recordings):
    """What else there is is read again first; then the refusal is told, with the file."""
    store, bad = tmp_path / "h.db", tmp_path / "a.csv"
    bad.write_text(f"{HEADER}\n0,0,0,0\n")
    Store(store).append([Entry("A", 0.1, 0.09, 0.11, file_hash(bad), "older map", "0.1", cycles=1.0, path=str(bad))])
    good = recordings / "200.csv"
    Store(store).append([Entry("B", 0.3, 0.2, 0.4, file_hash(good), "older map", "0.1", cycles=1.0, path=str(good))])
    with pytest.raises(AnalysisError, match=r"1 of 2 recordings keep .*a\.csv"):
        lacuna.refresh(store, map_folder)
    a, b = Store(store).entries()
    assert a.severity == 0.1 and b.severity == pytest.approx(0.1, abs=0.005)


@pytest.mark.parametrize("read", [lacuna.forecast, lacuna.fleet])
def test_what_reads_a_store_makes_none(tmp_path, read):
    """A slip in its name left an empty store of that name, which was said to hold no assessment."""
    with pytest.raises(AnalysisError, match=r"slip\.db: there is no such store"):
        read(tmp_path / "slip.db", out=tmp_path / "out")
    assert not (tmp_path / "slip.db").exists()
