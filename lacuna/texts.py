"""What texts of users become: numbers, names of files."""

from __future__ import annotations

import math
import re

LONGEST_NAME = 100  # characters of a file's name, which with an ending and a prefix may have 255 bytes
_DECIMAL = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")


def decimal(text: str) -> float:
    """The finite number that `text` is, but for blanks around it: digits with a point and an exponent, and nothing else
    that Python would take for one (1_0, nan, inf, digits of other scripts). Raises ValueError."""
    text = text.strip()
    value = float(text) if _DECIMAL.fullmatch(text) else math.nan
    if not math.isfinite(value):
        raise ValueError(f"{text!r} is no finite number")
    return value


def file_name(name: str) -> str:
    """The last part of a class's name as the name of a file, which no quoted identifier can lead elsewhere."""
    return re.sub(r"[^\w+-]", "_", name.rsplit(".", 1)[-1], flags=re.ASCII)[:LONGEST_NAME]
