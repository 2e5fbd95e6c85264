"""One recorded signal, whatever file it came from."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.recording.heads import Head, read_head
from lacuna.recorded_units import alike, to_si

MAX_ROUNDING = 1e-6  # of a sample interval, that the digits of an absolute time may cost


class RecordingError(AnalysisError):
    """A file that is no recording, or is damaged; the message says which, where and why."""


EXACT = 2**53  # whole numbers up to which a Real holds every one


def not_rising(time: np.ndarray) -> tuple[int, str] | None:
    """The first of times [n] that is no later than the one before, its place and a sentence; None: there is none."""
    stays = np.flatnonzero(np.diff(time) <= 0)
    if not len(stays):
        return None
    k = int(stays[0])
    return k + 1, f"time does not increase after sample {k + 1} ({time[k]:.6g} s)"


@dataclass(frozen=True)
class Channel:
    """`time` [n] in s, rising; `values` [n] in `unit` ("" where the file says none); NaN where a sample is missing.

    `head` is what the file calls the channel; `name` is that without its unit.
    """

    name: str
    unit: str
    time: np.ndarray
    values: np.ndarray
    head: Head

    def contradicts(self, unit: str) -> bool:
        """Whether the file says, not only by the end of a name, that this is in another unit."""
        return bool(self.unit) and self.head.sure and not alike(self.unit, unit)


@dataclass(frozen=True)
class Recorded:
    """The channels of one file, and what was assumed in reading it. Raises RecordingError where two have one name."""

    path: Path
    channels: tuple[Channel, ...]
    notes: tuple[str, ...] = ()
    time: str = "time"  # what the file calls the column of time

    def __post_init__(self) -> None:
        twice = {name for name, count in Counter(c.head.text for c in self.channels).items() if count > 1}
        if twice:
            names = ", ".join(sorted(twice))
            raise RecordingError(f"{self.path}: {names} occurs more than once; export one group of channels")

    def __getitem__(self, name: str) -> Channel:
        """The channel called `name`, by its whole head or without its unit. Raises KeyError."""
        for key in (lambda c: c.head.text, lambda c: c.name):
            found = [c for c in self.channels if key(c) == name]
            if found:
                return found[0]
        raise KeyError(name)


def from_table(
    path: Path, header: Sequence[str], units: Sequence[str], values: np.ndarray, notes: Sequence[str] = (),
    others: Sequence[str] = (),
) -> Recorded:  # fmt: skip
    """Channels that share one time, from the columns [columns, rows] of a table of which one is time; `others` of its
    columns are left out. Raises RecordingError where none is time, or two columns have one name.
    """
    if not len(header) == len(units) == len(values):
        raise RecordingError(f"{path}: {len(header)} names and {len(units)} units for {len(values)} columns")
    _refuse_namesakes(path, header)
    heads = [read_head(text, unit) for text, unit in zip(header, units, strict=True)]
    k, assumed = time_column(path, heads, values, others)
    time, more = seconds(path, heads[k], values[k])
    for head, column in zip(heads, values, strict=True):
        if np.isinf(column).any():
            raise RecordingError(
                f"{path}: `{head.text}` has a value beyond the largest number, {np.finfo(float).max:.3g}"
            )
    signals = [i for i in range(len(heads)) if i != k]
    if not signals or not len(time):
        raise RecordingError(f"{path}: there is no {'signal beside' if len(time) else 'sample of'} `{heads[k].text}`")
    names = distinct([heads[i] for i in signals])
    channels = tuple(
        Channel(n, heads[i].unit or "", time, values[i], heads[i]) for n, i in zip(names, signals, strict=True)
    )
    return Recorded(path, channels, (*left_out(others), *notes, *assumed, *more), heads[k].text)


def _refuse_namesakes(path: Path, header: Sequence[str]) -> None:
    for k, name in enumerate(header):
        if name in header[:k]:
            raise RecordingError(f"{path}: columns {header.index(name) + 1} and {k + 1} are both called `{name}`")


def time_column(
    path: Path, heads: Sequence[Head], values: np.ndarray, others: Sequence[str] = ()
) -> tuple[int, list[str]]:
    """Which column is time, and what was assumed. Raises RecordingError where none is, or only one of the `others`,
    which are left out."""
    named = [k for k, head in enumerate(heads) if head.is_time]
    if named:
        return named[0], []
    if unread := [name for name in others if read_head(name).is_time]:
        raise RecordingError(f"{path}: `{unread[0]}` holds neither numbers nor dates: write it in seconds")
    rising = [k for k in range(len(heads)) if values.shape[1] > 1 and np.all(np.diff(values[k]) > 0)]
    if not rising:
        raise RecordingError(
            f"{path}: no column is called time and none rises steadily; it has {', '.join(h.text for h in heads)}"
        )
    return rising[0], [f"`{heads[rising[0]].text}` was taken for time: it is the first column that rises steadily"]


def seconds(path: Path, head: Head, values: np.ndarray) -> tuple[np.ndarray, list[str]]:
    """Time in s, and what was assumed. One so far from zero that its digits blur the samples begins at zero instead."""
    notes = [] if head.unit or head.text == "time" else [f"`{head.text}` says no unit; seconds were assumed"]
    factor, si = to_si(head.unit or "s")
    if si != "s":
        raise RecordingError(f"{path}: the unit of the time column `{head.text}` is {head.unit}, which is no time")
    if blurred(values):
        notes.append(begins_at(f"{values[0]:.17g}", head))
        values = values - values[0]
    return (values if factor == 1.0 else values * factor), notes


def blurred(time: np.ndarray) -> bool:
    """Whether it begins so far from zero that its rounding shows in the samples' intervals."""
    if not len(time) or time[0] == 0:
        return False
    interval = float(np.median(np.diff(time))) if len(time) > 1 else 1.0
    return bool(np.spacing(np.nanmax(np.abs(time), initial=0.0)) > MAX_ROUNDING * abs(interval))


def begins_at(first: str, head: Head) -> str:
    """What is said of a time that was blurred."""
    return f"time begins at 0; the file's begins at {first} {head.unit or 's'}"


def from_clock(instants: np.ndarray) -> tuple[np.ndarray, list[str]]:
    """Seconds since the first of datetime64 `instants`, and what was assumed; NaN where one is missing."""
    if not len(instants):
        return np.zeros(0), []
    known = instants[~np.isnat(instants)]
    first = known[0] if len(known) else instants[0]
    return (instants - first) / np.timedelta64(1, "s"), [f"time begins at 0, which is {first}"]


def clock_name(name: str, others: Sequence[str]) -> str:
    """Instants are the time of a recording, whatever they are called, where nothing else is called so."""
    return name if any(read_head(other).is_time for other in (name, *others)) else "time"


def named_columns(path: Path, header: Sequence[str], values: np.ndarray) -> tuple[list[int], list[str]]:
    """The columns with a name, and what is said of others. A column without one may only be empty, as after a separator
    at the ends of lines, or count the rows, as pandas and R write in front of all others."""
    count, notes = np.arange(values.shape[1]), []
    for k, name in enumerate(header):
        if name or not np.isfinite(values[k]).any():
            continue
        if k or not (np.array_equal(values[k], count) or np.array_equal(values[k], count + 1)):
            raise RecordingError(f"{path}: column {k + 1} has no name")
        notes = ["column 1, which has no name and counts the rows, is left out"]
    return [k for k, name in enumerate(header) if name], notes


def left_out(names: Sequence[str]) -> list[str]:
    """What is said of columns that are no channels of a recording."""
    return [f"left out, for they hold no series of numbers: {', '.join(names)}"] if names else []


def distinct(heads: Sequence[Head]) -> list[str]:
    """Names without units; those that then occur twice (I [A], I [mA]) stay as they were written."""
    names = [head.name for head in heads]
    return [head.text if names.count(head.name) > 1 else head.name for head in heads]


def as_reals(path: Path, name: str, values: np.ndarray) -> np.ndarray:
    """The values of a channel as Reals. Raises RecordingError for whole numbers that none of these holds exactly."""
    values = np.asarray(values)
    if values.dtype.kind in "iu" and np.any((values > EXACT) | (values < -EXACT)):
        raise beyond_exact(path, name)
    return values.astype(float)


def beyond_exact(path: Path, name: str) -> RecordingError:
    return RecordingError(f"{path}: {name} holds whole numbers beyond 2^53, which a Real does not hold exactly")


def on_one_time(channels: Sequence[Channel]) -> tuple[np.ndarray, list[np.ndarray]]:
    """All sample times, and each channel's values there; NaN where a channel has no sample at that time. A time at
    which one has two (a step) is there twice."""
    first = channels[0].time
    if all(c.time is first or np.array_equal(c.time, first) for c in channels):
        return first, [c.values for c in channels]
    again = [np.arange(len(c.time)) - np.searchsorted(c.time, c.time) for c in channels]  # samples there before it
    pairs = [np.stack([c.time, n], axis=1) for c, n in zip(channels, again, strict=True)]
    time = np.unique(np.concatenate(pairs), axis=0)[:, 0]
    columns = []
    for channel, before in zip(channels, again, strict=True):
        column = np.full(len(time), np.nan)
        column[np.searchsorted(time, channel.time) + before] = channel.values
        columns.append(column)
    return time, columns


Reader = Callable[[Path], Recorded]
