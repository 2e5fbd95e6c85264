"""Expensive results kept on disk, so that an interrupted explanation goes on where it stopped.

A result is found again by the hash of everything it depends on; it is written beside its place and renamed, so what is
there is whole. Without a folder (the default) nothing is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import hashlib
import os
from pathlib import Path
import pickle
import shutil
import threading
from typing import Any

_folder: Path | None = None
_version = ""  # of this package's sources


def _sources() -> str:
    files = sorted(Path(__file__).parent.glob("*.py"))
    return hashlib.sha256(b"\0".join(f.read_bytes() for f in files)).hexdigest()


@contextmanager
def kept(folder: Path) -> Iterator[None]:
    """Keep results in `folder` while inside; it is removed when all went well."""
    global _folder, _version
    _version = _sources()
    folder.mkdir(parents=True, exist_ok=True)
    _folder = folder
    try:
        yield
    finally:
        _folder = None
    shutil.rmtree(folder)


def remembered(parts: Callable[[], tuple[Any, ...]], compute: Callable[[], Any]) -> Any:
    """The result of `compute`, or the one that was kept for the same `parts` (anything that can be pickled)."""
    if _folder is None:
        return compute()
    path = _folder / f"{_digest((_version, *parts()))}.pickle"
    if path.exists():
        return pickle.loads(path.read_bytes())
    value = compute()
    partial = path.with_suffix(f".{os.getpid()}.{threading.get_ident()}.tmp")
    partial.write_bytes(pickle.dumps(value))
    partial.replace(path)
    return value


def _digest(parts: tuple[Any, ...]) -> str:
    return hashlib.sha256(pickle.dumps(parts)).hexdigest()[:32]
