"""The body of one generated C function: named locals, shared subexpressions, loads of what it uses."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import contextmanager

from lacuna.codegen.emit.text.doubts import SURE, Doubts
from lacuna.codegen.emit.text.expression import c_type, lower_powers, to_c
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.emit.text.uses import Uses
from lacuna.codegen.symbolic.expr import BOOLEAN, Expr
from lacuna.codegen.symbolic.leaves import LEAF_OPS, depends, leaves

Access = Callable[[Expr], str | None]  # C text that loads a leaf from memory, None where it must be computed

_GIVEN = tuple(f"m->{array}[" for array in ("p", "u", "d", "pre_d", "rel"))  # constant between events, or recorded


class Body:
    """Write statements in order; `plan` the expressions of a scope first, so that shared ones are computed once."""

    def __init__(self, names: Names, access: Access, given: Mapping[Expr, str] | None = None):
        self.names = names
        self._access = access
        self._loads: dict[Expr, str] = {}
        self._preamble: list[str] = []
        self._lines: list[str] = []
        self._defined: dict[Expr, str] = dict(given or {})  # nodes that have a name already
        self.doubts = Doubts()
        self._uses = Uses(self.doubts)
        self._depth = 1
        self._temporaries = 0
        self._lowered: dict[Expr, Expr] = {}
        self._changed: list[Expr] = []

    def text(self) -> str:
        order = sorted(self._loads.items(), key=lambda item: _natural(item[1]))
        loads = [f"  {line}" for _, line in order]
        return "\n".join([*self._preamble, *loads, *self._lines])

    def preamble(self, text: str) -> None:
        """A statement that stands before everything is loaded."""
        self._preamble.append(f"  {text}")

    def line(self, text: str) -> None:
        self._lines.append("  " * self._depth + text if text else "")

    def plan(self, roots: Iterable[Expr]) -> None:
        """Count uses in the expressions that follow: what is used twice gets a temporary."""
        self._uses.plan(lower_powers(root, self._lowered) for root in roots)

    def value(self, e: Expr, outer: int = 0) -> str:
        """C text of `e`; temporaries that it shares with others are written before."""
        return self._text(e, outer, self.doubts)

    def size(self, e: Expr, outer: int = 0) -> str:
        """As `value`, of the size of an unknown: what it compares is none of the model's relations."""
        return self._text(e, outer, SURE)

    def _text(self, e: Expr, outer: int, doubts: Doubts) -> str:
        e = lower_powers(e, self._lowered)
        self._prepare(e, doubts)
        return to_c(e, self._name, outer, doubts)

    def _prepare(self, e: Expr, doubts: Doubts) -> None:
        if e in self._defined or e.op == "const" or self.names.table(e):
            return
        if e.op in LEAF_OPS:
            self._load(e)
            return
        for a in e.args:
            self._prepare(a, doubts)
        if self._uses.is_shared(e):
            self._temporaries += 1
            name = f"tmp{self._temporaries}"
            self.line(f"const {c_type(e)} {name} = {to_c(e, self._name, doubts=doubts)};")
            self._defined[e] = name

    def _load(self, n: Expr) -> None:
        name = self.names.leaf(n)
        if n.op not in ("time", "initial", "terminal"):
            text = self._access(n)
            assert text is not None, f"{n} is used before it is computed"
            test = " != 0.0" if n.type == BOOLEAN and n.op not in ("rel", "tick") else ""
            self._loads[n] = f"const {c_type(n)} {name} = {text}{test};"
        self._defined[n] = name

    def _name(self, n: Expr) -> str | None:
        return self._defined.get(n) or self.names.table(n)

    def is_given(self, e: Expr) -> bool:
        """Whether `e` follows from the data of the run alone, not from what the function is given or computes."""
        return all((self._access(n) or "").startswith(_GIVEN) for n in leaves(e))

    def let(self, leaf: Expr, value: Expr, declare: bool = True) -> None:
        """Define the local of a leaf; where `declare` is false it was declared before (and may change)."""
        text = self.value(value)
        name = self.names.leaf(leaf)
        self.line(f"{f'const {c_type(leaf)} ' if declare else ''}{name} = {text};")
        self._defined[leaf] = name
        lowered = lower_powers(value, self._lowered)
        if declare and lowered.args:
            self._defined.setdefault(lowered, name)

    def assign(self, leaf: Expr, value: Expr) -> None:
        """Change a declared local; expressions that were computed from its old value are forgotten."""
        self.line(f"{self.names.leaf(leaf)} = {self.value(value)};")
        self._changed.append(leaf)
        self._forget([leaf])

    def _forget(self, changed: Iterable[Expr]) -> None:
        for leaf in changed:
            for n in [n for n in self._defined if n.args and n not in self._loads and depends(n, leaf)]:
                del self._defined[n]

    def define(self, leaf: Expr) -> None:
        """The local of `leaf` exists now: it was written by hand."""
        self._defined[leaf] = self.names.leaf(leaf)

    def declare(self, leaf: Expr, value: str) -> None:
        """A local that changes later."""
        name = self.names.leaf(leaf)
        self.line(f"{c_type(leaf)} {name} = {value};")
        self._defined[leaf] = name

    @contextmanager
    def scope(self, header: str, roots: Iterable[Expr]) -> Iterable[None]:
        """A braced block whose temporaries end with it."""
        outer_defined, outer_uses, before = self._defined, self._uses, len(self._changed)
        self._defined, self._uses = dict(outer_defined), Uses(self.doubts)
        self.line(f"{header} {{" if header else "{")
        self._depth += 1
        self.plan(roots)
        yield
        self._depth -= 1
        self.line("}")
        loaded = {n: name for n, name in self._defined.items() if n in self._loads}
        self._defined, self._uses = {**outer_defined, **loaded}, outer_uses
        self._forget(self._changed[before:])

    @contextmanager
    def loop(self, changed: Iterable[Expr]) -> Iterable[None]:
        """A block that is run until something leaves it; `changed` are the locals that it assigns."""
        self._forget(changed)
        with self.scope("for (;;)", ()):
            yield


def _natural(load: str) -> tuple:
    """Loads sorted by array, then index."""
    source = load.split(" = ", 1)[1]
    array, _, rest = source.partition("[")
    digits = rest.partition("]")[0]
    return array, int(digits) if digits.isdigit() else 0, source
