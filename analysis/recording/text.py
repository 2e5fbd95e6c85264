"""Tables of numbers as text, as loggers and spreadsheets write them: separators, decimal commas, encodings, unit rows.

Nothing is guessed where a guess could be wrong: a number is digits with one decimal mark and an exponent, a condition
is true or false, an empty field is a missing sample, and anything else ends with file, line and column.
"""

from __future__ import annotations

import codecs
from collections.abc import Callable, Sequence
import csv
from dataclasses import dataclass
import io
from pathlib import Path
import re

import numpy as np

from lacuna.analysis.recording import instants
from lacuna.analysis.recording.channel import (
    EXACT,
    Recorded,
    RecordingError,
    begins_at,
    blurred,
    clock_name,
    from_table,
    named_columns,
    on_one_time,
    time_column,
)
from lacuna.analysis.recording.heads import known_unit, read_head
from lacuna.analysis.recording.numerals import (
    BLANKS,
    NUMBER,
    SAMPLE,
    Dialect,
    fields_of,
    is_row_of_numbers,
    marks_of,
    refuse_rounded,
    since_first,
)
from lacuna.runtime.errors import SimulationError
from lacuna.runtime.files import read_metadata

_NAN = re.compile(r"(?<![A-Za-z])nan(?![A-Za-z])", re.IGNORECASE)
_CONDITION = re.compile(r'(?<![^,;\t| ])"?\b(true|false)\b"?(?![^,;\t| ])', re.IGNORECASE)
_NO_TEXT = re.compile("[\0-\x08\x0e-\x1f\x7f]")  # control characters, which a terminal would obey
_NO_NAME = re.compile(r"[+-]?([0-9.,]+([eE][+-]?[0-9]+)?|(?i:inf|infinity|nan))")
# A unit as it stands in a row of its own, such as s, rad/s, 1/min, N.m, degC: no blanks, few characters.
_UNIT = re.compile(r"[\[(]?[^\s\[\]()]{0,12}[\])]?")


@dataclass(frozen=True)
class TextTable:
    """`header` and `units` [columns] as written, "" where no row of units stands below the header.

    `values` [columns, rows]; NaN where a sample is missing. `fields` gives those of a column as they are written.
    """

    path: Path
    header: tuple[str, ...]
    units: tuple[str, ...]
    values: np.ndarray
    dialect: Dialect
    skipped: int  # lines before the header
    fields: Callable[[int], list[str]]
    notes: tuple[str, ...] = ()  # what was left out


def read(path: Path) -> Recorded:
    """The channels of a text table, one of whose columns is time. Raises RecordingError."""
    table = read_text(path)
    units = tuple(own or beside for own, beside in zip(table.units, _units_beside(path, table.header), strict=True))
    above = [f"{table.skipped} lines above the header were passed over"] if table.skipped else []
    begun = _keep_digits(table, units)
    return from_table(path, table.header, units, table.values, [*above, *table.notes, *begun])


def _keep_digits(table: TextTable, units: Sequence[str]) -> list[str]:
    """Let a time whose digits would blur its samples begin at 0, and say so. Raises RecordingError where a whole number
    in another column is lost."""
    heads = [read_head(name, unit) for name, unit in zip(table.header, units, strict=True)]
    clock, notes = time_column(table.path, heads, table.values)[0], []
    if blurred(table.values[clock]):
        fields = table.fields(clock)
        table.values[clock] = since_first(fields, table.dialect.decimal)
        notes = [begins_at(fields[0], heads[clock])]
    for k in np.flatnonzero((np.abs(table.values) >= EXACT).any(axis=1)):
        refuse_rounded(table.path, table.header[k], table.values[k], table.fields(k))
    return notes


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
    separator, decimal = marks_of(path, lines, written)
    first = next(i for i, line in enumerate(lines) if is_row_of_numbers(fields_of(line, separator), decimal))
    above = [fields_of(line, separator) for line in written[:first]]
    width = len(fields_of(lines[first], separator))
    header, units = _names_and_units(path, above, width, decimal)
    _refuse_numbers_as_units(path, units or [], first)
    skipped, header, units = above.index(header), list(header), list(units or [""] * width)
    _refuse_rows_above(path, written[:first], above, width, skipped)
    values = _numbers(path, lines, first, Dialect(separator, decimal, encoding), width)
    column = _column_of_instants(path, written, instants_of, first, separator)
    begun = _seconds_of_instants(column, written[first], header, units, values)
    kept, notes = named_columns(path, header, values)

    def fields(k: int) -> list[str]:
        return [fields_of(line, separator)[kept[k]] for line in lines[first:] if line.strip()]

    return TextTable(
        path,
        tuple(header[k] for k in kept),
        tuple(units[k].strip("[]()") for k in kept),
        values[kept],
        Dialect(separator, decimal, encoding),
        skipped,
        fields,
        (*begun, *notes),
    )


def _names_and_units(
    path: Path, above: list[list[str]], width: int, decimal: str
) -> tuple[list[str], list[str] | None]:
    """The rows of them `above` the first row of numbers; None where there is none of units."""
    lines = [number for number, row in enumerate(above, 1) if len(row) == width]
    if not lines:
        raise RecordingError(f"{path}:{len(above) + 1}: {_no_header(above, width)}")
    names = [above[number - 1] for number in lines]
    units = names[-1] if len(names) > 1 and _are_units(names[-1], names[-2]) else None
    for number, row in list(zip(lines, names, strict=True))[-2 if units else -1 :]:
        cells = [cell for cell in row if cell != "1" or row is not units]
        if numbers := [cell for cell in cells if _NO_NAME.fullmatch(cell)]:
            others = [cell[:40] for cell in row if not NUMBER[decimal].fullmatch(cell)]
            said = (
                f"`{others[0]}` is no number, but `{numbers[0]}` beside it is one" if others else "no names of columns"
            )
            raise RecordingError(f"{path}:{number}: {said}")
    return (names[-2] if units else names[-1]), units


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
        return instants.counted(lines, SAMPLE)
    except ValueError as error:
        raise RecordingError(f"{path}:{error}") from None


def _column_of_instants(
    path: Path, written: list[str], found: instants.Counted, first: int, separator: str
) -> int | None:
    """The column that holds instants, in every row or nowhere, and of one kind: a number of seconds among them, or one
    of them among numbers, would be read as something else."""
    if not any(found.kinds[first:]):
        return None
    fields = zip(fields_of(written[first], separator), fields_of(found.lines[first], separator), strict=False)
    column = next((k for k, (one, other) in enumerate(fields) if one != other), None)
    for row in range(first, len(written)):
        if written[row].strip() and found.kinds[row] != found.kinds[first]:
            here, there = found.kinds[row] or "no instant", found.kinds[first] or "no instant"
            raise RecordingError(f"{path}:{row + 1}: {here}, where the first row, line {first + 1}, has {there}")
    for row in range(first, len(written)) if column is not None else ():
        one, other = (fields_of(lines[row], separator) for lines in (written, found.lines))
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


def _are_units(row: list[str], above: list[str]) -> bool:
    named = all(name for name, cell in zip(above, row, strict=True) if cell)
    return named and any(row) and all(_UNIT.fullmatch(cell) for cell in row) and row != above


def _numbers(path: Path, lines: list[str], first: int, dialect: Dialect, width: int) -> np.ndarray:
    """[columns, rows] of all lines from `first` on; empty fields become NaN."""
    mark = re.escape(dialect.separator)
    try:
        body = [_unquoted(line, dialect, width) for line in lines[first:] if line.strip()]
        plain = "\n".join(body)
        if dialect.separator != BLANKS:
            plain = re.sub(rf"(^|{mark})[ ]*(?={mark}|$)", r"\1nan", plain, flags=re.MULTILINE)
        if re.search(rf"[^0-9eE+\-{dialect.decimal} \n{mark}]", _NAN.sub("", plain)):
            raise ValueError
        plain = plain.replace(dialect.decimal, ".")
        separator = None if dialect.separator == BLANKS else dialect.separator
        return np.loadtxt(io.StringIO(plain), delimiter=separator, ndmin=2).T
    except ValueError:
        raise _first_fault(path, lines, first, dialect, width) from None


def _unquoted(line: str, dialect: Dialect, width: int) -> str:
    """A line without quotation marks. Raises ValueError where what they hold is not numbers, one in each column."""
    if '"' not in line:
        return line
    fields = fields_of(line, dialect.separator)
    if len(fields) != width or not all(NUMBER[dialect.decimal].fullmatch(field) for field in fields):
        raise ValueError
    return dialect.separator.join(fields)


def _first_fault(path: Path, lines: list[str], first: int, dialect: Dialect, width: int) -> RecordingError:
    """What is wrong in the first line that is no row of numbers."""
    for number, line in enumerate(lines[first:], first + 1):
        fields = fields_of(line, dialect.separator)
        if not line.strip():
            continue
        if len(fields) != width:
            return RecordingError(f"{path}:{number}: {len(fields)} fields where the first row has {width}")
        for column, field in enumerate(fields, 1):
            if not NUMBER[dialect.decimal].fullmatch(field):
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
