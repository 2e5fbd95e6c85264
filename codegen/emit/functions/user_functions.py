"""Functions of the model as static C functions, each only where it is called.

One scalar result is returned; several results, and arrays, go through pointers at the end of the arguments of a
function `..._all` (NULL where not wanted), beside which a short one returns the first. Arrays are row-major. A function
that fails (an assert, a subscript out of range, a loop without end) notes it in m->failure and gives NaN.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from lacuna.codegen import flat
from lacuna.codegen.emit.functions.endless import calls_of, is_recursive
from lacuna.codegen.emit.functions.function_body import FunctionBody, c_type, declarations, returns_value
from lacuna.codegen.emit.text.expression import function_name
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.symbolic.function_tangent import by_name


def user_functions(
    functions: dict[str, flat.Function],
    called: Iterable[str],
    names: Names,
    assert_index: Callable[[flat.Assert], int],
) -> str:
    """C of the functions `called` in expressions and of those that they call, callees first. `assert_index` gives the
    row of an assert in the model's table."""
    written: dict[tuple[str, bool], str] = {}  # of each its body, and its first result as a value where that is wanted
    begun: list[flat.Function] = []

    def visit(name: str, as_value: bool) -> None:
        f = by_name(functions, name)
        body = name, False
        if body not in written:
            written[body] = ""
            begun.append(f)
            for inner, inner_value in calls_of(f):
                visit(inner, inner_value)
            del written[body]
            written[body] = FunctionBody(f, functions, names, assert_index).write()
        if as_value and not returns_value(f) and (name, True) not in written:
            written[name, True] = _first_result(f)

    for name in called:
        visit(name, True)
    ahead = [_prototype(body) for body in written.values()] if any(is_recursive(f, functions) for f in begun) else []
    return "\n\n".join([*(["\n".join(ahead)] if ahead else []), *written.values()])


def _prototype(body: str) -> str:
    """The declaration of a function that is called before it is defined."""
    return next(line for line in body.splitlines() if line.startswith("static ")).removesuffix(" {") + ";"


def _first_result(f: flat.Function) -> str:
    arguments, names = declarations(f, Names(f.shapes))
    pointers, kind = ["&result", *["NULL"] * (len(f.outputs) - 1)], c_type(f, f.outputs[0])
    return (
        f"static {kind} {function_name(f.name)}({', '.join(arguments)}) {{\n"
        f"  {kind} result = 0;\n  {function_name(f.name, whole=True)}({', '.join(['m', *names, *pointers])});\n"
        "  return result;\n}"
    )
