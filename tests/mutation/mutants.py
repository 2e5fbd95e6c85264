"""Small faults that a program could have: one comparison, sign, constant or condition other than it is.

R. A. DeMillo, R. J. Lipton, F. G. Sayward, Hints on test data selection, Computer 11 (1978) 34-41; the operators are
the usual ones (relations, arithmetic, connectives, conditions, constants).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
import re

_COMPARED = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "is": "is not", "is not": "is",
             "in": "not in", "not in": "in"}  # fmt: skip
_ARITHMETIC = {"+": "-", "-": "+", "*": "/", "/": "*", "//": "*", "**": "*"}
_JOINED = {"and": "or", "or": "and"}
_C = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&", " + ": " - ",
      " - ": " + ", " * ": " / ", " / ": " * "}  # fmt: skip
_C_SITES = re.compile(
    r"/\*.*?\*/|//[^\n]*|\"(?:[^\"\\]|\\.)*\"|'(?:[^'\\]|\\.)*'|#[^\n]*|->|<<|>>|<=|>=|==|!=|&&|\|\||[<>]| [-+*/] ",
    re.DOTALL,
)


@dataclass(frozen=True)
class Mutant:
    """`path` with the characters from `start` to `end` replaced."""

    path: Path
    start: int
    end: int
    text: str
    line: int

    def applied(self, source: str) -> str:
        return source[: self.start] + self.text + source[self.end :]

    def told(self, source: str) -> str:
        line = source.splitlines()[self.line - 1].strip()
        return f"{self.path}:{self.line}: `{source[self.start : self.end].strip()}` -> `{self.text.strip()}` in: {line}"


def mutants(path: Path) -> list[Mutant]:
    """Every mutant of a Python or C file."""
    source = path.read_text(encoding="utf-8")
    found = _of_python(path, source) if path.suffix == ".py" else _of_c(path, source)
    return sorted(found, key=lambda m: (m.start, m.text))


def _of_c(path: Path, source: str) -> Iterator[Mutant]:
    for match in _C_SITES.finditer(source):
        if (text := _C.get(match[0])) is not None:
            yield Mutant(path, match.start(), match.end(), text, source.count("\n", 0, match.start()) + 1)


class _Places:
    """Offsets of the tree's places, whose columns are bytes of UTF-8."""

    def __init__(self, source: str) -> None:
        self.lines = source.splitlines(keepends=True)
        self.begins = [0]
        for line in self.lines:
            self.begins.append(self.begins[-1] + len(line))

    def at(self, line: int, column: int) -> int:
        return self.begins[line - 1] + len(self.lines[line - 1].encode()[:column].decode())

    def of(self, node: ast.expr) -> tuple[int, int]:
        assert node.end_lineno is not None and node.end_col_offset is not None
        return self.at(node.lineno, node.col_offset), self.at(node.end_lineno, node.end_col_offset)


def _of_python(path: Path, source: str) -> Iterator[Mutant]:
    places, tree = _Places(source), ast.parse(source)
    for node in ast.walk(tree):
        for start, end, text in _sites(node, source, places):
            yield Mutant(path, start, end, text, source.count("\n", 0, start) + 1)


def _sites(node: ast.AST, source: str, places: _Places) -> Iterator[tuple[int, int, str]]:
    if isinstance(node, ast.Compare):
        yield from _between([node.left, *node.comparators], _COMPARED, source, places)
    elif isinstance(node, ast.BinOp) and not isinstance(node.left, ast.Constant | ast.JoinedStr | ast.List):
        yield from _between([node.left, node.right], _ARITHMETIC, source, places)
    elif isinstance(node, ast.BoolOp):
        yield from _between(node.values, _JOINED, source, places)
    elif isinstance(node, ast.If | ast.While | ast.IfExp):
        start, end = places.of(node.test)
        yield start, end, f"(not ({source[start:end]}))"
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
        start, end = places.of(node)
        yield start, end, repr(node.value + 1)


def _between(
    parts: list[ast.expr], other: dict[str, str], source: str, places: _Places
) -> Iterator[tuple[int, int, str]]:  # fmt: skip
    """The operators that stand between neighbouring parts, without the brackets of these."""
    for left, right in pairwise(parts):
        start, end = places.of(left)[1], places.of(right)[0]
        word = source[start:end].strip("() \n\\")
        at = source.find(word, start, end)
        if word in other:
            yield at, at + len(word), other[word]
