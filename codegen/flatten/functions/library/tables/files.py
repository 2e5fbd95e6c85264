"""Matrices by name from files: text with a head `#1`, comma-separated values, MATLAB's MAT-files (4, 6 and 7)."""

from __future__ import annotations

import math
from pathlib import Path
import re

from lacuna.rows import rows_of
from lacuna.texts import decimal

_HEAD = re.compile(r"\s*(?:double|float)\s+(\S+?)\s*\(\s*(\d+)\s*,\s*(\d+)\s*\)\s*(?:#.*)?$")
_SEPARATORS = re.compile(r"[\s,;]+")
MAX_NUMBERS = 2_000_000


class FileError(ValueError):
    """What is wrong with a file of tables."""


def read_matrix(path: Path, name: str, delimiter: str = ",", header_lines: int = 0) -> list[list[float]]:
    """The matrix `name` (of a .csv file: its only one) as rows of numbers. Raises FileError or OSError."""
    suffix = path.suffix.lower()
    if suffix == ".mat":
        rows = _mat(path, name)
    else:
        text = path.read_bytes().decode("utf-8-sig", errors="strict")
        rows = _csv(text, delimiter, header_lines) if suffix == ".csv" else _text(text, name)
    if not rows or not rows[0]:
        raise FileError(f"the table {name} is empty")
    for row in rows:
        for value in row:
            if not math.isfinite(value):
                raise FileError(f"{path.name}: {name} holds a number that is not finite")
    return rows


def _text(text: str, name: str) -> list[list[float]]:
    lines = text.splitlines()
    if not lines or lines[0].strip()[:2] != "#1":
        raise FileError("a text file of tables starts with #1")
    heads = [(at, head) for at, line in enumerate(lines) if (head := _HEAD.match(line))]
    meant = [(at, head) for at, head in heads if head[1] == name]
    if not meant:
        raise FileError(f"there is no table {name}; the file has {', '.join(h[1] for _, h in heads) or 'none'}")
    if len(meant) > 1:
        raise FileError(f"two tables are called {name}")
    at, head = meant[0]
    return _numbers(lines[at + 1 :], name, int(head[2]), int(head[3]))


def _numbers(lines: list[str], name: str, rows: int, columns: int) -> list[list[float]]:
    """rows x columns numbers, in any division into lines; what follows # is a comment."""
    wanted = rows * columns
    if not 0 < wanted <= MAX_NUMBERS:
        raise FileError(f"the table {name} has the size {rows}x{columns}")
    values: list[float] = []
    for line in lines:
        if _HEAD.match(line):
            break
        for word in _SEPARATORS.split(line.split("#", 1)[0].strip()):
            if word:
                values.append(_number(word, name))
    if len(values) != wanted:
        raise FileError(f"the table {name} has {len(values)} numbers, its head says {rows}x{columns}")
    return [values[k * columns : (k + 1) * columns] for k in range(rows)]


def _number(word: str, name: str) -> float:
    try:
        return decimal(word)
    except ValueError:
        raise FileError(f"the table {name} holds {word!r}, which is no number") from None


def _csv(text: str, delimiter: str, header_lines: int) -> list[list[float]]:
    lines = text.splitlines()[header_lines:]
    try:
        rows = [[_number(w, "of the file") for w in row] for _, row in rows_of("\n".join(lines), delimiter)]
    except FileError:
        raise
    except ValueError as error:
        raise FileError(f"it is no table: {error}") from None
    if not rows or len({len(r) for r in rows}) > 1:
        raise FileError("its rows differ in length" if rows else "it holds no data")
    return rows


def _mat(path: Path, name: str) -> list[list[float]]:
    from scipy.io import loadmat
    from scipy.io.matlab import MatReadError

    try:
        content = loadmat(path, variable_names=[name.split(".")[0]], squeeze_me=False, struct_as_record=True)
    except (MatReadError, NotImplementedError, ValueError, TypeError) as error:
        raise FileError(f"{path.name} cannot be read as a MAT-file: {error}") from None
    value = content.get(name.split(".")[0])
    for part in name.split(".")[1:]:
        value = value[part][0, 0] if value is not None and part in (value.dtype.names or ()) else None
    if value is None or value.ndim != 2 or value.dtype.kind not in "fiu":
        raise FileError(f"there is no matrix {name} of numbers in {path.name}")
    return [[float(v) for v in row] for row in value]
