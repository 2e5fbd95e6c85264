"""How numbers are written in a text: what separates them, their decimal mark, and what a Real would lose of their
digits, where times are far from zero or whole numbers large."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from itertools import islice, product
from pathlib import Path
import re

import numpy as np

from lacuna.analysis.recording.channel import EXACT, RecordingError, beyond_exact
from lacuna.rows import rows_of

BLANKS = " "  # stands for any number of them
_SEPARATORS = (",", ";", "\t", "|", BLANKS)
SAMPLE = 200  # lines that decide the dialect
NUMBER = {mark: re.compile(rf"[+-]?(\d+[{mark}]?\d*|[{mark}]\d+)([eE][+-]?\d+)?|(?i:nan)|") for mark in ".,"}
_WHOLE = re.compile(r"[+-]?\d+")


@dataclass(frozen=True)
class Dialect:
    separator: str
    decimal: str
    encoding: str


def fields_of(line: str, separator: str) -> list[str]:
    if separator == BLANKS:
        return line.split()
    try:
        return next((row for _, row in rows_of(line, separator)), [])
    except ValueError:
        return [line]  # a quotation without end: no row of numbers


def is_row_of_numbers(fields: list[str], decimal: str) -> bool:
    return len(fields) > 1 and any(fields) and all(NUMBER[decimal].fullmatch(f) for f in fields)


def marks_of(path: Path, lines: list[str], written: list[str]) -> tuple[str, str]:
    """The separator and the decimal mark under which most of the first lines are rows of numbers."""
    best, most = ("", ""), 0
    for decimal in ".,":
        for separator in _SEPARATORS:
            if separator == decimal:
                continue
            rows = sum(is_row_of_numbers(fields_of(line, separator), decimal) for line in islice(lines, SAMPLE))
            if rows > most:
                best, most = (separator, decimal), rows
    if not most:
        raise RecordingError(f"{path}: no row of numbers in its first {SAMPLE} lines{_nearest_to_one(lines, written)}")
    return best


def _nearest_to_one(lines: list[str], written: list[str]) -> str:
    """The line with the most numbers, and what in it is none, as it is written."""
    best, most = "; is it a recording?", 0
    for number, line in enumerate(lines[:SAMPLE], 1):
        for decimal, separator in product(".,", _SEPARATORS):
            fields = fields_of(line, separator) if separator != decimal else []
            strange = [k for k, field in enumerate(fields) if not NUMBER[decimal].fullmatch(field)]
            if strange and len(fields) - len(strange) > most:
                field = (*fields_of(written[number - 1], separator)[strange[0] :], fields[strange[0]])[0]
                best, most = f": in line {number} `{field[:40]}` is none", len(fields) - len(strange)
    return best


def since_first(fields: Sequence[str], decimal: str) -> np.ndarray:
    """What each number is above the first, by all its digits; NaN where there is none."""
    numbers = [Decimal(field.replace(decimal, ".") or "nan") for field in fields]
    return np.array([float(number - numbers[0]) for number in numbers])


def refuse_rounded(path: Path, name: str, values: np.ndarray, fields: Sequence[str]) -> None:
    """Raises RecordingError for a whole number in `fields` that is another one in `values`."""
    for k in np.flatnonzero(np.abs(values) >= EXACT):
        if _WHOLE.fullmatch(fields[k]) and Decimal(fields[k]) != Decimal(float(values[k])):
            raise beyond_exact(path, name)
