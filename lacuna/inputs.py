"""What drives the inputs of a model: constants, samples, columns of recordings."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from lacuna.errors import UserError, nearest
from lacuna.runtime import RecordedInput, read_csv

Input = float | RecordedInput | tuple[Any, Any]
"""A constant, a recording, or a pair (times in s, values): linear between samples, the first and last hold outside."""


def recorded(file: str | Path, column: str, *, hold: bool = False) -> RecordedInput:
    """A column of a CSV recording (`time` first, SI units) as an input; linear between samples, or held with `hold`.

    Raises UserError with the nearest names where there is no such column.
    """
    columns, _ = read_csv(file)
    if column not in columns:
        raise UserError(f"{file} has no column called {column}{nearest(column, columns)}")
    return RecordedInput(columns["time"], columns[column], "hold" if hold else "linear")


def as_inputs(given: Mapping[str, Input]) -> dict[str, RecordedInput | float]:
    """In the form that the runtime takes."""
    return {name: _one(value) for name, value in given.items()}


def _one(value: Input) -> RecordedInput | float:
    if isinstance(value, tuple):
        times, values = value
        return RecordedInput(np.asarray(times, dtype=float), np.asarray(values, dtype=float))
    return value if isinstance(value, RecordedInput) else float(value)
