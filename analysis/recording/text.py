"""Tables of numbers as text, as loggers and spreadsheets write them: separators, decimal commas, encodings, unit rows.

Nothing is guessed where a guess could be wrong: a number is digits with one decimal mark and an exponent, a condition
is true or false, an empty field is a missing sample, and anything else ends with file, line and column.
"""

from __future__ import annotations

import codecs
from collections.abc import Sequence
import csv
from dataclasses import dataclass
import io
from itertools import islice, product
from pathlib import Path
import re

import numpy as np

from lacuna.analysis.recording import instants
from lacuna.analysis.recording.channel import (
    Recorded,
    RecordingError,
    clock_name,
    from_table,
    named_columns,
    on_one_time,
)
from lacuna.analysis.recording.heads import known_unit
from lacuna.rows import rows_of
from lacuna.runtime.errors import SimulationError
from lacuna.runtime.files import read_metadata

_BLANKS = " "  # stands for any number of them
_SEPARATORS = (",", ";", "\t", "|", _BLANKS)
_SAMPLE = 200  # lines that decide the dialect
_NAN = re.compile(r"(?<![A-Za-z])nan(?![A-Za-z])", re.IGNORECASE)
_NUMBER = {mark: re.compile(rf"[+-]?(\d+[{mark}]?\d*|[{mark}]\d+)([eE][+-]?\d+)?|(?i:nan)|") for mark in ".,"}
_CONDITION = re.compile(r'(?<![^,;\t| ])"?\b(true|false)\b"?(?![^,;\t| ])', re.IGNORECASE)
_NO_TEXT = re.compile("[\0-\x08\x0e-\x1f\x7f]")  # control characters, which a terminal would obey
_NO_NAME = re.compile(r"[+-]?([0-9.,]+([eE][+-]?[0-9]+)?|(?i:inf|infinity|nan))")
# A unit as it stands in a row of its own, such as s, rad/s, 1/min, N.m, degC: no blanks, few characters.
_UNIT = re.compile(r"[\[(]?[^\s\[\]()]{0,12}[\])]?")


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
    notes: tuple[str, ...] = ()  # what was left out


def read(path: Path) -> Recorded:
    """The channels of a text table, one of whose columns is time. Raises RecordingError."""
    table = read_text(path)
    units = tuple(own or beside for own, beside in zip(table.units, _units_beside(path, table.header), strict=True))
    above = [f"{table.skipped} lines above the header were passed over"] if table.skipped else []
    return from_table(path, table.header, units, table.values, [*above, *table.notes])


def _units_beside(path: Path, header: Sequence[str]) -> Sequence[str]:
    """Units of columns as the .meta.json of a simulated result says them; "" where there is no such file."""
    try:
        columns = read_metadata(path).get("columns", {})
    except SimulationError as error:
        raise RecordingError(str(error)) from None
    said = (columns.get(name) for name in header)
    return [str(column.get("unit", "")) if isinstance(column, dict) else "" for column in said]


def read_text(path: Path) -> TextTable:
    """The table in a text file. Raises RecordingError, which names file and line."""
    text, encoding = _decoded(path)
    written = text.splitlines()
    instants_of = _instants(path, written)
    lines = _with_conditions(instants_of.lines, text.lower())
    separator, decimal = _marks(path, lines, written)
    first = next(i for i, line in enumerate(lines) if _is_row_of_numbers(_fields(line, separator), decimal))
    above = [_fields(line, separator) for line in written[:first]]
    width = len(_fields(lines[first], separator))
    names = [row for row in above if len(row) == width]
    if not names:
        raise RecordingError(f"{path}:{first + 1}: {_no_header(above, width)}")
    units = names[-1] if len(names) > 1 and _are_units(names[-1], names[-2]) else None
    header = names[-2] if units else names[-1]
    if any(_NO_NAME.fullmatch(name) for name in (*header, *(unit for unit in units or () if unit != "1"))):
        raise RecordingError(f"{path}:{first}: numbers where names of columns or units should be")
    _refuse_numbers_as_units(path, units or [], first)
    skipped, header, units = above.index(header), list(header), list(units or [""] * width)
    _refuse_rows_above(path, written[:first], above, width, skipped)
    values = _numbers(path, lines, first, Dialect(separator, decimal, encoding), width)
    column = _column_of_instants(path, written, instants_of, first, separator)
    begun = _seconds_of_instants(column, written[first], header, units, values)
    kept, notes = named_columns(path, header, values)
    return TextTable(
        path,
        tuple(header[k] for k in kept),
        tuple(units[k].strip("[]()") for k in kept),
        values[kept],
        Dialect(separator, decimal, encoding),
        skipped,
        (*begun, *notes),
    )


def _refuse_numbers_as_units(path: Path, units: list[str], line: int) -> None:
    """1 is a unit and a number: beside what is no unit it makes no row of units, but a row that has a fault."""
    unknown = [unit for unit in units if known_unit(unit.strip("[]()")) is None]
    if "1" in units and unknown:
        raise RecordingError(f"{path}:{line}: no row of units and none of numbers: `{unknown[0]}` is in neither")


def _refuse_rows_above(path: Path, written: list[str], above: list[list[str]], width: int, header: int) -> None:
    """Between the header and the first row of numbers a line with digits may be a row, and would be lost unseen."""
    for number in range(header + 1, len(above)):
        if len(above[number]) != width and re.search(r"\d", written[number]):
            fault = f"{len(above[number])} fields where the header has {width}"
            raise RecordingError(f"{path}:{number + 1}: {fault}: a row of numbers, or a line to take out?")


def _instants(path: Path, lines: list[str]) -> instants.Counted:
    try:
        return instants.counted(lines, _SAMPLE)
    except ValueError as error:
        raise RecordingError(f"{path}:{error}") from None


def _column_of_instants(
    path: Path, written: list[str], found: instants.Counted, first: int, separator: str
) -> int | None:
    """The column that holds instants, in every row or nowhere, and of one kind: a number of seconds among them, or one
    of them among numbers, would be read as something else."""
    if not any(found.kinds[first:]):
        return None
    fields = zip(_fields(written[first], separator), _fields(found.lines[first], separator), strict=False)
    column = next((k for k, (one, other) in enumerate(fields) if one != other), None)
    for row in range(first, len(written)):
        if written[row].strip() and found.kinds[row] != found.kinds[first]:
            here, there = found.kinds[row] or "no instant", found.kinds[first] or "no instant"
            raise RecordingError(f"{path}:{row + 1}: {here}, where the first row, line {first + 1}, has {there}")
    for row in range(first, len(written)) if column is not None else ():
        one, other = (_fields(lines[row], separator) for lines in (written, found.lines))
        if one[column : column + 1] == other[column : column + 1] != []:
            raise RecordingError(f"{path}:{row + 1}: its instant is not in column {column + 1}, as in the first row")
    return column


def _seconds_of_instants(
    column: int | None, written: str, header: list[str], units: list[str], values: np.ndarray
) -> list[str]:
    """Make a column of instants one of seconds since its own first; and say so."""
    if column is None:
        return []
    header[column], units[column] = clock_name(header[column], header), "s"
    values[column], midnights = instants.since_first(values[column], written)
    passed = (
        [f"clock times fall back {midnights} times by more than half a day: taken for midnight"] if midnights else []
    )
    return [f"time begins at 0, which is {instants.first_of(written)}", *passed]


def _no_header(above: list[list[str]], width: int) -> str:
    if above and len(above[-1]) > 1:
        return f"{len(above[-1])} columns in the header, {width} in the rows"
    return "numbers without a header line; write the names of the columns above them"


def _decoded(path: Path) -> tuple[str, str]:
    raw = path.read_bytes()
    marks = ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16"))
    encoding = next((name for mark, name in marks if raw.startswith(mark)), "utf-8")
    try:
        text = raw.decode(encoding)
    except UnicodeDecodeError:
        encoding = "cp1252"  # of loggers that know no Unicode; it only matters for names and units
        text = raw.decode(encoding, errors="replace")
    if _NO_TEXT.search(text):
        raise RecordingError(f"{path}: holds bytes that are no text")
    return text, encoding


def _with_conditions(lines: list[str], text: str) -> list[str]:
    """Rows with 1 and 0 where conditions are written as true and false, if any are in the `text`, in small letters."""
    if "true" not in text and "false" not in text:
        return lines
    return [_CONDITION.sub(lambda f: "01"[f[1][0] in "tT"], s) if any(map(str.isdigit, s)) else s for s in lines]


def _fields(line: str, separator: str) -> list[str]:
    if separator == _BLANKS:
        return line.split()
    try:
        return next((row for _, row in rows_of(line, separator)), [])
    except ValueError:
        return [line]  # a quotation without end: no row of numbers


def _is_row_of_numbers(fields: list[str], decimal: str) -> bool:
    return len(fields) > 1 and any(fields) and all(_NUMBER[decimal].fullmatch(f) for f in fields)


def _marks(path: Path, lines: list[str], written: list[str]) -> tuple[str, str]:
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
        raise RecordingError(f"{path}: no row of numbers in its first {_SAMPLE} lines{_nearest_to_one(lines, written)}")
    return best


def _nearest_to_one(lines: list[str], written: list[str]) -> str:
    """The line with the most numbers, and what in it is none, as it is written."""
    best, most = "; is it a recording?", 0
    for number, line in enumerate(lines[:_SAMPLE], 1):
        for decimal, separator in product(".,", _SEPARATORS):
            fields = _fields(line, separator) if separator != decimal else []
            strange = [k for k, field in enumerate(fields) if not _NUMBER[decimal].fullmatch(field)]
            if strange and len(fields) - len(strange) > most:
                field = (*_fields(written[number - 1], separator)[strange[0] :], fields[strange[0]])[0]
                best, most = f": in line {number} `{field[:40]}` is none", len(fields) - len(strange)
    return best


def _are_units(row: list[str], above: list[str]) -> bool:
    named = all(name for name, cell in zip(above, row, strict=True) if cell)
    return named and any(row) and all(_UNIT.fullmatch(cell) for cell in row) and row != above


def _numbers(path: Path, lines: list[str], first: int, dialect: Dialect, width: int) -> np.ndarray:
    """[columns, rows] of all lines from `first` on; empty fields become NaN."""
    mark = re.escape(dialect.separator)
    try:
        body = [_unquoted(line, dialect, width) for line in lines[first:] if line.strip()]
        plain = "\n".join(body)
        if dialect.separator != _BLANKS:
            plain = re.sub(rf"(^|{mark})[ ]*(?={mark}|$)", r"\1nan", plain, flags=re.MULTILINE)
        if re.search(rf"[^0-9eE+\-{dialect.decimal} \n{mark}]", _NAN.sub("", plain)):
            raise ValueError
        plain = plain.replace(dialect.decimal, ".")
        separator = None if dialect.separator == _BLANKS else dialect.separator
        return np.loadtxt(io.StringIO(plain), delimiter=separator, ndmin=2).T
    except ValueError:
        raise _first_fault(path, lines, first, dialect, width) from None


def _unquoted(line: str, dialect: Dialect, width: int) -> str:
    """A line without quotation marks. Raises ValueError where what they hold is not numbers, one in each column."""
    if '"' not in line:
        return line
    fields = _fields(line, dialect.separator)
    if len(fields) != width or not all(_NUMBER[dialect.decimal].fullmatch(field) for field in fields):
        raise ValueError
    return dialect.separator.join(fields)


def _first_fault(path: Path, lines: list[str], first: int, dialect: Dialect, width: int) -> RecordingError:
    """What is wrong in the first line that is no row of numbers."""
    for number, line in enumerate(lines[first:], first + 1):
        fields = _fields(line, dialect.separator)
        if not line.strip():
            continue
        if len(fields) != width:
            return RecordingError(f"{path}:{number}: {len(fields)} fields where the first row has {width}")
        for column, field in enumerate(fields, 1):
            if not _NUMBER[dialect.decimal].fullmatch(field):
                return RecordingError(f"{path}:{number}: field {column}, `{field[:40]}`, is no number")
    return RecordingError(f"{path}: its rows are no table of numbers")


def write(recorded: Recorded, path: Path) -> None:
    """A CSV with `time` in s first and each unit in brackets; numbers read back as they are, missing ones are empty."""
    time, columns = on_one_time(recorded.channels)
    heads = ["time [s]", *(f"{c.name} [{c.unit}]" if c.unit else c.name for c in recorded.channels)]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heads)
        for row in zip(time.tolist(), *(column.tolist() for column in columns), strict=True):
            writer.writerow(["" if value != value else repr(value) for value in row])
