"""What drives the inputs of a model: constants, samples, columns of recordings."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from lacuna.analysis.recording.formats import read_recorded
from lacuna.errors import UserError, nearest
from lacuna.recorded_units import to_si
from lacuna.runtime import RecordedInput

Input = float | RecordedInput | tuple[Any, Any]
"""A constant, a recording, or a pair (times in s, values): linear between samples, the first and last hold outside."""


def recorded(file: str | Path, column: str, *, hold: bool = False) -> RecordedInput:
    """A channel of a recording, in any format that is read, as an input; linear between samples, or held with `hold`.

    Values are converted to SI where the file says a unit. Raises UserError with the nearest names where there is none
    of this name.
    """
    found = read_recorded(file)
    try:
        channel = found[column]
    except KeyError:
        names = [c.name for c in found.channels]
        raise UserError(f"{file} has no column called {column}{nearest(column, names)}") from None
    present = np.isfinite(channel.values)
    values = channel.values[present] * to_si(channel.unit or "1")[0]
    return RecordedInput(channel.time[present], values, "hold" if hold else "linear")


def as_inputs(given: Mapping[str, Input]) -> dict[str, RecordedInput | float]:
    """In the form that the runtime takes."""
    return {name: _one(value) for name, value in given.items()}


def _one(value: Input) -> RecordedInput | float:
    if isinstance(value, tuple):
        times, values = value
        return RecordedInput(np.asarray(times, dtype=float), np.asarray(values, dtype=float))
    return value if isinstance(value, RecordedInput) else float(value)
