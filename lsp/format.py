"""A stable formatter: indentation by nesting, no white space at the ends of lines, at most one empty line.

Tokens, comments, the division into lines and what ends them stay as they are: whoever breaks a line says something by
it. A line that goes on with a statement keeps its distance from the statement's first line. Formatting twice is
formatting once.
"""

from __future__ import annotations

from dataclasses import dataclass, field
import re

from lacuna.codegen.syntax import parse
from lacuna.codegen.syntax.lexer import Source, tokenize

STEP = 2
_CLASSES = {"model", "block", "connector", "record", "package", "function", "class", "operator", "type"}
_SECTIONS = {"equation", "algorithm", "public", "protected"}
_BLOCKS = {"for", "when", "while"}
_BRANCHES = {"else", "elseif", "elsewhen"}
_WHITE = " \t\r"
_COMMENT = re.compile(r"//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/")


def format_text(text: str, file: str = "") -> str:
    """`text` formatted. Raises Diagnostic where it does not parse, so that nothing broken is moved about."""
    parse(text, file)
    source = tokenize(text, file)
    inside = _inside_tokens(source)
    depths = _Nesting(source).lines()
    lines = text.split("\n")  # only: a line separator or a form feed does not end a comment
    ending = "\r" if lines[0].endswith("\r") else ""
    result, shift = [], 0
    for number, line in enumerate(lines):
        if number in inside:
            result.append(line)
            continue
        stripped, indent = line.strip(_WHITE), _width(line)
        if stripped and number in depths:
            wanted = STEP * depths[number]
            shift = wanted - indent
            indent = wanted
        elif stripped:
            indent = max(0, indent + shift)
        if stripped or (result and result[-1] != ending):
            body = line.lstrip(_WHITE) if number + 1 in inside else stripped + ending
            result.append(" " * indent + body if stripped else ending)
    return "\n".join(result).strip("\r\n") + ending + "\n"


def _width(line: str) -> int:
    """Of the white space that a line begins with."""
    return len(line[: len(line) - len(line.lstrip(_WHITE))].expandtabs(STEP))


def _inside_tokens(source: Source) -> set[int]:
    """Lines (from zero) that begin inside a token or a comment, which are left as they are."""
    found: set[int] = set()

    def add(begin: int, text: str) -> None:
        if "\n" in text:
            first = source.span(begin).line
            found.update(range(first, first + text.count("\n")))

    end = 0
    for offset, word in zip(source.offsets, [*source.words[:-1], ""], strict=True):
        for comment in _COMMENT.finditer(source.text, end, offset):
            add(comment.start(), comment[0])
        add(offset, word)
        end = offset + len(word)
    return found


@dataclass
class _Nesting:
    """Walks the tokens once; for each line that begins a statement its depth."""

    source: Source
    depth: int = 0
    parens: int = 0
    pending: list[bool] = field(default_factory=list)  # of each `if` or `when` before its `then`: is it a block?
    opened: list[bool] = field(default_factory=list)  # of each open class: does it have an end?
    starts: bool = True  # a statement begins at this token

    def lines(self) -> dict[int, int]:
        kinds, found, last = self.source.kinds, {}, -1
        for k, kind in enumerate(kinds[:-1]):
            line = self.source.span(self.source.offsets[k]).line - 1
            leading = line != last
            last = line
            dedent = self._before(k, kind)
            if leading and (self.starts or dedent is not None) and self.parens == 0:
                found[line] = max(0, self.depth - (dedent or 0))
            self._after(k, kind)
        return found

    def _before(self, k: int, kind: str) -> int | None:
        """How far a line that begins with this token stands out; None: it stands for itself."""
        kinds = self.source.kinds
        if self.parens:
            return None
        if kind == "end" and self.starts:
            self.depth -= 1
            return 0
        section = kind in _SECTIONS or (kind == "initial" and kinds[k + 1] in _SECTIONS)
        if self.starts and (section or kind in _BRANCHES):
            return 1
        return None

    def _after(self, k: int, kind: str) -> None:
        kinds = self.source.kinds
        self.parens += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(kind, 0)
        if self.parens:
            self.starts = False
            return
        starts, self.starts = self.starts, False
        if kind == ";" or kind in _SECTIONS:
            self.starts = True
        elif kind == "initial" and kinds[k + 1] in _SECTIONS:
            pass
        elif kind in ("if", "elseif", "elsewhen"):
            self._condition(kind, starts, k)
        elif kind == "then":
            self.starts = bool(self.pending) and self.pending.pop()
        elif kind == "else":
            self.starts = starts
        elif kind == "loop":
            self.starts = True
        elif kind in _BLOCKS and starts:
            self.depth += 1
            if kind == "when":
                self.pending.append(True)
        elif kind in _CLASSES and self._opens(k):
            self.depth += 1
        elif self._names_class(k):
            self.starts = True

    def _condition(self, kind: str, starts: bool, k: int) -> None:
        if kinds_end(self.source, k):
            return
        self.pending.append(starts)
        if kind == "if" and starts:
            self.depth += 1

    def _opens(self, k: int) -> bool:
        """A class with an end of its own; not `end type`, not a short definition, not `operator function`'s first."""
        kinds = self.source.kinds
        if kinds[k - 1] == "end" and k:
            return False
        name = k + 2 if kinds[k + 1] == "extends" else k + 1
        return kinds[name] == "id" and kinds[name + 1] != "="

    def _names_class(self, k: int) -> bool:
        """The last token of the head of a class: its name, or the string after it."""
        kinds = self.source.kinds
        if kinds[k] == "id":
            before = k - 2 if kinds[k - 1] == "extends" else k - 1
            head = before >= 0 and kinds[before] in _CLASSES and (before == 0 or kinds[before - 1] != "end")
            return head and kinds[k + 1] not in ("str", "=", "(", ".")
        return kinds[k] == "str" and k >= 1 and kinds[k - 1] == "id" and k >= 2 and self._heads(k - 1)

    def _heads(self, name: int) -> bool:
        kinds = self.source.kinds
        before = name - 2 if kinds[name - 1] == "extends" else name - 1
        return before >= 0 and kinds[before] in _CLASSES


def kinds_end(source: Source, k: int) -> bool:
    """`if`, `when` ... after `end`."""
    return k > 0 and source.kinds[k - 1] == "end"
