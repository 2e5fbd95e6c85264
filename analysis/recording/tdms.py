"""TDMS by npTDMS: channels with their own waveform time, or beside a channel of time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lacuna.analysis.recording.channel import (
    Channel,
    Recorded,
    RecordingError,
    as_reals,
    clock_name,
    distinct,
    from_clock,
    from_table,
    left_out,
    on_one_time,
)
from lacuna.analysis.recording.heads import read_head


def read(path: Path) -> Recorded:
    from nptdms import TdmsFile

    try:
        file = TdmsFile.read(path)
    except Exception as error:  # a damaged file may trip its parser anywhere
        raise RecordingError(f"{path}: not a TDMS file that can be read: {error}") from None
    every = [c for group in file.groups() for c in group.channels()]
    found = [c for c in every if len(c) and c.data.dtype.kind in "fiubM"]
    others = [c.name for c in every if all(c is not kept for kept in found)]
    if all("wf_increment" in c.properties for c in found):
        found = [c for c in found if c.data.dtype.kind != "M"]
    if not found:
        raise RecordingError(f"{path}: holds no channels of numbers")
    heads = [read_head(c.name, str(c.properties.get("unit_string", ""))) for c in found]
    if all("wf_increment" in c.properties for c in found):
        names = distinct(heads)
        return Recorded(path, tuple(
            Channel(name, head.unit or "", _waveform_time(path, c), as_reals(path, c.name, c.data), head)
            for name, head, c in zip(names, heads, found, strict=True)
        ), tuple(left_out(others)))  # fmt: skip
    lengths = {c.name: len(c) for c in found}
    if len(set(lengths.values())) > 1:
        raise RecordingError(
            f"{path}: its channels have no waveform time and differ in length: "
            + ", ".join(f"{n} {k}" for n, k in lengths.items())
        )
    names = [c.name for c in found]
    units, columns = [str(c.properties.get("unit_string", "")) for c in found], []
    notes: list[str] = []
    for k, c in enumerate(found):
        if c.data.dtype.kind == "M":
            values, said = from_clock(c.data)
            notes, units[k] = [*notes, *said], "s"
            names[k] = clock_name(c.name, names)
        else:
            values = as_reals(path, c.name, c.data)
        columns.append(values)
    return from_table(path, names, units, np.array(columns), notes, others)


def _waveform_time(path: Path, channel: Any) -> np.ndarray:
    """In s. Raises RecordingError where the waveform's start and increment are no numbers that time can have."""
    start, step = (channel.properties.get(name, 0.0) for name in ("wf_start_offset", "wf_increment"))
    numbers = all(isinstance(n, int | float | np.number) and np.isfinite(n) for n in (start, step))
    if not numbers or step <= 0:
        said = f"wf_start_offset = {start}, wf_increment = {step}"
        raise RecordingError(f"{path}: channel {channel.name} has no waveform time: {said}")
    return float(start) + float(step) * np.arange(len(channel))


def write(recorded: Recorded, path: Path) -> None:
    """One group, with a channel of time in s."""
    from nptdms import ChannelObject, TdmsWriter

    time, columns = on_one_time(recorded.channels)
    rows = [("time", "s", time), *((c.name, c.unit, v) for c, v in zip(recorded.channels, columns, strict=True))]
    with TdmsWriter(path) as file:
        file.write_segment([ChannelObject("recording", n, v, properties={"unit_string": u}) for n, u, v in rows])
