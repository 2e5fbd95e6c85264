"""Spreadsheets by pandas: the first sheet, names in its first row, units in the second where that holds no number."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
import re
from zipfile import ZipFile, ZipInfo

import numpy as np

from lacuna.analysis.recording.channel import (
    Recorded,
    RecordingError,
    beyond_exact,
    clock_name,
    from_clock,
    from_table,
    named_columns,
    on_one_time,
)

_MISSING = ["", "nan", "NaN", "#N/A"]  # and nothing that a channel may be called, such as NA
_ABOUT = "docProps/core.xml"
_MOMENT, _EPOCH = re.compile(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?"), b"1980-01-01T00:00:00"


def read(path: Path) -> Recorded:
    import pandas

    try:
        sheet = pandas.read_excel(path, header=None, keep_default_na=False, na_values=_MISSING)
    except ImportError:
        raise
    except Exception as error:  # a damaged file may trip its parser anywhere
        raise RecordingError(f"{path}: not a spreadsheet that can be read: {error}") from None
    rows = sheet.to_numpy(dtype=object)
    clocks, notes = _clocks(rows)
    first = next((k for k, row in enumerate(rows) if _numbers(row)), None)
    if not first:
        raise RecordingError(f"{path}: its first sheet has no rows of numbers below a row of names")
    above = rows[first - 1]
    if any(isinstance(cell, int | float) and cell == cell for cell in above):
        texts = [number for number, cell in enumerate(above, 1) if isinstance(cell, str)]
        where = f"column {texts[0]} of its row {first}" if texts else f"row {first}"
        raise RecordingError(f"{path}: {where} holds something that is no number among numbers")
    header = [_text(cell) for cell in (rows[first - 2] if _are_units(rows, first) else above)]
    units = [_text(cell) for cell in above] if _are_units(rows, first) else [""] * len(header)
    for k in clocks:
        header[k], units[k] = clock_name(header[k], header), "s"
    for number, row in enumerate(rows[first:], first + 1):
        if not _numbers(row):
            raise RecordingError(f"{path}: row {number} of its first sheet holds something that is no number")
    for name, column in zip(header, rows[first:].T, strict=True):
        if any(isinstance(cell, int) and float(cell) != cell for cell in column):
            raise beyond_exact(path, name)
    values = np.array([[np.nan if cell is None else float(cell) for cell in row] for row in rows[first:]]).T
    kept, said = named_columns(path, header, values)
    return from_table(path, [header[k] for k in kept], [units[k] for k in kept], values[kept], [*notes, *said])


def _clocks(rows: np.ndarray) -> tuple[list[int], list[str]]:
    """The columns that hold dates, which become seconds since the first; and what was assumed."""
    found, notes = [], []
    for k, column in enumerate(rows.T):
        dates = [number for number, cell in enumerate(column) if isinstance(cell, datetime)]
        if dates:
            time, said = from_clock(np.array([column[number] for number in dates], dtype="datetime64[ns]"))
            rows[dates, k] = time.tolist()
            found.append(k)
            notes += said
    return found, notes


def _numbers(row: np.ndarray) -> bool:
    """Truth values become 0 and 1, as in every file that says the type of a column."""
    return all(isinstance(c, int | float) for c in row) and any(c == c for c in row)


def _text(cell: object) -> str:
    return cell.strip() if isinstance(cell, str) else ""


def _are_units(rows: np.ndarray, first: int) -> bool:
    """Two rows of text above the numbers: names, then units."""
    return first > 1 and all(isinstance(cell, str) for cell in rows[first - 2]) and any(map(_text, rows[first - 1]))


def write(recorded: Recorded, path: Path) -> None:
    """Names in the first row, units in the second. Texts are texts, whatever they begin with; numbers have all
    digits."""
    from openpyxl import Workbook
    from openpyxl.cell import WriteOnlyCell

    book = Workbook(write_only=True)
    sheet = book.create_sheet("Sheet1")

    def cell(value: str, kind: str) -> WriteOnlyCell:
        made = WriteOnlyCell(sheet, value)
        made.data_type = kind  # not what the text looks like: a formula, an error
        return made

    time, columns = on_one_time(recorded.channels)
    for texts in (["time", *(c.name for c in recorded.channels)], ["s", *(c.unit for c in recorded.channels)]):
        sheet.append([cell(text, "s") if text else None for text in texts])
    for row in zip(time.tolist(), *(column.tolist() for column in columns), strict=True):
        sheet.append([None if value != value else cell(repr(value), "n") for value in row])
    book.save(path)
    _without_dates(path)


def _without_dates(path: Path) -> None:
    """Take out when it was made, so that equal recordings are equal bytes."""
    with ZipFile(path) as archive:
        entries = [(entry, archive.read(entry)) for entry in archive.infolist()]
    with ZipFile(path, "w") as archive:
        for entry, content in entries:
            plain = ZipInfo(entry.filename)
            plain.compress_type = entry.compress_type
            archive.writestr(plain, _MOMENT.sub(_EPOCH, content) if plain.filename == _ABOUT else content)
