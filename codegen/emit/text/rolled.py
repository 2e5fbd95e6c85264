"""C of functions with many statements: everything in memory, statements that are alike in loops, the rest in parts.

A function of ten thousand named locals takes an optimiser minutes, and most of its statements differ in nothing but the
elements that they read and write. Here each statement is a text with holes for indices; where many of one level (none
needs what another computes) have the same text, they become one loop over the indices. What is left stands in functions
of limited length, so that the compiler's time grows with the model and no faster.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
import re

from lacuna.codegen.emit.text.body import Access
from lacuna.codegen.emit.text.doubts import Doubts
from lacuna.codegen.emit.text.expression import lower_powers, to_c
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.emit.text.uses import Uses
from lacuna.codegen.symbolic.expr import BOOLEAN, Expr
from lacuna.codegen.symbolic.leaves import LEAF_OPS

ALIKE = 8  # statements with one text that make a loop: below, the loop is no shorter than they are
PART = 200  # statements in a function
_PLACE = re.compile(r"(.*)\[(\d+)\]")
_HOLE = re.compile(r"\0(\d+)\0")


@dataclass(frozen=True)
class Statement:
    """`form` is C in which {0}, {1} ... stand for the expressions `values` and #0, #1 ... for the numbers `indices`.

    It computes the leaf `defines`, which can be read at `place`, as v[3], from then on.
    """

    form: str
    values: tuple[Expr, ...]
    indices: tuple[int, ...] = ()
    defines: Expr | None = None
    place: str = ""
    comment: str = ""


def assignment(place: str, value: Expr, defines: Expr | None = None, comment: str = "") -> Statement:
    """`place = value;`"""
    array, index = _PLACE.fullmatch(place).groups()
    return Statement(f"{array}[#0] = {{0}};", (value,), (int(index),), defines, place, comment)


class Rolled:
    """Takes the statements of one function in order; `parts` gives the bodies of the C functions that they become."""

    def __init__(self, names: Names, access: Access, given: dict[Expr, str] | None = None):
        self._names, self._access, self._given = names, access, dict(given or {})
        self._places: dict[Expr, str] = {}
        self._levels: dict[Expr, int] = {}
        self._doubts = Doubts()
        self._uses = Uses(self._doubts)
        self._lowered: dict[Expr, Expr] = {}
        self._groups: dict[tuple[int, str], list[tuple[list[int], str]]] = {}
        self._parts: list[str] = []
        self._lines: list[str] = []
        self._count = 0
        self.shared = 0  # elements of w in use

    def place(self, leaf: Expr) -> str | None:
        """Where a leaf that was computed can be read."""
        return self._places.get(leaf)

    def scratch(self) -> str:
        """A new element of the array w, which all parts share."""
        self.shared += 1
        return f"w[{self.shared - 1}]"

    def plan(self, roots: Iterable[Expr]) -> None:
        """Count uses in the expressions that follow: what is used twice is computed once, into w."""
        self._uses.plan(lower_powers(root, self._lowered) for root in roots)

    def add(self, s: Statement) -> None:
        values = [lower_powers(e, self._lowered) for e in s.values]
        for value in values:
            self._share(value, value)
        self._write(s, values)
        if s.defines is not None and len(values) == 1 and values[0].args and values[0].op not in LEAF_OPS:
            self._places.setdefault(values[0], s.place)
            self._levels.setdefault(values[0], self._levels[s.defines])

    def _share(self, e: Expr, root: Expr) -> None:
        """Have shared subexpressions of a value computed before it."""
        if e in self._places or e in self._given or e.op in LEAF_OPS or self._names.table(e):
            return
        for a in e.args:
            self._share(a, root)
        if e is not root and self._uses.is_shared(e):
            place = self.scratch()
            self._write(assignment(place, e, e), [e])

    def _write(self, s: Statement, values: Sequence[Expr]) -> None:
        found: list[int] = []
        level = 0

        def hole(place: str) -> str:
            match = _PLACE.fullmatch(place)
            if match is None:
                return place
            found.append(int(match[2]))
            return f"{match[1]}[\0{len(found) - 1}\0]"

        def name(n: Expr) -> str | None:
            nonlocal level
            place = self._places.get(n)
            if place is not None:
                level = max(level, self._levels[n] + 1)
            elif n.op in LEAF_OPS:
                place = self._given.get(n) or self._leaf(n)
            else:
                return self._given.get(n) or self._names.table(n)
            is_double = n.type == BOOLEAN and n.op not in ("rel", "tick", "initial", "terminal")
            return f"({hole(place)} != 0.0)" if is_double else hole(place)

        texts = [to_c(value, name, doubts=self._doubts) for value in values]
        numbered = re.sub(r"#(\d+)", lambda m: hole(f"[{s.indices[int(m[1])]}]")[1:-1], s.form)
        text = re.sub(r"\{(\d+)\}", lambda m: texts[int(m[1])], numbered)
        self._groups.setdefault((level, text), []).append((found, s.comment))
        if s.defines is not None:
            self._places[s.defines], self._levels[s.defines] = s.place, level

    def _leaf(self, n: Expr) -> str:
        if n.op in ("time", "initial", "terminal"):
            return self._names.leaf(n)
        text = self._access(n)
        assert text is not None, f"{n} is used before it is computed"
        return text

    def part(self, text: str, defines: Iterable[tuple[Expr, str]] = ()) -> None:
        """A part of its own, written by hand; what it computes can be read at the given places afterwards."""
        self._flush()
        self._end_part()
        self._parts.append(text)
        for leaf, place in defines:
            self._places[leaf], self._levels[leaf] = place, -1

    def parts(self) -> list[str]:
        self._flush()
        self._end_part()
        return self._parts

    def _flush(self) -> None:
        for (_, text), members in sorted(self._groups.items(), key=lambda item: item[0][0]):
            if len(members) >= ALIKE:
                self._lines += _loop(text, members)
                self._count += 2
            else:
                for indices, comment in members:
                    self._lines += [comment] if comment else []
                    self._lines.append(_HOLE.sub(lambda m, at=indices: str(at[int(m[1])]), text))
                    self._count += 1
                    if self._count >= PART:
                        self._end_part()
            if self._count >= PART:
                self._end_part()
        self._groups = {}
        for leaf in self._levels:
            self._levels[leaf] = -1

    def _end_part(self) -> None:
        if self._lines:
            self._parts.append("\n".join(f"  {line}" for line in self._lines))
        self._lines, self._count = [], 0


def _loop(text: str, members: Sequence[tuple[list[int], str]]) -> list[str]:
    """One loop over statements that differ in their indices; those that run evenly are computed from the counter."""
    columns = list(zip(*(indices for indices, _ in members), strict=True))
    tabled: list[tuple[int, ...]] = []
    index: list[str] = []
    for column in columns:
        even = _even(column)
        if even is None and column not in tabled:
            tabled.append(column)
        index.append(even or f"at[k][{tabled.index(column)}]")
    comment = members[0][1]
    lines = [f"{comment[:-3]} (and {len(members) - 1} alike) */"] if comment else []
    lines.append("{")
    if tabled:
        rows = ", ".join("{" + ", ".join(map(str, row)) + "}" for row in zip(*tabled, strict=True))
        lines.append(f"  static const int at[{len(members)}][{len(tabled)}] = {{{rows}}};")
    lines.append(f"  for (int k = 0; k < {len(members)}; ++k) {{")
    lines.append("    " + _HOLE.sub(lambda m: index[int(m[1])], text))
    return [*lines, "  }", "}"]


def _even(column: Sequence[int]) -> str | None:
    """first + k*step, where the numbers run so."""
    first, step = column[0], column[1] - column[0]
    if any(number != first + k * step for k, number in enumerate(column)):
        return None
    if step == 0:
        return str(first)
    factor = "k" if abs(step) == 1 else f"{abs(step)} * k"
    if step < 0:
        return f"{first} - {factor}"
    return f"{factor} + {first}" if first else factor


def in_parts(signature: str, parts: Sequence[str], shared: int, write: Callable[[str, str], str]) -> str:
    """C functions for the parts, each written by `write(signature, text)`, and the one that calls them in order until
    one fails. `shared` elements of an array w go through all of them."""
    if not parts:
        return write(signature, "")
    name = re.search(r"(\w+)\(", signature)[1]
    arguments = signature[signature.index("(") + 1 : -1]
    passed = [re.split(r"[ *]", a)[-1] for a in arguments.split(",")] + (["w"] if shared else [])
    extended = arguments + (", double *w" if shared else "")
    functions = [write(f"static int {name}_{k}({extended})", text) for k, text in enumerate(parts, 1)]
    lines = [f"{signature} {{"]
    if shared:
        lines.append(f"  double w[{shared}];")
    lines.append("  int failed = 0;")
    lines += [f"  if (!failed) failed = {name}_{k}({', '.join(passed)});" for k in range(1, len(parts) + 1)]
    return "\n\n".join([*functions, "\n".join([*lines, "  return failed;", "}"])])
