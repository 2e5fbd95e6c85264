"""Files of ours that are read again: arrays, and parts of long computations."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING
import zipfile

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.given import require_file
from lacuna.written import whole_file

if TYPE_CHECKING:
    import pyarrow as pa


def load_arrays(path: Path, names: Sequence[str]) -> dict[str, np.ndarray]:
    """These arrays of an .npz file. Raises AnalysisError where it is missing or damaged, or has not all of them."""
    if path.exists():
        require_file(path, AnalysisError)
    try:
        with np.load(path, allow_pickle=False) as content:
            return {name: content[name] for name in names}
    except FileNotFoundError:
        raise AnalysisError(f"{path} is missing: the map was not prepared for assessment") from None
    except (OSError, ValueError, KeyError, EOFError, NotImplementedError, RuntimeError, zipfile.BadZipFile) as error:
        raise AnalysisError(f"{path} is damaged or of another version, prepare the map again: {error}") from None


_PART = b"part"  # of a file's metadata: the name that it was written under


def write_part(path: Path, table: pa.Table) -> None:
    """A part of a long computation, with its name and checksums, so that `has_part` notices what happened to it."""
    import pyarrow.parquet as pq

    with whole_file(path) as partial:
        pq.write_table(table.replace_schema_metadata({_PART: path.name}), partial, write_page_checksum=True)


def read_part(path: Path) -> pa.Table:
    """The table of a part that is there."""
    import pyarrow.parquet as pq

    return pq.read_table(path).replace_schema_metadata()


def has_part(path: Path) -> bool:
    """Whether a part is there as it was written: what is damaged, or was put there by another program or from another
    place, is as good as none and is computed again."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        table = pq.read_table(path, page_checksum_verification=True)
    except (OSError, pa.ArrowException):
        return False
    return (table.schema.metadata or {}).get(_PART) == path.name.encode()
