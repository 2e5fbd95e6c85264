"""Files as loggers wrote them, as recordings of a case: time in seconds first, one column a signal, in its own unit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from lacuna.analysis.recording.channel import on_one_time
from lacuna.analysis.recording.formats import read_recorded
from lacuna.analysis.recording.heads import Head

FIT_SHARE = (
    0.7  # of a single recording, the rest of which judges: as cross-validation's usual two thirds, in whole tenths
)


@dataclass(frozen=True)
class Recording:
    """One file: `time` (n,) s, `columns` (n,) each in the unit of its head; notes say what was done or assumed."""

    name: str
    time: np.ndarray
    heads: tuple[Head, ...]
    columns: tuple[np.ndarray, ...]
    notes: tuple[str, ...] = ()


def read_recording(path: Path) -> Recording:
    """Raises RecordingError for what is no recording. Channels of other rates get empty cells between their samples."""
    recorded = read_recorded(path)
    time, columns = on_one_time(recorded.channels)
    heads = tuple(replace(c.head, name=c.name) for c in recorded.channels)
    return Recording(path.with_suffix(".csv").name, time, heads, tuple(columns), recorded.notes)


def parted(recorded: Recording) -> tuple[Recording, Recording]:
    """A single recording in two stretches: the first to fit, the second to judge."""
    cut = int(FIT_SHARE * len(recorded.time))
    stem = Path(recorded.name).stem

    def stretch(part: slice, suffix: str) -> Recording:
        columns = tuple(column[part] for column in recorded.columns)
        return replace(recorded, name=f"{stem}_{suffix}.csv", time=recorded.time[part], columns=columns)

    return stretch(slice(None, cut), "fit"), stretch(slice(cut, None), "validate")


def write_recorded(recorded: Recording, kept: Sequence[int], path: Path) -> None:
    """The columns `kept`, with the digits that they came with: the shortest text that reads back the same."""
    names = ["time", *(recorded.heads[k].name for k in kept)]
    columns = [recorded.time, *(recorded.columns[k] for k in kept)]
    with path.open("w", encoding="utf-8") as file:
        file.write(",".join(f'"{n}"' if "," in n or '"' in n else n for n in names) + "\n")
        for row in zip(*(column.tolist() for column in columns), strict=True):
            file.write(",".join("" if value != value else repr(value) for value in row) + "\n")
