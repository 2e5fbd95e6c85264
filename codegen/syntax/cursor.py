"""Walking over tokens: looking ahead, expecting, and telling what was found instead."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.syntax.lexer import KEYWORDS, Source
from lacuna.suggest import did_you_mean

MAX_DEPTH = 100
OF_OTHERS = ("elsif", "elif")  # for elseif, in languages that engineers come from
MAX_OPERANDS = 1000


class Cursor:
    def __init__(self, source: Source) -> None:
        self.source = source
        self.kinds = source.kinds
        self.words = source.words
        self.at = 0
        self.depth = 0
        self.loops = 0  # around what is being read
        self.stray_breaks: list[Span] = []  # in no loop
        self.errors: list[Diagnostic] = []

    @property
    def kind(self) -> str:
        return self.kinds[self.at]

    @property
    def word(self) -> str:
        return self.words[self.at]

    def span(self, index: int | None = None) -> Span:
        """The place of one token, the current one by default."""
        i = self.at if index is None else index
        length = 1 if self.kinds[i] == "eof" else len(self.words[i].split("\n", 1)[0])
        return self.source.span(self.source.offsets[i], length)

    def span_from(self, start: int) -> Span:
        """From token `start` to the one before the current, on the first line of it."""
        text = self.text_from(start)
        return self.source.span(self.source.offsets[start], max(1, len(text.split("\n", 1)[0])))

    def text_from(self, start: int) -> str:
        last = max(self.at - 1, start)
        return self.source.text[self.source.offsets[start] : self.source.offsets[last] + len(self.words[last])]

    def accept(self, *kinds: str) -> bool:
        if self.kinds[self.at] in kinds:
            self.at += 1
            return True
        return False

    def expect(self, kind: str, what: str = "") -> None:
        if self.kinds[self.at] == kind:
            self.at += 1
        else:
            raise self.unexpected(what or f"'{kind}'")

    def identifier(self, what: str = "a name") -> str:
        if self.kind == "id":
            self.at += 1
            return self.words[self.at - 1]
        if self.kind in KEYWORDS:
            message = f"'{self.word}' is a keyword of Modelica and cannot be a name"
            raise Diagnostic("P012", message, self.span(), f"rename it, for example {self.word}_")
        raise self.unexpected(what)

    def semicolon(self) -> None:
        """The ; that ends a declaration, equation or statement; its lack is shown where it should have stood."""
        if self.accept(";"):
            return
        previous = self.at - 1
        end = self.source.offsets[previous] + len(self.words[previous])
        same_line = self.source.span(end).line == self.span().line
        if self.kind == ":=":
            hint = "in an equation section write =; the assignment := belongs under 'algorithm'"
            raise Diagnostic("P004", "':=' stands in an equation", self.span(), hint)
        if self.kind == "=":
            hint = "in an algorithm section write :=; the equation = belongs under 'equation'"
            raise Diagnostic("P004", "'=' stands where an assignment or ';' belongs", self.span(), hint)
        if same_line and self.kind not in ("eof", "end"):
            raise self.unexpected("';' or an operator")
        raise Diagnostic("P006", "';' is missing", self.source.span(end - 1), "end the line above with ';'")

    @property
    def slip(self) -> str:
        """A hint where the word here is a keyword of other languages."""
        return "did you mean elseif?" if self.word in OF_OTHERS else ""

    def unexpected(self, wanted: str) -> Diagnostic:
        hint = ""
        if self.kind == "id":
            hint = did_you_mean(self.word, [k for k in KEYWORDS if f"'{k}'" in wanted])
        found = self.word if self.kind == "eof" else f"'{self.word}'"
        if self.at and self.words[self.at - 1] in OF_OTHERS:
            hint = "did you mean elseif?"
        hint = hint or f"put {wanted} before {found}, or remove {found}"
        return Diagnostic("P003", f"expected {wanted}, found {found}", self.span(), hint)

    def enter(self) -> None:
        """Guard of the recursive descent: what is nested deeper than MAX_DEPTH is refused, not a crash."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            hint = "name parts of it with variables of their own"
            raise Diagnostic("P013", f"nested more than {MAX_DEPTH} deep", self.span(), hint)

    def refuse_long(self, operands: int) -> None:
        """Guard of what walks the tree later: a chain of operators is as deep as it is long."""
        if operands > MAX_OPERANDS:
            hint = "use sum of an array, or name parts of it with variables of their own"
            raise Diagnostic("P013", f"more than {MAX_OPERANDS} operands in one expression", self.span(), hint)

    def leave(self) -> None:
        self.depth -= 1

    def recover(self, error: Diagnostic, stop: tuple[str, ...], start: int) -> None:
        """Note `error` and go on after the next ';' (or before a token in `stop`)."""
        self.errors.append(error)
        if len(self.errors) >= 10:
            raise first_of(self.errors)
        self.at = max(self.at, start + 1)
        while self.kind != "eof" and self.kind not in stop:
            if self.accept(";"):
                return
            self.at += 1


def first_of(errors: list[Diagnostic]) -> Diagnostic:
    """The first of several findings, carrying the others."""
    first = errors[0]
    first.others = errors[1:]
    return first
