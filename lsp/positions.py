"""Places as the protocol counts them, in UTF-16 code units, and as Python does, in characters."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from lsprotocol import types as lsp

from lacuna.codegen.errors import Span


class Positions:
    """`text` gives that of a file."""

    def __init__(self, text: Callable[[Path], str]) -> None:
        self._text = text

    def place(self, path: Path, at: lsp.Position) -> tuple[int, int]:
        """(line, character) from zero, characters counted one by one."""
        units, row = 0, self._row(path, at.line)
        for k, character in enumerate(row):
            if units >= at.character:
                return at.line, k
            units += _units(character)
        return at.line, len(row) + at.character - units

    def range(self, span: Span) -> lsp.Range:
        row, begin = self._row(Path(span.file), span.line - 1), span.column - 1
        start = begin + _beyond(row[:begin])
        end = start + max(1, span.length + _beyond(row[begin : begin + span.length]))
        return lsp.Range(lsp.Position(span.line - 1, start), lsp.Position(span.line - 1, end))

    def marked(self, path: Path, at: lsp.Range) -> str:
        """The text of a range on one line; "" where there is none any more."""
        line, begin = self.place(path, at.start)
        return self._row(path, line)[begin : self.place(path, at.end)[1]]

    def _row(self, path: Path, line: int) -> str:
        try:
            rows = self._text(path.resolve()).split("\n")
        except (OSError, UnicodeDecodeError):
            return ""
        return rows[line] if 0 <= line < len(rows) else ""


def _units(character: str) -> int:
    return 2 if character > "\uffff" else 1


def _beyond(text: str) -> int:
    """How many more code units than characters a text has."""
    return 0 if text.isascii() else sum(_units(c) - 1 for c in text)
