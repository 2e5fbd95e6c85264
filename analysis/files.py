"""Files that come in: of a size that can be read, and whole."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
import zipfile

import numpy as np

from lacuna.analysis.errors import AnalysisError

LARGEST = 1 << 30  # bytes of a file that is read: a hundred signals for a quarter of an hour at 1 kHz as text


def check_file(path: Path, error: type[Exception] = AnalysisError) -> None:
    """Raises `error` where `path` is no file of a size that is read: devices and pipes have no end."""
    if not path.is_file():
        raise error(f"{path}: {'is not a file' if path.exists() else 'there is no such file'}")
    if path.stat().st_size > LARGEST:
        raise error(f"{path}: larger than {LARGEST >> 20} MB")


def load_arrays(path: Path, names: Sequence[str]) -> dict[str, np.ndarray]:
    """These arrays of an .npz file. Raises AnalysisError where it is missing or damaged, or has not all of them."""
    try:
        with np.load(path, allow_pickle=False) as content:
            return {name: content[name] for name in names}
    except FileNotFoundError:
        raise AnalysisError(f"{path} is missing: the map was not prepared for assessment") from None
    except (OSError, ValueError, KeyError, EOFError, NotImplementedError, RuntimeError, zipfile.BadZipFile) as error:
        raise AnalysisError(f"{path} is damaged or of another version, prepare the map again: {error}") from None
