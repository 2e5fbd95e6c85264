"""Readable, unique C identifiers for everything a generated function names."""

from __future__ import annotations

from collections.abc import Iterable
import re

from lacuna.codegen.symbolic.expr import BUILTINS, Expr

_KEYWORDS = """auto break case char const continue default do double else enum extern float for goto if inline int long
register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while"""
_TAKEN = """m t x xdot v y yp r g cj values next start interval pow fabs fmin fmax trunc isfinite isnan memcpy main
INFINITY NAN NULL EOF DECIMAL_DIG math_errhandling tangent lane lanes"""
_RESERVED = frozenset([*_KEYWORDS.split(), *_TAKEN.split(), *BUILTINS])
_GENERATED = re.compile(
    r"(tmp|rel|tick|when|fires)\d+$|(fn|mdl|der|pre|tangent)_|"
    r"(HUGE|FP|FLT|DBL|LDBL|MATH|MDL)_"  # macros of the headers that generated C includes
)


class Names:
    """One identifier for each leaf, the same in every function of the model."""

    def __init__(self, variables: Iterable[str]):
        self.tables: dict[Expr, str] = {}  # constant arrays that stand in the file under a name
        self._used: set[str] = set(_RESERVED)
        self._of: dict[str, str] = {}
        for name in variables:
            self.identifier(name)

    def identifier(self, name: str) -> str:
        """The identifier of a Modelica name."""
        if name not in self._of:
            stem = sanitise(name)[:60].rstrip("_")
            self._of[name] = self._unique(stem + "_" if _GENERATED.match(stem) else stem)
        return self._of[name]

    def _unique(self, stem: str) -> str:
        text, number = stem, 1
        while text in self._used:
            number += 1
            text = f"{stem}_{number}"
        self._used.add(text)
        return text

    def table(self, e: Expr) -> str | None:
        """The name of a constant array, which is written once for the file; None where `e` is not constant."""
        if e.op != "array" or not e.args or any(a.op != "const" for a in e.args):
            return None
        return self.tables.setdefault(e, f"mdl_table{len(self.tables) + 1}")

    def leaf(self, n: Expr) -> str:
        """The identifier of a leaf of an expression."""
        match n.op:
            case "var":
                return self.identifier(str(n.value))
            case "der" | "pre":
                key = f"${n.op} {n.args[0]}"
                if key not in self._of:
                    self._of[key] = self._unique(f"{n.op}_{self.identifier(str(n.args[0].value))}")
                return self._of[key]
            case "rel" | "tick":
                return f"{n.op}{n.value}"
            case "time":
                return "t"
        return f"m->{n.op}"


def sanitise(name: str) -> str:
    """`name` with everything outside [A-Za-z0-9_] as one underscore, not starting with a digit."""
    text = re.sub(r"[^A-Za-z0-9_]+", "_", name).strip("_") or "v"
    return f"v_{text}" if text[0].isdigit() else text
