"""Expressions as C, by operator precedence. Numbers are double, Booleans int; Integers are doubles of whole value."""

from __future__ import annotations

from collections.abc import Callable

from lacuna.codegen.symbolic.expr import (
    BOOLEAN,
    BUILTINS,
    INTEGER,
    RELATIONS,
    Expr,
    call,
    const,
    div,
    mul,
    transform,
    walk,
)

_BINARY = {
    "or": ("||", 2), "and": ("&&", 3), "==": ("==", 4), "<>": ("!=", 4), "<": ("<", 5), "<=": ("<=", 5),
    ">": (">", 5), ">=": (">=", 5), "+": ("+", 6), "-": ("-", 6), "*": ("*", 7), "/": ("/", 7),
}  # fmt: skip
_UNARY, _PRIMARY = 8, 9
_FUNCTIONS = {
    "abs": "fabs", "integer": "floor", "sign": "mdl_sign", "mod": "mdl_mod", "rem": "mdl_rem", "div": "mdl_div",
}  # fmt: skip
HELPERS = {
    # what is no number stays none: a != a
    "mdl_min": "static inline double mdl_min(double a, double b) { return a < b || a != a ? a : b; }",
    "mdl_max": "static inline double mdl_max(double a, double b) { return a > b || a != a ? a : b; }",
    "mdl_sign": "static inline double mdl_sign(double a) { return a != a ? a : (a > 0.0) - (a < 0.0); }",
    "mdl_mod": "static inline double mdl_mod(double a, double b) { return a - floor(a / b) * b; }",
    "mdl_rem": "static inline double mdl_rem(double a, double b) { return a - trunc(a / b) * b; }",
    "mdl_div": "static inline double mdl_div(double a, double b) { return trunc(a / b); }",
    # of Integers: no number where the result reaches 2^53 and may not be exact, so that nothing is made of it
    "mdl_exact": "static inline double mdl_exact(double result) { return fabs(result) >= 0x1p53 ? NAN : result; }",
    # of sides that hold such a result: noted as a failure where one of them is no number
    "mdl_compared": "static inline int mdl_compared(const mdl_data *m, double a, double b, int holds) {\n"
    "  if (a != a || b != b) (void)mdl_fail((mdl_data *)m, MDL_FAILURE_INEXACT, -1, 0.0);\n"
    "  return holds;\n}",
}

Lookup = Callable[[Expr], str | None]
NO_BOOLEAN = "-1"  # what a Boolean is that has no value, as NaN is of a number; the runtime looks for it


def number(value: float | int | bool) -> str:
    """A C literal that reads back to exactly this double (Booleans as int)."""
    if isinstance(value, bool):
        return str(int(value))
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


def to_c(e: Expr, name: Lookup, outer: int = 0) -> str:
    """`e` as C. `name(node)` gives the text that stands for a node (a local, a temporary), or None."""
    text, rank = _print(e, name)
    return f"({text})" if rank < outer else text


def _print(e: Expr, name: Lookup) -> tuple[str, int]:
    known = name(e)
    if known is not None:
        return known, _PRIMARY
    if e.op == "const":
        text = number(e.value) if e.type != BOOLEAN or e.value in (0, 1) else NO_BOOLEAN
        return text, _UNARY if text.startswith("-") else _PRIMARY
    if _may_round(e):
        return f"mdl_exact({_print_binary(e, name)[0]})", _PRIMARY
    if e.op in RELATIONS and is_doubtful(e):
        sides, (holds, _) = _list(e.args, name), _print_binary(e, name)
        return f"mdl_compared(m, {sides}, {holds})", _PRIMARY
    if e.op in _BINARY:
        return _print_binary(e, name)
    if e.op == "start_time":
        return "m->start_time", _PRIMARY
    if e.op == "path":
        return "m->homotopy", _PRIMARY
    if e.op == "neg":
        return "-" + to_c(e.args[0], name, _PRIMARY), _UNARY
    if e.op == "not":
        return "!" + to_c(e.args[0], name, _PRIMARY), _UNARY
    if e.op == "if":
        condition, a, b = e.args
        return f"{to_c(condition, name, 2)} ? {to_c(a, name, 2)} : {to_c(b, name, 1)}", 1
    if e.op in ("min", "max"):
        return f"mdl_{e.op}({_list(e.args, name)})", _PRIMARY
    if e.op == "^":
        return f"pow({_list(e.args, name)})", _PRIMARY
    if e.op == "array":
        return f"(const double[]){{{_list(e.args, name) or '0.0'}}}", _PRIMARY  # C has no empty arrays
    if e.op == "call":
        return _print_call(e, name), _PRIMARY
    if e.op == "carried":
        number_of, end, x, order = (to_c(a, name) for a in e.args)
        return f"m->carried(m, (int){number_of}, {end}, {x}, (int){order})", _PRIMARY
    if e.op in ("noEvent", "smooth"):
        return _print(e.args[-1], name)
    if e.op == "annotated":
        return _print(e.args[0], name)
    raise AssertionError(f"no C for {e.op}: {e}")


def is_doubtful(relation: Expr) -> bool:
    """Whether a sum or product of Integers that may not be exact is compared; where it is not, it is no number."""
    return any(_may_round(n) for side in relation.args for n in walk(side))


def _may_round(e: Expr) -> bool:
    """Whether `e` is a sum or a product of Integers that may reach 2^53. One with a constant grows too slowly to get
    there but from near by, a product with one of at most 1 in size not at all."""
    if e.op not in ("+", "-", "*") or any(a.type != INTEGER for a in e.args):
        return False
    return not any(a.op == "const" and (e.op != "*" or abs(a.value) <= 1) for a in e.args)


def _list(args: tuple[Expr, ...], name: Lookup) -> str:
    return ", ".join(to_c(a, name) for a in args)


def _print_binary(e: Expr, name: Lookup) -> tuple[str, int]:
    sign, rank = _BINARY[e.op]
    a, b = e.args
    # gcc asks for parentheses where && stands in ||, and around comparisons of comparisons
    left = rank if e.op in ("+", "-", "*", "/", "or", "and") else rank + 2
    right = rank + 1 if e.op not in ("<", "<=", ">", ">=", "==", "<>") else rank + 2
    if e.op == "or":
        left, right = (rank if a.op == "or" else 4), 4
    return f"{to_c(a, name, left)} {sign} {to_c(b, name, right)}", rank


def _print_call(e: Expr, name: Lookup) -> str:
    function = str(e.value)
    if function in BUILTINS:
        return f"{_FUNCTIONS.get(function, function)}({_list(e.args, name)})"
    arguments = ", ".join(["m", *(to_c(a, name) for a in e.args)])
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
