"""Parquet by pyarrow: one column a signal, its unit in the field's metadata (key `unit`)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lacuna.analysis.recording.channel import Recorded, RecordingError, from_table, on_one_time


def read(path: Path) -> Recorded:
    import pyarrow
    from pyarrow import parquet

    try:
        table = parquet.read_table(path)
        fields = [f for f in table.schema if pyarrow.types.is_floating(f.type) or pyarrow.types.is_integer(f.type)]
        names = [f.name for f in fields]
    except (pyarrow.ArrowException, OSError, UnicodeDecodeError) as error:
        raise RecordingError(f"{path}: not a Parquet file that can be read: {error}") from None
    if not fields:
        raise RecordingError(f"{path}: none of its columns holds numbers")
    units = [(f.metadata or {}).get(b"unit", b"").decode("utf-8", "replace") for f in fields]
    values = np.array([table.column(name).cast("float64").to_numpy() for name in names])
    return from_table(path, names, units, values)


def write(recorded: Recorded, path: Path) -> None:
    """`time` in s and a column a channel, each with its unit in the metadata."""
    import pyarrow
    from pyarrow import parquet

    time, columns = on_one_time(recorded.channels)
    units = ["s", *(c.unit for c in recorded.channels)]
    names = ["time", *(c.name for c in recorded.channels)]
    fields = [pyarrow.field(n, pyarrow.float64(), metadata={"unit": u}) for n, u in zip(names, units, strict=True)]
    parquet.write_table(pyarrow.table([time, *columns], schema=pyarrow.schema(fields)), path)
