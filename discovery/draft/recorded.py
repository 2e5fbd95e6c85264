"""Files as loggers wrote them, as recordings of a case: time in seconds first, one column a signal, in its own unit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from lacuna.analysis.recording.heads import Head, read_head
from lacuna.analysis.recording.text import TextTable, read_text
from lacuna.discovery.cases import CaseError
from lacuna.recorded_units import to_si

MAX_ROUNDING = 1e-6  # of a sample interval, that the digits of an absolute time may cost
FIT_SHARE = (
    0.7  # of a single recording, the rest of which judges: as cross-validation's usual two thirds, in whole tenths
)


@dataclass(frozen=True)
class Recorded:
    """One file: `time` (n,) s, `columns` (n,) each in the unit of its head; notes say what was done or assumed."""

    name: str
    time: np.ndarray
    heads: tuple[Head, ...]
    columns: tuple[np.ndarray, ...]
    notes: tuple[str, ...] = ()


def read_recorded(path: Path) -> Recorded:
    """Raises TextTableError for what is no table, CaseError where no column can be time."""
    table = read_text(path)
    heads = [read_head(text, unit) for text, unit in zip(table.header, table.units, strict=True)]
    k, notes = _time_column(path, heads, table)
    time, more = _seconds(heads[k], table.values[k])
    others = [i for i in range(len(heads)) if i != k]
    if table.skipped:
        notes.append(f"{table.skipped} lines above the header were passed over")
    return Recorded(
        path.with_suffix(".csv").name,
        time,
        tuple(_unique([heads[i] for i in others])),
        tuple(table.values[i] for i in others),
        (*notes, *more),
    )


def _time_column(path: Path, heads: Sequence[Head], table: TextTable) -> tuple[int, list[str]]:
    named = [k for k, head in enumerate(heads) if head.is_time]
    if named:
        return named[0], []
    rising = [k for k in range(len(heads)) if np.all(np.diff(table.values[k]) > 0)]
    if not rising:
        raise CaseError(f"{path}: no column is called time and none rises steadily; it has {', '.join(table.header)}")
    return rising[0], [f"`{heads[rising[0]].text}` was taken for time: it is the first column that rises steadily"]


def _seconds(head: Head, values: np.ndarray) -> tuple[np.ndarray, list[str]]:
    """Time in s. One so far from zero that its digits would blur the sample times begins at zero instead."""
    notes = [] if head.unit else [f"`{head.text}` says no unit; seconds were assumed"]
    factor, si = to_si(head.unit or "s")
    if si != "s":
        raise CaseError(f"the unit of the time column `{head.text}` is {head.unit}, which is no time")
    interval = float(np.median(np.diff(values))) if len(values) > 1 else 1.0
    if np.spacing(np.nanmax(np.abs(values), initial=0.0)) > MAX_ROUNDING * abs(interval):
        notes.append(f"time begins at 0; the file's begins at {values[0]:.17g} {head.unit or 's'}")
        values = values - values[0]
    return (values if factor == 1.0 else values * factor), notes


def _unique(heads: list[Head]) -> list[Head]:
    """Names that occur twice once their units are taken off (I [A], I [mA]) stay as they were written."""
    names = [head.name for head in heads]
    return [replace(head, name=head.text) if names.count(head.name) > 1 else head for head in heads]


def parted(recorded: Recorded) -> tuple[Recorded, Recorded]:
    """A single recording in two stretches: the first to fit, the second to judge."""
    cut = int(FIT_SHARE * len(recorded.time))
    stem = Path(recorded.name).stem

    def stretch(part: slice, suffix: str) -> Recorded:
        columns = tuple(column[part] for column in recorded.columns)
        return replace(recorded, name=f"{stem}_{suffix}.csv", time=recorded.time[part], columns=columns)

    return stretch(slice(None, cut), "fit"), stretch(slice(cut, None), "validate")


def write_recorded(recorded: Recorded, kept: Sequence[int], path: Path) -> None:
    """The columns `kept`, with the digits that they came with: the shortest text that reads back the same."""
    names = ["time", *(recorded.heads[k].name for k in kept)]
    columns = [recorded.time, *(recorded.columns[k] for k in kept)]
    with path.open("w", encoding="utf-8") as file:
        file.write(",".join(f'"{n}"' if "," in n or '"' in n else n for n in names) + "\n")
        for row in zip(*(column.tolist() for column in columns), strict=True):
            file.write(",".join("" if value != value else repr(value) for value in row) + "\n")
