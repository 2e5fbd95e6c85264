"""What is written is there whole or not at all, and with it nothing that was not asked for."""

from __future__ import annotations

import fcntl
import os
from pathlib import Path
import subprocess
import sys

import pytest

from lacuna import written
from lacuna.codegen.cache import Cache
from lacuna.discovery.fit.kept.store import kept, remembered
from lacuna.written import whole_file, whole_files, write_whole


def content(folder: Path) -> dict[str, str]:
    return {p.name: p.read_text() for p in folder.iterdir()}


def refuse_to_rename(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    rename = Path.replace

    def refuse(path: Path, target: Path) -> Path:
        if path.name == name:
            raise OSError("refused")
        return rename(path, target)

    monkeypatch.setattr(Path, "replace", refuse)


def test_an_exception_leaves_what_was_there(tmp_path: Path) -> None:
    write_whole(tmp_path / "a", "old")
    with pytest.raises(KeyboardInterrupt), whole_file(tmp_path / "a") as partial:
        partial.write_text("half")
        raise KeyboardInterrupt
    with pytest.raises(ValueError), whole_files(tmp_path) as scratch:
        (scratch / "a").write_text("new")
        (scratch / "b").write_text("new")
        raise ValueError
    assert content(tmp_path) == {"a": "old"}


def test_where_one_cannot_be_renamed_none_is(tmp_path: Path) -> None:
    write_whole(tmp_path / "a", "old")
    (tmp_path / "c").mkdir()
    with pytest.raises(OSError), whole_files(tmp_path) as scratch:
        for name in "abc":
            (scratch / name).write_text("new")
    assert content(tmp_path / "c") == {}
    (tmp_path / "c").rmdir()
    assert content(tmp_path) == {"a": "old"}


def test_a_rename_that_fails_half_way_takes_the_others_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_whole(tmp_path / "a", "old")
    refuse_to_rename("c", monkeypatch)
    with pytest.raises(OSError, match="refused"), whole_files(tmp_path) as scratch:
        for name in "abc":
            (scratch / name).write_text("new")
    assert content(tmp_path) == {"a": "old"}


def test_a_link_is_followed_and_a_mode_kept(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old")
    (tmp_path / "real").chmod(0o640)
    (tmp_path / "link").symlink_to("real")
    write_whole(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "new"
    assert (tmp_path / "real").stat().st_mode & 0o777 == 0o640


def test_what_a_killed_process_left_goes_and_what_a_living_one_writes_stays(tmp_path: Path) -> None:
    """A process that is killed while it writes, and this one, which writes meanwhile."""
    kill = "import os, sys; from pathlib import Path; from lacuna.written import whole_file\n"
    kill += "with whole_file(Path(sys.argv[1])) as p: p.write_text('x'); os.kill(os.getpid(), 9)"
    subprocess.run([sys.executable, "-c", kill, str(tmp_path / "a")], check=False)
    (abandoned,) = tmp_path.iterdir()
    with whole_file(tmp_path / "b") as partial:
        partial.write_text("new")
        written._remove_abandoned.cache_clear()
        write_whole(tmp_path / "c", "new")
        assert not abandoned.exists()
    assert content(tmp_path) == {"b": "new", "c": "new"}


def test_one_that_is_taken_for_abandoned_before_it_is_locked_is_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lock, taken = fcntl.flock, []

    def late(handle: int, how: int) -> None:
        if not taken:
            taken.extend(tmp_path.iterdir())
            taken[0].rmdir()
        lock(handle, how)

    monkeypatch.setattr(fcntl, "flock", late)
    write_whole(tmp_path / "a", "new")
    assert taken
    assert content(tmp_path) == {"a": "new"}


def test_folders_are_taken_back_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    refuse_to_rename("b", monkeypatch)
    with pytest.raises(OSError, match="refused"), whole_files(tmp_path) as scratch:
        for name in "ab":
            (scratch / name).mkdir()
            (scratch / name / "file").write_text("new")
    assert list(tmp_path.iterdir()) == []


def test_only_a_cache_does_not_wait_for_the_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    synced: list[int] = []
    monkeypatch.setattr(os, "fsync", synced.append)
    Cache(str(tmp_path / "models")).build("0" * 64, "int nothing;\n")
    with kept(tmp_path / "kept"):
        remembered(lambda: ("question",), lambda: 42)
    assert not synced
    write_whole(tmp_path / "a", "result")
    with whole_files(tmp_path) as scratch:
        (scratch / "b").write_text("result")
    assert len(synced) == 4  # two files, and twice the folder that holds their names
