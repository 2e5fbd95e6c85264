"""Instants in text, as loggers write them: 2026-11-20T10:00:00.002Z, 20.11.2026 10:00:00,002, or 10:00:00.002 of a day.

A day is written first by years or with dots, day first; with strokes it may be either way round, and stays text.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
import re

import numpy as np

_DAY = r"(?:(?P<year>\d{4})-(?P<month>\d\d)-(?P<day>\d\d)|(?P<d>\d\d?)\.(?P<m>\d\d?)\.(?P<y>\d{4}))[T ]"
_CLOCK = r"(?P<hour>\d\d):(?P<minute>\d\d):(?P<second>\d\d)(?:[%s](?P<fraction>\d{1,9}))?"
_ZONE = r"(?P<zone> ?Z|[+-]\d\d:?\d\d)?"
_BEGIN, _END = r'(?<![^\s,;|"])', r'(?![^\s,;|"])'  # of a field, whatever separates them
_ALONE = r'(?<![^\t,;|"])'  # what stands before a clock and a blank may be a day


def _instant(marks: str) -> re.Pattern[str]:
    return re.compile(f"(?:{_BEGIN}{_DAY}|{_ALONE}){_CLOCK % marks}{_ZONE}{_END}")


_INSTANT = _instant(".")
_WITH_COMMA = _instant(".,")  # where commas separate no fields
_PER_SECOND = 10**9
_DAY_NS = 86_400 * _PER_SECOND


@dataclass(frozen=True)
class Counted:
    """`lines` with each instant as a whole number of ns, which no mark of decimals changes, since that of the last line
    that has one (which is of the table, whatever stands above it); `kinds` says of each line what its instant is."""

    lines: list[str]
    kinds: list[str]  # "" where there is none


def counted(lines: Sequence[str], sample: int) -> Counted:
    """Looks for instants where the first `sample` lines have one. Raises ValueError, with the number of the line, for
    one that does not exist."""
    if not any(_find(line) for line in lines[:sample]):
        return Counted(list(lines), [""] * len(lines))
    found = [_find(line) for line in lines]
    whole = [None if match is None else _nanoseconds(match, number) for number, match in enumerate(found, 1)]
    last = next(ns for ns in reversed(whole) if ns is not None)
    changed = [
        line if match is None or ns is None else f"{line[: match.start()]}{ns - last}{line[match.end() :]}"
        for line, match, ns in zip(lines, found, whole, strict=True)
    ]
    return Counted(changed, [_kind(match) for match in found])


def _kind(match: re.Match[str] | None) -> str:
    if match is None:
        return ""
    day, zone = match["year"] or match["y"], match["zone"]
    return f"{'a day and ' if day else ''}a time{' with its zone' if zone else ''}"


def first_of(line: str) -> str:
    """The instant in a line, as it is written; "" where there is none."""
    match = _find(line)
    return match[0].strip() if match else ""


def since_first(ns: np.ndarray, line: str) -> tuple[np.ndarray, int]:
    """Seconds since the first of the instants `ns`, and how many midnights they pass. Clock times, as in `line`, say no
    day: where one falls back by more than half a day, it is the next day's."""
    match = _find(line)
    if match is None or match["year"] or match["y"]:
        return (ns - ns[0]) / _PER_SECOND, 0
    days = np.cumsum(np.diff(ns, prepend=ns[0]) < -_DAY_NS / 2)
    return (ns - ns[0] + days * _DAY_NS) / _PER_SECOND, int(days[-1])


def _find(line: str) -> re.Match[str] | None:
    return (_WITH_COMMA if re.search(r"[;|\t]", line) else _INSTANT).search(line)


def _nanoseconds(match: re.Match[str], number: int) -> int:
    part = match.groupdict()
    try:
        day = 0
        if part["year"] or part["y"]:
            day = date(*(int(part[a] or part[b]) for a, b in (("year", "y"), ("month", "m"), ("day", "d")))).toordinal()
        hour, minute, second = (int(part[name]) for name in ("hour", "minute", "second"))
        if hour > 23 or minute > 59 or second > 60:
            raise ValueError("no time of a day")
    except ValueError as error:
        raise ValueError(f"{number}: `{match[0]}` is no instant: {error}") from None
    seconds = ((day * 24 + hour) * 60 + minute) * 60 + second - _zone(part["zone"])
    return seconds * _PER_SECOND + int((part["fraction"] or "0").ljust(9, "0"))


def _zone(text: str | None) -> int:
    """Seconds that a zone's clocks are ahead."""
    if not text or text.strip() == "Z":
        return 0
    digits = text[1:].replace(":", "")
    return (-1 if text[0] == "-" else 1) * (int(digits[:2]) * 60 + int(digits[2:])) * 60
