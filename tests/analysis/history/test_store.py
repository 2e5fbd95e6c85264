"""The history store: SQLite, and PostgreSQL by a server of the test's own."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
import multiprocessing
import os
from pathlib import Path
import shutil
import socket
import sqlite3
import subprocess

import numpy as np
import pytest
from sqlalchemy import create_engine, text

from lacuna import fleet, forecast
from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis import store as module
from lacuna.analysis.prognosis.history import read_histories
from lacuna.analysis.prognosis.store import Entry, Store, file_hash

SERVERS = sorted(Path("/usr/lib/postgresql").glob("*/bin/postgres"))


@pytest.fixture(scope="session")
def postgresql(tmp_path_factory):
    """URL of a PostgreSQL server on a loopback port, ended after the tests."""
    if not SERVERS:
        pytest.skip("needs Debian's package postgresql: no server in /usr/lib/postgresql")
    pytest.importorskip("psycopg", reason="needs the Python package psycopg")
    binaries, user = SERVERS[-1].parent, None
    folder = Path("/tmp") / f"lacuna-postgresql-{os.getpid()}"  # the server's user must be able to enter it
    folder.mkdir(mode=0o700)
    if os.geteuid() == 0:  # the server refuses to be root
        shutil.chown(folder, "postgres", "postgres")
        user = "postgres"
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    run = {"user": user, "check": True, "capture_output": True, "cwd": folder}
    try:
        subprocess.run([binaries / "initdb", "-D", folder / "data", "-U", "lacuna", "-A", "trust", "--no-sync"], **run)
        options = f"-p {port} -c listen_addresses=127.0.0.1 -c unix_socket_directories={folder} -c fsync=off"
        command = [binaries / "pg_ctl", "-D", folder / "data", "-w", "-o", options, "-l", folder / "log"]
        subprocess.run([*command, "start"], **run)
        yield f"postgresql+psycopg://lacuna@127.0.0.1:{port}/postgres"
        subprocess.run([*command, "-m", "immediate", "stop"], **run)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request, tmp_path):
    if request.param == "sqlite":
        return str(tmp_path / "history.db")
    found = request.getfixturevalue("postgresql")
    with create_engine(found).begin() as connection:
        module._tables.drop_all(connection)
    return found


def entry(k: int, **changes) -> Entry:
    own = Entry(
        "A", 0.02 + 0.001 * k, 0.01, 0.2, f"recording {k}", "map 1", "1.0", cycles=10.0 * k, features={"rms": [1, 2]}
    )
    return replace(own, **changes)


def test_what_goes_in_comes_out_and_nothing_twice(url):
    store = Store(url)
    assert store.append([entry(1), entry(2), entry(1)]) == 2
    assert Store(url).append([entry(2), entry(3)]) == 1
    assert store.entries() == [entry(1), entry(2), entry(3)]


def test_a_newer_map_counts_and_the_older_is_kept(url):
    store = Store(url)
    store.append([entry(1), entry(2)])
    newer = entry(1, map="map 2", severity=0.05)
    store.append([newer])
    assert store.entries() == [newer, entry(2)]
    assert sorted(e.map for e in store.entries(all_maps=True)) == ["map 1", "map 1", "map 2"]


def test_histories_and_events(url):
    store = Store(url)
    store.append([entry(3, event="replaced"), entry(1), entry(2), entry(1, actuator="B", fault="friction")])
    a, b = store.histories()
    assert a.use.tolist() == [10, 20, 30] and a.replaced.tolist() == [False, False, True]
    assert (b.actuator, b.fault) == ("B", "friction")


def write_many(url: str, first: int) -> int:
    return Store(url).append([entry(k) for k in range(first, first + 20)])


def test_concurrent_writers(url):
    """Four processes, each twenty rows of which half are another's: every row once, and each counted by one of them."""
    with ProcessPoolExecutor(4, mp_context=multiprocessing.get_context("spawn")) as pool:
        added = list(pool.map(write_many, [url] * 4, [0, 10, 20, 30]))
    assert sum(added) == 50 and len(Store(url).entries()) == 50


def test_migrations_by_version(url, monkeypatch):
    Store(url).append([entry(1)])
    ran = []
    monkeypatch.setattr(module, "MIGRATIONS", [*module.MIGRATIONS, lambda connection: ran.append(connection)])
    assert Store(url).entries() == [entry(1)] and len(ran) == 1
    assert Store(url).entries() == [entry(1)] and len(ran) == 1
    monkeypatch.undo()
    with pytest.raises(AnalysisError, match="newer Lacuna"):
        Store(url)


def test_a_store_without_checksums_gets_them(url, monkeypatch):
    """As version 1 made it."""
    Store(url).append([entry(1), entry(2)])
    with create_engine(url if "://" in url else f"sqlite:///{url}").begin() as connection:
        connection.execute(text("ALTER TABLE lacuna_assessment DROP COLUMN checksum"))
        connection.execute(text("DELETE FROM lacuna_history WHERE version > 1"))
    assert Store(url).entries() == [entry(1), entry(2)]
    assert Store(url).append([entry(2), entry(3)]) == 1


@pytest.mark.parametrize(
    "change",
    ["severity = 0.03", "actuator = 'B'", "cycles = 11", "severity = 'much'", "low = 'x'", "low = 'x', checksum = ''"],
)
def test_a_row_that_was_changed_is_never_used(tmp_path, change):
    Store(tmp_path / "history.db").append([entry(1), entry(2)])
    with sqlite3.connect(tmp_path / "history.db") as connection:
        connection.execute(f"UPDATE lacuna_assessment SET {change} WHERE id = 2")
    with pytest.raises(AnalysisError, match="row 2 of lacuna_assessment"):
        Store(tmp_path / "history.db").histories()


def test_a_migration_that_fails_changes_nothing(url, monkeypatch):
    Store(url).append([entry(1)])

    def wrong(connection):
        connection.execute(module._assessments.delete())
        raise AnalysisError("no")

    monkeypatch.setattr(module, "MIGRATIONS", [*module.MIGRATIONS, wrong])
    with pytest.raises(AnalysisError, match="no"):
        Store(url)
    monkeypatch.undo()
    assert Store(url).entries() == [entry(1)]


@pytest.mark.parametrize("name", ["history.csv", "history.parquet"])
def test_what_is_exported_is_a_history(url, tmp_path, name):
    store = Store(url)
    store.append([entry(1), entry(2), entry(3, event="replaced")])
    store.export(tmp_path / name)
    (again,), (own,) = read_histories(tmp_path / name), store.histories()
    assert again.use.tolist() == own.use.tolist() and again.severity.tolist() == own.severity.tolist()
    assert again.replaced.tolist() == own.replaced.tolist()


def test_outdated_are_recordings_that_are_still_there(tmp_path):
    store, file = Store(tmp_path / "h.db"), tmp_path / "r.csv"
    file.write_text("1")
    store.append([entry(1, recording=file_hash(file), path=str(file)), entry(2)])
    assert [e.cycles for e in store.outdated("map 2")] == [10.0] and store.outdated("map 1") == []
    file.write_text("2")
    assert store.outdated("map 2") == []


def test_a_store_that_is_only_read_is_not_made(tmp_path):
    for read in (forecast, fleet):
        with pytest.raises(AnalysisError, match=r"nosuch\.db: there is no such file"):
            read(tmp_path / "nosuch.db")
    assert not list(tmp_path.iterdir())


def test_what_is_no_store_is_refused(tmp_path):
    (tmp_path / "damaged.db").write_bytes(b"SQLite format 3\x00" + b"?" * 2000)
    for url, message in [
        (str(tmp_path / "damaged.db"), "damaged.db: "),
        (str(tmp_path / "none" / "h.db"), "unable to open"),
        ("nothing://x", "not a database"),
        ("postgresql+psycopg://u:secret@127.0.0.1:1/x", r"u:\*\*\*@"),
    ]:
        with pytest.raises(AnalysisError, match=message):
            Store(url)


@pytest.mark.parametrize("name", ["h?x=1.db", "h%41.db", "q?uri=true.db", "file:z.db?mode=memory&uri=true"])
def test_a_path_is_the_file_of_that_name_whatever_it_holds(tmp_path, name):
    store = Store(tmp_path / name)
    store.append([entry(1)])
    assert [f.name for f in tmp_path.iterdir()] == [name]
    assert Store(tmp_path / name).entries() == [entry(1)]


def test_numbers_of_numpy_are_numbers(url):
    store = Store(url)
    store.append([entry(1, severity=np.float32(0.25), high=np.float64(0.5), cycles=np.int64(7))])
    assert [(e.severity, e.high, e.cycles) for e in store.entries()] == [(0.25, 0.5, 7.0)]


@pytest.mark.parametrize("change", [{"cycles": 11.0}, {"hours": 3.0}, {"event": "replaced"}])
def test_a_recording_that_is_stored_with_another_use_is_refused(url, change):
    store = Store(url)
    store.append([entry(1)])
    with pytest.raises(AnalysisError, match=f"this recording has {next(iter(change))} .*never changed"):
        store.append([entry(1, **change)])
    assert store.entries() == [entry(1)]


def test_a_spoilt_cell_is_named(tmp_path):
    store = Store(tmp_path / "h.db")
    store.append([entry(1)])
    with sqlite3.connect(tmp_path / "h.db") as connection:
        connection.execute("update lacuna_assessment set features = '{'")
    with pytest.raises(AnalysisError, match="damaged"):
        store.entries()


@pytest.mark.parametrize(
    "changes",
    [
        {"actuator": ""},
        {"cycles": None},
        {"severity": float("nan")},
        {"event": "mended"},
        {"cycles": -1.0},
        {"low": 0.3},
    ],
)
def test_what_is_no_assessment_is_refused(changes):
    with pytest.raises(AnalysisError):
        entry(1, **changes)
