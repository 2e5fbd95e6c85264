"""Rows of separated text: the one reader of CSV, on which every kind of table is built."""

from __future__ import annotations

from collections.abc import Iterator
import csv
import io


def rows_of(text: str, separator: str = ",") -> Iterator[tuple[int, list[str]]]:
    """(line, cells without blanks around them) of every line that holds something; a quoted cell may hold separators
    and ends of lines. Raises ValueError, with the line, where a quotation does not end or a cell is too long."""
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    try:
        for row in reader:
            if any(row):
                yield reader.line_num, [cell.strip() for cell in row]
    except csv.Error as error:
        raise ValueError(f"line {reader.line_num}: {error}") from None
