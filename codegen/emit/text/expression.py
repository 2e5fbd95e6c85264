"""Expressions as C, by operator precedence. Numbers are double, Booleans int; Integers are doubles of whole value."""

from __future__ import annotations

from collections.abc import Callable

from lacuna.codegen.emit.text.doubts import Doubts, may_round
from lacuna.codegen.symbolic.expr import (
    BOOLEAN,
    BUILTINS,
    INTEGER,
    Expr,
    Unassigned,
    call,
    const,
    div,
    mul,
    transform,
)

_BINARY = {
    "or": ("||", 2), "and": ("&&", 3), "==": ("==", 4), "<>": ("!=", 4), "<": ("<", 5), "<=": ("<=", 5),
    ">": (">", 5), ">=": (">=", 5), "+": ("+", 6), "-": ("-", 6), "*": ("*", 7), "/": ("/", 7),
}  # fmt: skip
_UNARY, _PRIMARY = 8, 9
_FUNCTIONS = {
    "abs": "fabs", "integer": "floor", "sign": "mdl_sign", "mod": "mdl_mod", "rem": "mdl_rem", "div": "mdl_div",
}  # fmt: skip
_OF_WHOLE = {"mod": "mdl_whole_mod", "rem": "fmod", "div": "mdl_whole_div"}
_NOTED = {
    "<": ("mdl_lt", "<"), "<=": ("mdl_le", "<="), ">": ("mdl_gt", ">"), ">=": ("mdl_ge", ">="),
    "==": ("mdl_eq", "=="), "<>": ("mdl_ne", "!="),
}  # fmt: skip
HELPERS = {
    # what is no number stays none: a != a
    "mdl_min": "static inline double mdl_min(double a, double b) { return a < b || a != a ? a : b; }",
    "mdl_max": "static inline double mdl_max(double a, double b) { return a > b || a != a ? a : b; }",
    "mdl_sign": "static inline double mdl_sign(double a) { return a != a ? a : (a > 0.0) - (a < 0.0); }",
    "mdl_mod": "static inline double mdl_mod(double a, double b) { return a - floor(a / b) * b; }",
    "mdl_rem": "static inline double mdl_rem(double a, double b) { return a - trunc(a / b) * b; }",
    "mdl_div": "static inline double mdl_div(double a, double b) { return trunc(a / b); }",
    # of Integers, whose quotient need not be exact
    "mdl_whole_mod": "static inline double mdl_whole_mod(double a, double b) {\n"
    "  const double rest = fmod(a, b);\n  return rest != 0.0 && (rest < 0.0) != (b < 0.0) ? rest + b : rest;\n}",
    "mdl_whole_div": "static inline double mdl_whole_div(double a, double b) { return (a - fmod(a, b)) / b; }",
    # of Integers: no number where the result reaches 2^53 and may not be exact, so that nothing is made of it
    "mdl_exact": "static inline double mdl_exact(double result) { return fabs(result) >= 0x1p53 ? NAN : result; }",
    # of sides that may have no value, which would decide nonetheless: noted, for a run that accepts the point to end
    "mdl_sides": "static inline void mdl_sides(const mdl_data *m, int where, double a, double b) {\n"
    "  if (a != a || b != b) ((mdl_data *)m)->unsettled = where;\n}",
    **{
        name: f"static inline int {name}(const mdl_data *m, int where, double a, double b) {{\n"
        f"  mdl_sides(m, where, a, b);\n  return a {sign} b;\n}}"
        for name, sign in _NOTED.values()
    },
}

Lookup = Callable[[Expr], str | None]
NO_BOOLEAN = "-1"  # what a Boolean is that has no value, as NaN is of a number; the runtime looks for it


def number(value: float | int | bool) -> str:
    """A C literal that reads back to exactly this double (Booleans as int)."""
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, Unassigned) and value.unread:
        return "MDL_UNREAD"
    text = repr(float(value))
    return text if text.lstrip("-") not in ("inf", "nan") else text.replace("inf", "INFINITY").replace("nan", "NAN")


def lower_powers(e: Expr, memo: dict[Expr, Expr]) -> Expr:
    """Small whole and half powers as products and roots."""

    def rule(n: Expr) -> Expr | None:
        if n.op != "^" or n.args[1].op != "const":
            return None
        base, exponent = lower_powers(n.args[0], memo), n.args[1].value
        if exponent in (2, 3, 4):
            square = mul(base, base)
            return {2: square, 3: mul(square, base), 4: mul(square, square)}[exponent]
        if exponent == 0.5:
            return call("sqrt", base)
        return div(const(1.0), base) if exponent == -1 else None

    return transform(e, rule, memo)


def to_c(e: Expr, name: Lookup, outer: int = 0, doubts: Doubts | None = None) -> str:
    """`e` as C. `name(node)` gives the text that stands for a node (a local, a temporary), or None."""
    return _Printer(name, doubts or Doubts()).text(e, outer)


class _Printer:
    """Writes expressions of one body."""

    def __init__(self, name: Lookup, doubts: Doubts):
        self._name, self._doubts = name, doubts

    def text(self, e: Expr, outer: int = 0) -> str:
        text, rank = self._print(e)
        return f"({text})" if rank < outer else text

    def _print(self, e: Expr) -> tuple[str, int]:
        known = self._name(e)
        if known is not None:
            return known, _PRIMARY
        if e.op == "const":
            text = number(e.value) if e.type != BOOLEAN or e.value in (0, 1) else NO_BOOLEAN
            return text, _UNARY if text.startswith("-") else _PRIMARY
        if may_round(e):
            return f"mdl_exact({self._print_binary(e)[0]})", _PRIMARY
        if self._doubts.of(e):
            return f"{_NOTED[e.op][0]}(m, {self._doubts.place}, {self._list(e.args)})", _PRIMARY
        if e.op in _BINARY:
            return self._print_binary(e)
        if e.op == "start_time":
            return "m->start_time", _PRIMARY
        if e.op == "path":
            return "m->homotopy", _PRIMARY
        if e.op == "neg":
            return "-" + self.text(e.args[0], _PRIMARY), _UNARY
        if e.op == "not":
            return "!" + self.text(e.args[0], _PRIMARY), _UNARY
        if e.op == "if":
            condition, a, b = e.args
            return f"{self.text(condition, 2)} ? {self.text(a, 2)} : {self.text(b, 1)}", 1
        if e.op in ("min", "max"):
            return f"mdl_{e.op}({self._list(e.args)})", _PRIMARY
        if e.op == "^":
            return f"pow({self._list(e.args)})", _PRIMARY
        if e.op == "array":
            return f"(const double[]){{{self._list(e.args) or '0.0'}}}", _PRIMARY  # C has no empty arrays
        if e.op == "call":
            return self._print_call(e), _PRIMARY
        if e.op == "carried":
            number_of, end, x, order = (self.text(a) for a in e.args)
            return f"m->carried(m, (int){number_of}, {end}, {x}, (int){order})", _PRIMARY
        if e.op in ("noEvent", "smooth"):
            return self._print(e.args[-1])
        if e.op == "annotated":
            return self._print(e.args[0])
        raise AssertionError(f"no C for {e.op}: {e}")

    def _list(self, args: tuple[Expr, ...]) -> str:
        return ", ".join(self.text(a) for a in args)

    def _print_binary(self, e: Expr) -> tuple[str, int]:
        sign, rank = _BINARY[e.op]
        a, b = e.args
        # gcc asks for parentheses where && stands in ||, and around comparisons of comparisons
        left = rank if e.op in ("+", "-", "*", "/", "or", "and") else rank + 2
        right = rank + 1 if e.op not in ("<", "<=", ">", ">=", "==", "<>") else rank + 2
        if e.op == "or":
            left, right = (rank if a.op == "or" else 4), 4
        return f"{self.text(a, left)} {sign} {self.text(b, right)}", rank

    def _print_call(self, e: Expr) -> str:
        function = str(e.value)
        if function in BUILTINS:
            names = _OF_WHOLE if all(a.type == INTEGER for a in e.args) else _FUNCTIONS
            return f"{names.get(function) or _FUNCTIONS.get(function, function)}({self._list(e.args)})"
        arguments = ", ".join(["m", *(self.text(a) for a in e.args)])
        return f"{function_name(function)}({arguments})"


def function_name(function: str, whole: bool = False) -> str:
    """The C function of a function of the model, or the one that gives all its results.

    Each has a name of its own: a dot becomes an underscore, everything else that is no letter or digit its code
    between _0 and _ (after a dot no digit can stand, and no code starts with an l).
    """
    text = "".join(c if c.isascii() and c.isalnum() else "_" if c == "." else f"_0{ord(c):x}_" for c in function)
    return f"fn_{text}{'_0l' if whole else ''}"


def c_type(e: Expr) -> str:
    return "int" if e.type == BOOLEAN else "double"


def is_trivial(e: Expr) -> bool:
    """Not worth a temporary: a constant, or the negation of something that is."""
    return e.op == "const" or (e.op in ("neg", "not", "array") and (e.op == "array" or not e.args[0].args))
