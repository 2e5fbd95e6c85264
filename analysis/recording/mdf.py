"""MDF 3 and 4 by asammdf: each channel with its own time and unit.

A file can hold formulas that its library would evaluate; of conversions only the identity and the linear one are
applied, here, and any other is refused by name.
"""

from __future__ import annotations

from pathlib import Path
import struct
from typing import Any

import numpy as np

from lacuna.analysis.recording.channel import Channel, Recorded, RecordingError, as_reals, distinct, left_out
from lacuna.analysis.recording.heads import read_head

_NONE_OF_VERSION_3 = 65535

_HEADER = 64


def read(path: Path) -> Recorded:
    from asammdf import MDF

    try:
        with MDF(path) as file:
            signals = [
                file.get(group=group, index=index, raw=True)
                for group, content in enumerate(file.groups)
                for index, channel in enumerate(content.channels)
                if index != file.masters_db.get(group)
            ]
    except Exception as error:  # a damaged file may trip its parser anywhere
        raise RecordingError(f"{path}: not an MDF file that can be read: {error}") from None
    whole = signals
    signals = [s for s in whole if len(s.samples) and s.samples.dtype.kind in "fiu" and s.samples.ndim == 1]
    notes = left_out([s.name for s in whole if all(s is not kept for kept in signals)])
    if not signals:
        raise RecordingError(f"{path}: holds no channels of numbers")
    heads = [read_head(s.name, s.unit or "") for s in signals]
    physical = [_physical(path, s) for s in signals]
    bent = [s.name for s, values in zip(signals, physical, strict=True) if values is None]
    if bent:
        said = f"{', '.join(bent)} {'is' if len(bent) == 1 else 'are'} converted by more than a straight line"
        if len(bent) == len(signals):
            raise RecordingError(f"{path}: {said}; export it converted")
        notes.append(f"left out: {said}; export it converted")
    channels = tuple(
        Channel(name, head.unit or "", np.asarray(s.timestamps, float), values, head)
        for name, head, s, values in zip(distinct(heads), heads, signals, physical, strict=True)
        if values is not None
    )
    return Recorded(path, channels, tuple(notes))


def _physical(path: Path, signal: Any) -> np.ndarray | None:
    """Values in the channel's unit; None where they are converted by more than a straight line."""
    raw, conversion = as_reals(path, signal.name, signal.samples), signal.conversion
    if signal.invalidation_bits is not None:
        raw = np.where(np.asarray(signal.invalidation_bits, bool), np.nan, raw)
    kind = None if conversion is None else conversion.conversion_type
    if kind is None or (kind == 0 and not hasattr(conversion, "a")) or kind == _NONE_OF_VERSION_3:
        return raw
    if kind in (0, 1) and hasattr(conversion, "a"):  # linear: 0 in version 3, 1 in version 4
        return conversion.a * raw + conversion.b
    return None


def write(recorded: Recorded, path: Path) -> None:
    """Version 4.10: a group for each channel, which keeps its own time."""
    from asammdf import MDF, Signal

    with MDF(version="4.10") as file:
        for c in recorded.channels:
            file.append([Signal(c.values, c.time, name=c.name, unit=c.unit)])
        file.save(path, overwrite=True)
    _without_dates(path)


def _without_dates(path: Path) -> None:
    """Take out when it was made, so that equal recordings are equal bytes: in the header, which stands at byte 64, and
    in the chain of histories that it points to."""
    content = bytearray(path.read_bytes())
    content[_HEADER + 72 : _HEADER + 80] = bytes(8)
    (history,) = struct.unpack_from("<Q", content, _HEADER + 32)
    while history:
        content[history + 40 : history + 48] = bytes(8)
        (history,) = struct.unpack_from("<Q", content, history + 24)
    path.write_bytes(content)
