"""Expensive results kept on disk, so that an interrupted explanation goes on where it stopped.

A result is found again by the hash of everything it depends on; it is written beside its place and renamed, so what is
there is whole. Without a folder (the default) nothing is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import hashlib
import json
from pathlib import Path
import shutil
from typing import Any
import zipfile

import numpy as np

from lacuna.discovery.fit.kept.plain_values import load, save, to_tree
from lacuna.written import whole_file

_folder: Path | None = None
_version = ""  # of this package's sources


def _sources() -> str:
    files = sorted(Path(__file__).parents[1].rglob("*.py"))
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
    """The result of `compute`, or the one that was kept for the same `parts`; a damaged one is computed again.

    Parts and result are plain values (`plain_values`).
    """
    if _folder is None:
        return compute()
    path = _folder / f"{_digest((_version, *parts()))}.npz"
    try:
        return load(path)
    except (OSError, EOFError, ValueError, KeyError, TypeError, zipfile.BadZipFile):
        pass
    value = compute()
    with whole_file(path, lasting=False) as partial:
        save(partial, value)
    return value


def _digest(parts: tuple[Any, ...]) -> str:
    arrays: list[np.ndarray] = []
    tree = json.dumps(to_tree(parts, arrays, any_class=True), sort_keys=True)
    digest = hashlib.sha256(tree.encode())
    for array in arrays:
        digest.update(f"{array.dtype.str} {array.shape}".encode() + np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()[:32]
