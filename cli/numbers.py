"""Numbers among the options of a command: read as those of files are, and counts bounded, for every command alike."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import re
from typing import Any, get_args

import typer

from lacuna.texts import decimal

MOST = 2**31 - 1  # a count that a C int, as in the runtime and in libraries, takes; no computer does more of anything
_WHOLE = re.compile(r"[+-]?[0-9]+")


def read_as_in_files(hints: Mapping[str, Any]) -> None:
    """Give every option of `hints` that is an int or a float a reader of ours: digits, a point and an exponent, finite,
    and within the bounds of the option."""
    for hint in hints.values():
        kind, *marks = get_args(hint) if hasattr(hint, "__metadata__") else (None,)
        kinds = {*(get_args(kind) or (kind,))} - {type(None)}
        for mark in marks:
            if kinds in ({int}, {float}) and getattr(mark, "parser", True) is None:
                least, most = mark.min, mark.max
                mark.min = mark.max = None  # the reader holds them
                mark.parser = _reader(kinds == {int}, least, most)
                mark.metavar = mark.metavar or ("INTEGER" if kinds == {int} else "NUMBER")


def _reader(whole: bool, least: float | None, most: float | None) -> Callable[[Any], float]:
    most = min(MOST if most is None else most, MOST) if whole else most

    def read(given: Any) -> float:
        text = str(given).strip()
        try:
            if whole and not _WHOLE.fullmatch(text):
                raise ValueError
            value = int(text) if whole and len(text) < 20 else decimal(text)  # longer ones are beyond every bound
        except ValueError:
            raise typer.BadParameter(f"{text[:40]!r} is no {'whole' if whole else 'finite'} number") from None
        if (least is not None and value < least) or (most is not None and value > most):
            raise typer.BadParameter(f"{text[:40]} is not within {_bounds(least, most)}")
        return value

    return read


def _bounds(least: float | None, most: float | None) -> str:
    return f"{'...' if least is None else least} and {'...' if most is None else most}"
