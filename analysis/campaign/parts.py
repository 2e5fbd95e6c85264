"""The parts of a campaign on disk: one Parquet file a chunk, named by what decides its content."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from lacuna.analysis.campaign.points import Points
from lacuna.analysis.campaign.work import Work
from lacuna.analysis.files import has_part, read_part, write_part
from lacuna.written import whole_file


class Parts:
    """Chunk k is in `parts/<k>-<hash>.parquet`, complete or not there. A changed model, setting or point changes the
    hash, so nothing stale is ever read."""

    def __init__(self, folder: Path, work: Work, pieces: list[Points]):
        self._folder = folder / "parts"
        self._folder.mkdir(parents=True, exist_ok=True)
        self.paths = [self._folder / f"{k:06d}-{_hash(work, piece)}.parquet" for k, piece in enumerate(pieces)]

    def missing(self) -> list[int]:
        return [k for k, path in enumerate(self.paths) if not has_part(path)]

    def write(self, k: int, table: pa.Table) -> None:
        write_part(self.paths[k], table)

    def combine(self, path: Path) -> None:
        """All parts in order as one file, one row group a part: memory holds one part at a time."""
        with whole_file(path) as partial, pq.ParquetWriter(partial, _schema(self.paths[0])) as writer:
            for part in self.paths:
                writer.write_table(read_part(part))


def _schema(part: Path) -> pa.Schema:
    return pq.read_schema(part).remove_metadata()


def _hash(work: Work, piece: Points) -> str:
    digest = hashlib.sha256(work.key.encode())
    for name, values in piece.items():
        digest.update(name.encode() + b"\0" + values.tobytes())
    return digest.hexdigest()[:20]
