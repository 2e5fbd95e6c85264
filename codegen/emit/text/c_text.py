"""Text of the model as C: string literals, comments, names of source files. Whatever a user wrote stays data."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
import re

from lacuna.codegen.library.search_path import outermost

_SHORT = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\r": "\\r", "\t": "\\t", "\a": "\\a", "\b": "\\b", "\f": "\\f",
          "\v": "\\v"}  # fmt: skip

LONGEST = 1000  # characters of a literal, at most 4 bytes each: C promises no more than 4095 bytes (C99, 5.2.4.1)

_PLAIN = re.compile(r"[ !#-&(->@-\[\]-~']*")  # printable ASCII without quotes, backslashes and question marks


def c_string(text: str) -> str:
    """A C string literal of `text` in UTF-8; what does not print is written in octal, byte by byte.

    Of two question marks the second is escaped, so that no trigraph can arise. A longer text is cut, and ends in "...".
    """
    if len(text) > LONGEST:
        text = text[: LONGEST - 4] + " ..."
    if _PLAIN.fullmatch(text):
        return f'"{text}"'
    parts = (_SHORT.get(c) or (c if c.isprintable() else _octal(c)) for c in text)
    return '"' + re.sub(r"(?<=\?)\?", r"\\?", "".join(parts)) + '"'


def _octal(c: str) -> str:
    return "".join(f"\\{byte:03o}" for byte in c.encode("utf-8", "surrogatepass"))


def c_comment(text: str) -> str:
    """`text` on one line of a comment that it cannot end, nor open another; what does not print is a space."""
    if _PLAIN.fullmatch(text) and "*" not in text and "/" not in text:
        return " ".join(text.split())
    printed = "".join(c if c.isprintable() else " " for c in text)
    return " ".join(printed.split()).replace("*/", "* /").replace("/*", "/ *").replace("??/", "?? /")


class SourceNames:
    """Source files by names that are the same wherever the packages lie: from the folder of the outermost package on
    for what is in one, else the file's own name."""

    def __init__(self) -> None:
        self._of: dict[str, str] = {}

    def __call__(self, file: str) -> str:
        if file not in self._of:
            path = Path(file)
            top = outermost(path.parent)
            self._of[file] = path.name if top is None else path.relative_to(top.parent).as_posix()
        return self._of[file]

    def digests(self, files: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
        """(name, digest) of each (file, digest), in order."""
        return sorted((self(file), digest) for file, digest in files)
