"""Characters to tokens."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
import re

from lacuna.codegen.errors import Diagnostic, Span

KEYWORDS = frozenset(
    (
        "algorithm", "and", "annotation", "block", "break", "class", "connect", "connector", "constant",
        "constrainedby", "der", "discrete", "each", "else", "elseif", "elsewhen", "encapsulated", "end", "enumeration",
        "equation", "expandable", "extends", "external", "false", "final", "flow", "for", "function", "if", "import",
        "impure", "in", "initial", "inner", "input", "loop", "model", "not", "operator", "or", "outer", "output",
        "package", "parameter", "partial", "protected", "public", "pure", "record", "redeclare", "replaceable",
        "return", "stream", "then", "true", "type", "when", "while", "within",
    )
)  # fmt: skip

_TOKEN = re.compile(
    r"""
      (?P<skip>[ \t\r\n\f\ufeff]+ | //[^\n]* | /\*(?:[^*]|\*(?!/))*\*/)
    | (?P<id>[A-Za-z_][A-Za-z_0-9]*|'(?:[^'\\\n]|\\.)+')
    | (?P<num>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)
    | (?P<str>"(?:[^"\\]|\\.)*")
    | (?P<wrong>!=|&&|\|\||\*\*|\+\+|--|[-+*/]=|[!&|%~@#$?`\\])
    | (?P<op>:=|<=|>=|==|<>|\.[-+*/^]|/(?!\*)|[-+*^()\[\]{},;:=<>.])
    """,
    re.VERBOSE | re.DOTALL,
)

_INSTEAD = {
    "!=": "'not equal' is written <>",
    "&&": "'and' is written as the word: a and b",
    "||": "'or' is written as the word: a or b",
    "!": "'not' is written as the word: not a",
    "**": "a power is written a^b",
    "%": "the remainder is the function mod(a, b)",
}

_ESCAPES = {"n": "\n", "t": "\t", "r": "\r", "f": "\f", "v": "\v", "a": "\a", "b": "\b"}
_ESCAPED = frozenset((*_ESCAPES, "'", '"', "?", "\\"))  # what may stand after a backslash


def is_name(text: str) -> bool:
    """Whether `text` is an identifier, quoted ones among them, and no keyword (specification, 2.3.1)."""
    found = _TOKEN.fullmatch(text)
    return found is not None and found.lastgroup == "id" and text not in KEYWORDS


@dataclass
class Source:
    """One file's text with its tokens: parallel lists of kind, text and offset.

    The kind of a keyword or an operator is its own text; otherwise id, num, str or end of file ("eof").
    """

    file: str
    text: str
    kinds: list[str]
    words: list[str]
    offsets: list[int]
    line_starts: list[int]

    def places(self) -> list[tuple[int, int]]:
        """Line, from zero, and offset in it of every token but the end."""
        starts, line, found = [*self.line_starts, len(self.text) + 1], 0, []
        for offset in self.offsets[:-1]:
            while starts[line + 1] <= offset:
                line += 1
            found.append((line, offset - starts[line]))
        return found

    def span(self, offset: int, length: int = 1) -> Span:
        line = bisect_right(self.line_starts, offset)
        return Span(self.file, line, offset - self.line_starts[line - 1] + 1, length)


def tokenize(text: str, file: str) -> Source:
    """Every token of `text`, ending in "eof". Raises P001 (unknown character) or P002 (text without an end)."""
    starts = [0] + [m.end() for m in re.finditer(r"\n", text)]
    source = Source(file, text, [], [], [], starts)
    position, end, match = 0, len(text), _TOKEN.match
    while position < end:
        found = match(text, position)
        if found is None:
            raise _unreadable(source, position)
        kind = found.lastgroup
        if kind != "skip":
            word = found.group()
            if kind == "wrong":
                if word in ("++", "--"):
                    word = word[0]
                else:
                    raise _wrong_operator(source, position, word)
                kind = "op"
            if kind == "op" or (kind == "id" and word in KEYWORDS):
                kind = word
            elif kind == "num":
                _check_number(source, position, found.end())
            if "\\" in word:
                _check_escapes(source, position, word)
            source.kinds.append(kind)
            source.words.append(word)
            source.offsets.append(position)
            position += len(word)
        else:
            position = found.end()
    source.kinds.append("eof")
    source.words.append("the end of the file")
    source.offsets.append(len(text.rstrip()))
    return source


def _unreadable(source: Source, position: int) -> Diagnostic:
    text = source.text
    if text[position] == '"':
        return Diagnostic(
            "P002", "this string has no end", source.span(position), 'close it with " (and write \\" inside it)'
        )
    if text.startswith("/*", position):
        return Diagnostic("P002", "this comment has no end", source.span(position, 2), "close it with */")
    if text.startswith("''", position):
        return Diagnostic("P002", "this quoted name is empty", source.span(position, 2), "write a name between them")
    if text[position] == "'":
        return Diagnostic("P002", "this quoted name has no end", source.span(position), "close it with '")
    hint = "names and operators use plain ASCII; other letters belong in strings and comments"
    return Diagnostic("P001", f"the character {text[position]!r} has no meaning here", source.span(position), hint)


def _wrong_operator(source: Source, position: int, word: str) -> Diagnostic:
    hint = _INSTEAD.get(word, "the operators are + - * / ^ and or not < <= > >= == <>")
    if word.endswith("=") and word != "!=":
        hint = f"write the assignment out: x := x {word[0]} ..."
    return Diagnostic("P010", f"{word} is no operator of Modelica", source.span(position, len(word)), hint)


def _check_number(source: Source, start: int, end: int) -> None:
    following = source.text[end : end + 1]
    if following.isalpha() or following == "_":
        raise Diagnostic(
            "P011",
            f"a number runs into a letter: {source.text[start : end + 1]}",
            source.span(start, end - start + 1),
            "put an operator between them, such as 2*x; an exponent needs digits, such as 1e-3",
        )


def _check_escapes(source: Source, start: int, word: str) -> None:
    """Raises P018 for a backslash before what needs none (Modelica 3.6, 2.4.2)."""
    for found in re.finditer(r"\\(.)", word, flags=re.DOTALL):
        if found[1] not in _ESCAPED:
            hint = 'write \\\\ for a backslash; the others are \\n, \\t, \\" and the like'
            raise Diagnostic("P018", f"'{found[0]}' is no escape sequence", source.span(start + found.start(), 2), hint)


def string_value(word: str) -> str:
    """The text a string token stands for."""
    return re.sub(r"\\(.)", lambda m: _ESCAPES.get(m.group(1), m.group(1)), word[1:-1], flags=re.DOTALL)
