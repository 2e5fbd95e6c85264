"""Files that come in: of a size that can be read, and whole; and parts that are read again."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING
import zipfile

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.written import whole_file

if TYPE_CHECKING:
    import pyarrow as pa

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


def write_part(path: Path, table: pa.Table) -> None:
    """A part of a long computation, with checksums, so that `has_part` notices damage."""
    import pyarrow.parquet as pq

    with whole_file(path) as partial:
        pq.write_table(table, partial, write_page_checksum=True)


def has_part(path: Path) -> bool:
    """Whether a part is there as it was written; a damaged one is as good as none and is computed again."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        pq.read_table(path, page_checksum_verification=True)
    except (OSError, pa.ArrowException):
        return False
    return True
