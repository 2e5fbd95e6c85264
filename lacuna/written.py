"""Files that are there whole or not at all: after an exception, a full disk, a kill, a power cut.

What is new is written into a folder of its own beside its place, synced to the disk, and renamed; then the folder that
holds the names is synced, too. Where a rename fails, those before it are taken back. A power cut between the renames of
several files, or a disk that refuses everything from there on, can leave some of each making: the command that made
them makes them again. What is not `lasting`, as in a cache whose reader sees what is damaged, is not synced: to make
hundreds of small files takes less time than to wait for the disk.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
import fcntl
from functools import lru_cache
import os
from pathlib import Path
import shutil
import tempfile

_SCRATCH = ".partial-"
_BEFORE = ".before"  # in the scratch folder: what is replaced, until all has been


@contextmanager
def whole_file(path: Path, lasting: bool = True) -> Iterator[Path]:
    """Where to write what then replaces `path`, if the block ends well. A link is followed, a mode kept."""
    path = path.resolve() if path.is_symlink() else path
    with _scratch(path.parent) as scratch:
        partial = scratch / path.name
        yield partial
        if path.exists():
            shutil.copymode(path, partial)
        if lasting:
            _sync(partial)
        partial.replace(path)
        if lasting:
            _sync_names(path.parent)


@contextmanager
def whole_files(folder: Path, lasting: bool = True) -> Iterator[Path]:
    """A folder whose files then replace those of the same name in `folder`, all of them if the block ends well, or
    none; folders in it must be new."""
    with _scratch(folder) as scratch:
        yield scratch
        made = sorted(scratch.iterdir())
        for path in scratch.rglob("*") if lasting else ():
            _sync(path)
        _replace_all(made, folder, scratch / _BEFORE)
        if lasting:
            _sync_names(folder)


def write_whole(path: Path, content: str | bytes, lasting: bool = True) -> None:
    """`path` with this content, texts in UTF-8."""
    with whole_file(path, lasting) as partial:
        partial.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))


def _replace_all(made: list[Path], folder: Path, before: Path) -> None:
    before.mkdir()
    for path in made:
        if (folder / path.name).exists():
            _keep(folder / path.name, before / path.name)
    replaced = []
    try:
        for path in made:
            path.replace(folder / path.name)
            replaced.append(folder / path.name)
    except BaseException:
        for target in replaced:
            with suppress(OSError):  # the disk refuses this, too: what is said is the first refusal
                if (before / target.name).exists():
                    (before / target.name).replace(target)
                else:  # a file or a folder: it goes with the scratch folder
                    target.replace(before / target.name)
        raise


def _keep(path: Path, kept: Path) -> None:
    """A second name of a file; where the file system has none, a copy."""
    try:
        kept.hardlink_to(path)
    except OSError:
        shutil.copy2(path, kept)


@contextmanager
def _scratch(folder: Path) -> Iterator[Path]:
    """A folder in `folder` that is gone afterwards. It is locked, so that others see whether we are still there."""
    folder.mkdir(parents=True, exist_ok=True)
    _remove_abandoned(folder)
    scratch, handle = _locked(folder)
    try:
        yield scratch
    finally:
        os.close(handle)
        shutil.rmtree(scratch, ignore_errors=True)


def _locked(folder: Path) -> tuple[Path, int]:
    """A new folder in `folder` and the handle that locks it. Another process may have taken it away as abandoned before
    it was locked: then a further one."""
    while True:
        scratch = Path(tempfile.mkdtemp(prefix=_SCRATCH, dir=folder))
        try:
            handle = os.open(scratch, os.O_RDONLY)
        except FileNotFoundError:
            continue
        with suppress(OSError):  # a file system without locks
            fcntl.flock(handle, fcntl.LOCK_EX)
        if scratch.exists():
            return scratch, handle
        os.close(handle)


@lru_cache(maxsize=1024)
def _remove_abandoned(folder: Path) -> None:
    """Remove what killed processes left: scratch folders that nobody has locked. Once a process, which is cheap."""
    for scratch in folder.glob(f"{_SCRATCH}*"):
        with suppress(OSError):
            handle = os.open(scratch, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(scratch, ignore_errors=True)
            finally:
                os.close(handle)


def _sync(path: Path) -> None:
    """Have the disk hold the content of `path`."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _sync_names(folder: Path) -> None:
    """Have the disk hold the names in `folder`, where its file system can. Where not, a power cut may bring back the
    files that were there before, whole: nothing to fail for."""
    with suppress(OSError):
        _sync(folder)
