"""Parquet by pyarrow: one column a signal, its unit in the field's metadata (key `unit`)."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from lacuna.analysis.recording.channel import (
    Recorded,
    RecordingError,
    as_reals,
    clock_name,
    from_clock,
    from_table,
    on_one_time,
)


def read(path: Path) -> Recorded:
    import pyarrow
    from pyarrow import parquet

    try:
        table = parquet.read_table(path)
        fields = [f for f in table.schema if any(is_kind(f.type) for is_kind in _kinds(pyarrow.types))]
        others = [f.name for f in table.schema if f not in fields]
        names = [f.name for f in fields]
    except (pyarrow.ArrowException, OSError, UnicodeDecodeError) as error:
        raise RecordingError(f"{path}: not a Parquet file that can be read: {error}") from None
    if not fields:
        raise RecordingError(f"{path}: none of its columns holds numbers")
    units = [(f.metadata or {}).get(b"unit", b"").decode("utf-8", "replace") for f in fields]
    columns, notes = [], []
    for k, field in enumerate(fields):
        column = table.column(field.name)
        if pyarrow.types.is_timestamp(field.type):
            values, said = from_clock(column.cast(pyarrow.timestamp("ns")).to_numpy())
            notes, units[k] = [*notes, *said], "s"
            names[k] = clock_name(names[k], names)
        elif pyarrow.types.is_duration(field.type):
            values, units[k] = column.cast(pyarrow.duration("ns")).to_numpy() / np.timedelta64(1, "s"), "s"
        else:
            numbers = column.cast("uint8") if pyarrow.types.is_boolean(field.type) else column
            try:
                values = numbers.cast("float64").to_numpy()
            except pyarrow.ArrowInvalid:  # an integer beyond 2^53
                values = as_reals(path, field.name, numbers.drop_null().to_numpy())
        columns.append(values)
    return from_table(path, names, units, np.array(columns), notes, others)


def _kinds(types: Any) -> tuple[Callable[[Any], bool], ...]:
    """Of numbers, of truth values (0 and 1), of instants, and of durations."""
    return types.is_floating, types.is_integer, types.is_boolean, types.is_timestamp, types.is_duration


def write(recorded: Recorded, path: Path) -> None:
    """`time` in s and a column a channel, each with its unit in the metadata."""
    import pyarrow
    from pyarrow import parquet

    time, columns = on_one_time(recorded.channels)
    units = ["s", *(c.unit for c in recorded.channels)]
    names = ["time", *(c.name for c in recorded.channels)]
    fields = [pyarrow.field(n, pyarrow.float64(), metadata={"unit": u}) for n, u in zip(names, units, strict=True)]
    parquet.write_table(pyarrow.table([time, *columns], schema=pyarrow.schema(fields)), path)
