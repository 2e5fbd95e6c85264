"""Diagnostics: one exception type for every refusal, with a code, a place in the source and a hint.

Code ranges:  P parse   R resolve (names, types, subset)   F flatten   U units   S structure   C code generation
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path


@dataclass(frozen=True)
class Span:
    """A place in a source file: 1-based line and column, and the length of the marked text."""

    file: str
    line: int
    column: int
    length: int = 1

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


@lru_cache(maxsize=256)
def _source_lines(file: str) -> tuple[str, ...]:
    try:
        return tuple(Path(file).read_text(encoding="utf-8", errors="replace").splitlines())
    except OSError:
        return ()


def source_line(span: Span) -> str:
    """The line of source that `span` is on, without its line end; empty where the file cannot be read."""
    lines = _source_lines(span.file)
    return lines[span.line - 1] if 0 < span.line <= len(lines) else ""


@dataclass
class Diagnostic(Exception):
    """One finding about a model: `code` such as "R012", a sentence, where, and what to do about it.

    `notes` are further places that belong to it, each with its own remark (an earlier declaration, the
    equations of a singular subset). `about` names the variables that are in the way, where a caller may take them away.
    """

    user_error = True

    code: str
    message: str
    span: Span | None = None
    hint: str = ""
    notes: list[tuple[Span, str]] = field(default_factory=list)
    severity: str = "error"
    others: list[Diagnostic] = field(default_factory=list)  # further findings, independent of this one
    cut: bool = False  # there may be more than the others: nobody looked on
    about: tuple[str, ...] = ()

    def __str__(self) -> str:
        parts = [f"{self.span}: " if self.span else "", f"{self.severity}[{self.code}]: {self.message}"]
        text = ["".join(parts)]
        if self.span:
            text += _excerpt(self.span)
        for span, remark in self.notes:
            text.append(f"  {span}: {remark}")
            text += _excerpt(span)
        if self.hint:
            text.append(f"  hint: {self.hint}")
        text += map(str, self.others)
        if self.cut:
            text.append(f"these are the first {len(self.others) + 1}; there may be more")
        return "\n".join(text)


def _excerpt(span: Span) -> list[str]:
    line = source_line(span)
    if not line:
        return []
    pad = "".join("\t" if c == "\t" else " " for c in line[: span.column - 1])
    carets = "^" * max(1, min(span.length, len(line) - span.column + 1))
    return [f"    {line}", f"    {pad}{carets}"]
