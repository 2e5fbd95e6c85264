"""Files that come from users: of a size that can be read, and text, JSON or TOML as they say; or refused in a line."""

from __future__ import annotations

import json
from pathlib import Path
import tomllib
from typing import Any

MOST_DIGITS = 18  # of a whole number in 64 bits, as TOML has them
GREATEST = 1e150  # number: its square is a machine number, too, and so is that of its reciprocal
LARGEST = 1 << 30  # bytes of a file that is read: a hundred signals for a quarter of an hour at 1 kHz as text


def require_file(path: Path, error: type[Exception]) -> None:
    """Raises `error` where `path` is no file of a size that is read: devices and pipes have no end."""
    if not path.is_file():
        raise error(f"{path}: {'is not a file' if path.exists() else 'there is no such file'}")
    if path.stat().st_size > LARGEST:
        raise error(f"{path}: larger than {LARGEST >> 20} MB")


def text_of(path: Path, error: type[Exception], encoding: str = "utf-8") -> str:
    """With the ends of lines that are there. Raises `error` where `path` cannot be read as text."""
    require_file(path, error)
    try:
        return path.read_bytes().decode(encoding)
    except OSError as refused:
        raise error(f"{path}: cannot be read ({refused.strerror})") from refused
    except UnicodeDecodeError as refused:
        raise error(f"{path}: not a text in UTF-8: {refused}") from refused


def json_of(path: Path, error: type[Exception]) -> Any:
    """Raises `error` where `path` holds no JSON."""
    try:
        return json.loads(text_of(path, error), parse_int=_whole)
    except (ValueError, RecursionError) as refused:
        raise error(f"{path}: no JSON: {refused}") from refused


def toml_of(path: Path, error: type[Exception]) -> dict[str, Any]:
    """Raises `error` where `path` holds no TOML."""
    return parsed_toml(text_of(path, error), path, error)


def parsed_toml(text: str, path: Path, error: type[Exception]) -> dict[str, Any]:
    try:
        found = tomllib.loads(text)
        _require_numbers(found)
        return found
    except (ValueError, RecursionError) as refused:
        raise error(f"{path}: {refused}") from refused


def _whole(text: str) -> int:
    if len(text) > MOST_DIGITS:
        raise ValueError(f"a whole number of {len(text)} digits")
    return int(text)


def _require_numbers(value: Any) -> None:
    """Raises ValueError for a whole number that no machine number holds, wherever it stands."""
    if isinstance(value, int) and abs(value) >= 10**MOST_DIGITS:
        raise ValueError(f"a whole number of more than {MOST_DIGITS} digits")
    for inner in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
        _require_numbers(inner)
