"""The one external function of the language: a column of a CSV file, read at translation."""

from __future__ import annotations

import csv
from functools import lru_cache
import hashlib
import math
from pathlib import Path

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.context import Context
from lacuna.codegen.flatten.values import Array, Value
from lacuna.codegen.suggest import did_you_mean
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.syntax import ast

CSV_COLUMN = "csvColumn"


def call_external(cls: ast.Class, arguments: dict[str, Value], e: ast.Call, context: Context) -> list[Value]:
    """csvColumn(fileName, column) as a vector of constants. Raises R094 for any other external function."""
    values = list(arguments.values())
    if cls.name != CSV_COLUMN or len(values) != 2:
        hint = f"write it as a function of the language; data comes in by {CSV_COLUMN}(fileName, column)"
        raise Diagnostic("R094", f"the external function {cls.name} is outside the subset", e.span, hint)
    name, column = values
    if not isinstance(name, str) or not isinstance(column, str):
        raise Diagnostic("R062", f"{CSV_COLUMN} takes the names of a file and of a column", e.span, "two Strings")
    path = _locate(name, context, e.span)
    text = _read(path, e.span)
    context.files[str(path)] = hashlib.sha256(text.encode()).hexdigest()
    return [csv_column(text, path, column, e.span)]


def _locate(name: str, context: Context, span: Span) -> Path:
    """Beside the model's file, beside the file of the call, or in the folder of a package."""
    folders = [context.folder, Path(span.file).resolve().parent, *context.library.folders]
    for folder in folders:
        if (folder / name).is_file():
            return folder / name
    searched = ", ".join(dict.fromkeys(map(str, folders)))
    raise Diagnostic("F040", f"there is no data file {name}", span, f"looked in {searched}")


def _read(path: Path, span: Span) -> str:
    try:
        return path.read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise Diagnostic("F040", f"cannot read {path}: {error}", span, "save it as UTF-8 text") from None


@lru_cache(maxsize=64)
def _rows(text: str) -> list[list[str]]:
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return list(csv.reader(lines))


def csv_column(text: str, path: Path, column: str, span: Span) -> Array:
    """The numbers under the heading `column`; lines starting with # are comments. Those under `time` increase."""
    rows = _rows(text)
    if not rows:
        raise Diagnostic("F041", f"{path.name} is empty", span, "the first line names the columns")
    heading = [h.strip() for h in rows[0]]
    if column not in heading:
        hint = did_you_mean(column, heading, f"it has {', '.join(heading)}")
        raise Diagnostic("F041", f"{path.name} has no column {column}", span, hint)
    at = heading.index(column)
    numbers: list[float] = []
    for number, row in enumerate(rows[1:], 2):
        found = row[at].strip() if at < len(row) else "nothing"
        wrong = _objection(found, numbers[-1:] if column == "time" else [])
        if wrong:
            message = f"{path.name}, data line {number}, column {column}: {found!r} {wrong}"
            raise Diagnostic("F041", message, span, "correct the file")
        numbers.append(float(found))
    if not numbers:
        raise Diagnostic("F041", f"{path.name} has a heading and no data", span, "add lines of numbers")
    return Array((len(numbers),), tuple(map(ex.const, numbers)))


def _objection(found: str, before: list[float]) -> str | None:
    """What is wrong with a field that should be a number, and greater than the one `before` it, if any."""
    try:
        value = float(found)
    except ValueError:
        return "is no number"
    if not math.isfinite(value):
        return "is no finite number"
    return f"does not come after {before[0]:g}" if before and value <= before[0] else None
