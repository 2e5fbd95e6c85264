"""A file as it is being edited: its tokens, its classes with where they end, and the name at a place."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from pathlib import Path

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.lexer import Source, tokenize


@dataclass(frozen=True)
class Name:
    """A dotted name in the text, up to the part at the cursor: `parts` and the token of the last one."""

    parts: tuple[str, ...]
    token: int
    absolute: bool  # written with a leading dot


class Document:
    """`classes` as the library parsed them; `tokens` of the same text. Raises Diagnostic where it has no tokens."""

    def __init__(self, path: Path, text: str, classes: list[ast.Class]):
        self.path, self.text, self.classes = path, text, classes
        self.tokens: Source = tokenize(text, str(path))
        self._ends = self._class_ends()

    def reads_as(self, other: Document) -> bool:
        """Has it the same tokens in the same places? Comments may differ."""
        one, two = self.tokens, other.tokens
        return (one.words, one.kinds) == (two.words, two.kinds) and one.places() == two.places()

    def offset(self, line: int, character: int) -> int:
        """Of a place as editors count it, from zero."""
        starts = self.tokens.line_starts
        return (starts[line] if line < len(starts) else len(self.text)) + character

    def offset_of(self, span: Span) -> int:
        return self.offset(span.line - 1, span.column - 1)

    def token_at(self, offset: int) -> int | None:
        """The token that holds or ends at `offset`."""
        k = bisect_right(self.tokens.offsets, offset) - 1
        if k >= 0 and self.tokens.offsets[k] == offset and self.tokens.kinds[k] != "id" and k > 0:
            k -= 1 if self.tokens.offsets[k - 1] + len(self.tokens.words[k - 1]) == offset else 0
        if k < 0 or offset > self.tokens.offsets[k] + len(self.tokens.words[k]):
            return None
        return k

    def name_at(self, offset: int) -> Name | None:
        k = self.token_at(offset)
        if k is None or self.tokens.kinds[k] not in ("id", "der"):
            return None
        return self.name_of(k)

    def name_of(self, token: int) -> Name:
        """The dotted name that ends with this token; subscripts between its parts are passed over."""
        kinds, words = self.tokens.kinds, self.tokens.words
        parts, k = [words[token]], token
        while k >= 1 and kinds[k - 1] == ".":
            before = self._over_subscripts(k - 2)
            if before is None or kinds[before] != "id":
                return Name(tuple(parts), token, True)
            parts.insert(0, words[before])
            k = before
        return Name(tuple(parts), token, False)

    def _over_subscripts(self, k: int) -> int | None:
        if k < 0:
            return None
        if self.tokens.kinds[k] != "]":
            return k
        depth = 0
        while k >= 0:
            depth += {"]": 1, "[": -1}.get(self.tokens.kinds[k], 0)
            k -= 1
            if depth == 0:
                return k if k >= 0 else None
        return None

    def class_at(self, offset: int) -> ast.Class | None:
        """The innermost class that `offset` is in."""
        found, members = None, list(self.classes)
        while members:
            inside = [c for c in members if self.offset_of(c.span) <= offset <= self._ends.get(id(c), len(self.text))]
            if not inside:
                return found
            found = inside[-1]
            members = [c for c in found.classes.values() if c.span.file == found.span.file]
        return found

    def end_of(self, cls: ast.Class) -> int:
        return self._ends.get(id(cls), len(self.text))

    def all_classes(self) -> list[ast.Class]:
        found, queue = [], list(self.classes)
        while queue:
            cls = queue.pop(0)
            found.append(cls)
            queue += [c for c in cls.classes.values() if c.span.file == cls.span.file]
        return found

    def _class_ends(self) -> dict[int, int]:
        """Of each class the offset behind its `end NAME;`, or of a short definition behind its semicolon."""
        ends, kinds, words, offsets = {}, self.tokens.kinds, self.tokens.words, self.tokens.offsets
        for cls in self.all_classes():
            start = bisect_right(offsets, self.offset_of(cls.span)) - 1
            long = cls.alias is None and cls.literals is None and cls.derivative_of is None
            for k in range(start, len(kinds)):
                closes = kinds[k] == "end" and words[k + 1] == cls.name if long else kinds[k] == ";"
                if closes:
                    ends[id(cls)] = offsets[min(k + 2, len(kinds) - 1)] if long else offsets[k] + 1
                    break
        return ends


def parsed(path: Path, text: str, classes: list[ast.Class]) -> Document | None:
    """None where the text has no tokens."""
    try:
        return Document(path, text, classes)
    except Diagnostic:
        return None
