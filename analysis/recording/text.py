"""Tables of numbers as text, as loggers and spreadsheets write them: separators, decimal commas, encodings, unit rows.

Nothing is guessed where a guess could be wrong: a number is digits with one decimal mark and an exponent, an empty
field is a missing sample, and anything else ends with file, line and column.
"""

from __future__ import annotations

import codecs
import csv
from dataclasses import dataclass
import io
from itertools import islice
from pathlib import Path
import re

import numpy as np

from lacuna.analysis.errors import AnalysisError

LARGEST = 1 << 30  # bytes of a file: a hundred signals for a quarter of an hour at 1 kHz
_SEPARATORS = (",", ";", "\t", "|")
_SAMPLE = 200  # lines that decide the dialect
_NAN = re.compile(r"(?<![A-Za-z])nan(?![A-Za-z])", re.IGNORECASE)
_NUMBER = {mark: re.compile(rf"[+-]?(\d+[{mark}]?\d*|[{mark}]\d+)([eE][+-]?\d+)?|(?i:nan)|") for mark in ".,"}
# A unit as it stands in a row of its own, such as s, rad/s, 1/min, N.m, degC: no blanks, few characters.
_UNIT = re.compile(r"[\[(]?[^\s\[\]()]{0,12}[\])]?")


class TextTableError(AnalysisError):
    """Not a table of numbers; the message says where and why."""


@dataclass(frozen=True)
class Dialect:
    separator: str
    decimal: str
    encoding: str


@dataclass(frozen=True)
class TextTable:
    """`header` and `units` [columns] as written, "" where no row of units stands below the header.

    `values` [columns, rows]; NaN where a sample is missing.
    """

    path: Path
    header: tuple[str, ...]
    units: tuple[str, ...]
    values: np.ndarray
    dialect: Dialect
    skipped: int  # lines before the header


def read_text(path: Path) -> TextTable:
    """The table in a text file. Raises TextTableError, which names file and line."""
    text, encoding = _decoded(path)
    lines = text.splitlines()
    separator, decimal = _marks(path, lines)
    first = _first_row_of_numbers(lines, separator, decimal)
    above = [_fields(line, separator) for line in lines[:first]]
    width = len(_fields(lines[first], separator))
    names = [row for row in above if len(row) == width]
    if not names:
        raise TextTableError(
            f"{path}:{first + 1}: numbers without a header line; write the names of the columns above them"
        )
    units = names[-1] if len(names) > 1 and _are_units(names[-1], names[-2]) else None
    header = names[-2] if units else names[-1]
    values = _numbers(path, lines, first, Dialect(separator, decimal, encoding), width)
    kept = _named_columns(path, header, values)
    return TextTable(
        path,
        tuple(header[k] for k in kept),
        tuple((units[k].strip("[]()") if units else "") for k in kept),
        values[kept],
        Dialect(separator, decimal, encoding),
        above.index(header),
    )


def _decoded(path: Path) -> tuple[str, str]:
    if not path.is_file():
        raise TextTableError(f"{path}: {'is not a file' if path.exists() else 'there is no such file'}")
    if path.stat().st_size > LARGEST:
        raise TextTableError(f"{path}: larger than {LARGEST >> 20} MB")
    raw = path.read_bytes()
    marks = ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16"))
    encoding = next((name for mark, name in marks if raw.startswith(mark)), "utf-8")
    try:
        text = raw.decode(encoding)
    except UnicodeDecodeError:
        encoding = "cp1252"  # of loggers that know no Unicode; it only matters for names and units
        text = raw.decode(encoding, errors="replace")
    if "\0" in text:
        raise TextTableError(f"{path}: holds bytes that are no text")
    return text, encoding


def _fields(line: str, separator: str) -> list[str]:
    return [field.strip() for field in next(csv.reader([line], delimiter=separator), [])]


def _is_row_of_numbers(fields: list[str], decimal: str) -> bool:
    return len(fields) > 1 and any(fields) and all(_NUMBER[decimal].fullmatch(f) for f in fields)


def _marks(path: Path, lines: list[str]) -> tuple[str, str]:
    """The separator and the decimal mark under which most of the first lines are rows of numbers."""
    best, most = ("", ""), 0
    for decimal in ".,":
        for separator in _SEPARATORS:
            if separator == decimal:
                continue
            rows = sum(_is_row_of_numbers(_fields(line, separator), decimal) for line in islice(lines, _SAMPLE))
            if rows > most:
                best, most = (separator, decimal), rows
    if not most:
        raise TextTableError(f"{path}: no row of numbers in its first {_SAMPLE} lines; is it a recording?")
    return best


def _first_row_of_numbers(lines: list[str], separator: str, decimal: str) -> int:
    return next(i for i, line in enumerate(lines) if _is_row_of_numbers(_fields(line, separator), decimal))


def _are_units(row: list[str], above: list[str]) -> bool:
    named = all(name for name, cell in zip(above, row, strict=True) if cell)
    return named and any(row) and all(_UNIT.fullmatch(cell) for cell in row) and row != above


def _numbers(path: Path, lines: list[str], first: int, dialect: Dialect, width: int) -> np.ndarray:
    """[columns, rows] of all lines from `first` on; empty fields become NaN."""
    mark = re.escape(dialect.separator)
    body = "\n".join(line for line in lines[first:] if line.strip())
    plain = body.replace('"', "")
    plain = re.sub(rf"(^|{mark})[ ]*(?={mark}|$)", r"\1nan", plain, flags=re.MULTILINE)
    if dialect.decimal == ",":
        plain = plain.replace(",", ".")
    strange = re.search(rf"[^0-9eE+\-. \n{mark}]", _NAN.sub("", plain))
    try:
        if strange:
            raise ValueError
        return np.loadtxt(io.StringIO(plain), delimiter=dialect.separator, ndmin=2).T
    except ValueError:
        raise _first_fault(path, lines, first, dialect, width) from None


def _first_fault(path: Path, lines: list[str], first: int, dialect: Dialect, width: int) -> TextTableError:
    """What is wrong in the first line that is no row of numbers."""
    for number, line in enumerate(lines[first:], first + 1):
        fields = _fields(line, dialect.separator)
        if not line.strip():
            continue
        if len(fields) != width:
            return TextTableError(f"{path}:{number}: {len(fields)} fields where the first row has {width}")
        for column, field in enumerate(fields, 1):
            if not _NUMBER[dialect.decimal].fullmatch(field):
                return TextTableError(f"{path}:{number}: field {column}, `{field[:40]}`, is no number")
    return TextTableError(f"{path}: its rows are no table of numbers")


def _named_columns(path: Path, header: list[str], values: np.ndarray) -> list[int]:
    """The columns with a name. A column without one may only be empty, as after a separator at the ends of lines."""
    for k, name in enumerate(header):
        if not name and np.isfinite(values[k]).any():
            raise TextTableError(f"{path}: column {k + 1} has no name")
        if name and name in header[:k]:
            raise TextTableError(f"{path}: columns {header.index(name) + 1} and {k + 1} are both called `{name}`")
    return [k for k, name in enumerate(header) if name]
