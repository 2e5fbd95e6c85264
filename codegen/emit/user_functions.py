"""Functions of the model as static C functions, each only where it is called.

One scalar result is returned; several results, and arrays, go through pointers at the end of the arguments of a
function `..._all` (NULL where not wanted), beside which a short one returns the first. Arrays are row-major. A function
that fails (an assert, a subscript out of range, a loop without end) notes it in m->failure and gives NaN.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import product
import math
import re

from .. import flat
from ..errors import Diagnostic
from ..expr import BOOLEAN, BUILTINS, TRUE, Expr, const, is_const, walk
from ..function_tangent import by_name
from ..leaves import leaves
from ..rewrite import all_statements, expressions
from .expression import function_name, lower_powers, to_c
from .names import Names

LOOP_LIMIT = 10_000_000


def user_functions(functions: dict[str, flat.Function], called: Iterable[str], names: Names) -> str:
    """C of the functions `called` in expressions and of those that they call, callees first."""
    written: dict[str, str] = {}
    values: dict[str, str] = {}

    def visit(name: str, as_value: bool) -> None:
        f = by_name(functions, name)
        if name not in written:
            written[name] = ""
            for inner, inner_value in _calls_of(f):
                visit(inner, inner_value)
            del written[name]
            written[name] = _FunctionWriter(f, functions, names).write()
        if as_value and not returns_value(f) and name not in values:
            values[name] = _first_result(f)

    for name in called:
        visit(name, True)
    return "\n\n".join([*written.values(), *values.values()])


def calls(roots: Iterable[Expr]) -> list[str]:
    """Names of the functions of the model that occur in expressions, in order."""
    found = (str(n.value) for root in roots for n in walk(root) if n.op == "call")
    return list(dict.fromkeys(name for name in found if name not in BUILTINS and name != "[]"))


def _calls_of(f: flat.Function) -> list[tuple[str, bool]]:
    """(name, whether in an expression) of the functions that `f` calls."""
    whole = [s.value for s in all_statements(f.body) if isinstance(s, flat.AssignCall)]
    inside = [e for e in (*f.defaults.values(), *expressions(f.body)) if e not in whole]
    inside += [a for call in whole for a in call.args]
    return [(str(call.value), False) for call in whole] + [(name, True) for name in calls(inside)]


def _first_result(f: flat.Function) -> str:
    writer = _FunctionWriter(f, {}, Names(()))
    names = [writer.c_name(n) for n in f.inputs]
    pointers = ["&result", *["NULL"] * (len(f.outputs) - 1)]
    return (
        f"static double {function_name(f.name)}({', '.join(writer.inputs())}) {{\n"
        f"  double result = 0.0;\n  {function_name(f.name)}_all({', '.join(['m', *names, *pointers])});\n"
        "  return result;\n}"
    )


class _FunctionWriter:
    def __init__(self, f: flat.Function, functions: dict[str, flat.Function], names: Names):
        self._f, self._functions, self._tables = f, functions, names
        self._names = Names(f.shapes)
        self._lines: list[str] = []
        self._depth = 1
        self._lowered: dict[Expr, Expr] = {}
        self._counter = 0

    def write(self) -> str:
        f = self._f
        read = {leaf.value for e in (*f.defaults.values(), *expressions(f.body)) for leaf in leaves(e)}
        for name in f.shapes:
            if name not in f.inputs:
                self._declare(name)
                if name not in read and name not in f.outputs:
                    self._line(f"(void){self.c_name(name)};")
        self._statements(f.body)
        self._line(self._leave())
        body = "\n".join(self._lines)
        words = set(re.findall(r"\w+", body))
        unused = [f"  (void){n};" for n in ("m", *map(self._names.identifier, f.inputs)) if n not in words]
        place = f"/* {f.span.file.rsplit('/', 1)[-1]}:{f.span.line}  function {f.name} */"
        return "\n".join([place, f"{self._signature()} {{", *unused, body, "}"])

    def c_name(self, name: str) -> str:
        return self._names.identifier(name)

    def inputs(self) -> list[str]:
        """Declarations of the arguments."""
        f = self._f
        stars = [(n, "*" if f.shapes[n] else "") for n in f.inputs]
        return ["const mdl_data *m", *(f"const {self._type(n)} {star}{self.c_name(n)}" for n, star in stars)]

    def _signature(self) -> str:
        f = self._f
        arguments = [*self.inputs(), *(f"{self._type(n)} *{self.c_name(n)}_out" for n in by_pointer(f))]
        kind = self._type(f.outputs[0]) if returns_value(f) else "void"
        return f"static {kind} {c_function(f)}({', '.join(arguments)})"

    def _type(self, name: str) -> str:
        return "int" if self._f.types[name] == BOOLEAN and not self._f.shapes[name] else "double"

    # -- declarations and results -----------------------------------------------------------------------------

    def _declare(self, name: str) -> None:
        shape, default = self._f.shapes[name], self._f.defaults.get(name)
        c_name = self.c_name(name)
        if not shape:
            self._line(f"{self._type(name)} {c_name} = {self._text(default) if default is not None else '0'};")
            return
        elements = default.args if default is not None else (const(0.0),)
        self._line(f"double {c_name}[{math.prod(shape)}] = {{{', '.join(map(self._text, elements))}}};")

    def _leave(self) -> str:
        """Statements that hand over the results and return."""
        f, parts = self._f, []
        for n in by_pointer(f):
            c_name, shape = self.c_name(n), f.shapes[n]
            if shape:
                parts.append(f"if ({c_name}_out) {{ memcpy({c_name}_out, {c_name}, sizeof {c_name}); }}")
            else:
                parts.append(f"if ({c_name}_out) {{ *{c_name}_out = {c_name}; }}")
        if returns_value(f):
            parts.append(f"return {self.c_name(f.outputs[0])};")
        else:
            parts.append("return;")
        return " ".join(parts)

    def _fail(self, kind: str) -> str:
        """Note a failure and return NaN everywhere."""
        parts = [f"(void)mdl_fail((mdl_data *)m, MDL_FAILURE_{kind}, -1, 0.0);"]
        for n in self._f.outputs:
            target = self.c_name(n) + ("[0]" if self._f.shapes[n] else "")
            parts.append(f"{target} = {'0' if self._type(n) == 'int' else 'NAN'};")
        return " ".join([*parts, self._leave()])

    # -- statements -------------------------------------------------------------------------------------------

    def _line(self, text: str) -> None:
        self._lines.append("  " * self._depth + text)

    def _statements(self, body: Sequence[flat.Statement]) -> None:
        for s in body:
            self._statement(s)

    def _block(self, header: str, body: Sequence[flat.Statement], first: str = "") -> None:
        self._line(f"{header} {{")
        self._depth += 1
        if first:
            self._line(first)
        self._statements(body)
        self._depth -= 1
        self._line("}")

    def _statement(self, s: flat.Statement) -> None:
        match s:
            case flat.Assign():
                self._assign(s)
            case flat.AssignElement():
                target = f"{self.c_name(s.target)}[{self._offset(s.target, s.indices)}]"
                self._line(f"{target} = {self._text(s.value)};")
            case flat.AssignCall():
                self._assign_call(s)
            case flat.If():
                word = "if"
                for condition, body in s.branches:
                    self._block("else" if condition is TRUE else f"{word} ({self._text(condition)})", body)
                    word = "else if"
            case flat.While():
                self._counter += 1
                guard = f"rounds{self._counter}"
                self._line(f"long {guard} = 0;")
                self._block(f"while ({self._text(s.condition)})", s.body, f"if (++{guard} > {LOOP_LIMIT}) "
                            f"{{ {self._fail('LOOP')} }}")  # fmt: skip
            case flat.For():
                self._for(s)
            case flat.Return():
                self._line(self._leave())
            case flat.Break():
                self._line("break;")
            case flat.Assert():
                self._line(f"if (!({self._text(s.condition)})) {{ {self._fail('ASSERT')} }}")
            case _:
                raise Diagnostic("C003", f"{type(s).__name__.lower()} is not supported in a function", s.span)

    def _assign(self, s: flat.Assign) -> None:
        target = self.c_name(s.target)
        if not self._f.shapes[s.target]:
            self._line(f"{target} = {self._text(s.value)};")
            return
        for k, element in enumerate(s.value.args):
            self._line(f"{target}[{k}] = {self._text(element)};")

    def _assign_call(self, s: flat.AssignCall) -> None:
        callee = by_name(self._functions, str(s.value.value))
        targets = dict(zip(callee.outputs, (*s.targets, *[None] * len(callee.outputs)), strict=False))
        pointers = []
        for n in by_pointer(callee):
            target = targets[n]
            star = "" if target is None or self._f.shapes[target] else "&"
            pointers.append("NULL" if target is None else star + self.c_name(target))
        arguments = ", ".join(["m", *map(self._text, s.value.args), *pointers])
        result = f"{c_function(callee)}({arguments});"
        first = targets[callee.outputs[0]] if returns_value(callee) else None
        self._line(result if first is None else f"{self.c_name(first)} = {result}")

    def _for(self, s: flat.For) -> None:
        i, last, step = self.c_name(s.variable), self._text(s.last), self._text(s.step)
        if is_const(s.step):
            test = f"{i} {'<=' if s.step.value > 0 else '>='} {last}"
        else:
            test = f"({step}) > 0.0 ? {i} <= {last} : {i} >= {last}"
        self._block(f"for (double {i} = {self._text(s.first)}; {test}; {i} += {step})", s.body)

    # -- expressions ------------------------------------------------------------------------------------------

    def _text(self, e: Expr) -> str:
        return to_c(lower_powers(e, self._lowered), self._lookup)

    def _lookup(self, n: Expr) -> str | None:
        if n.op == "var":
            return self.c_name(str(n.value))
        if n.op == "call" and n.value == "[]":
            return self._element(n)
        if n.op == "array":
            return self._whole(n) or self._tables.table(n)
        return None

    def _element(self, n: Expr) -> str:
        array, *indices = n.args
        if array.op == "array":
            offset = self._offset_in((len(array.args),), indices)
            return f"{self._tables.table(array) or to_c(array, self._lookup)}[{offset}]"
        name = str(array.value)
        test = " != 0.0" if self._f.types[name] == BOOLEAN else ""
        text = f"{self.c_name(name)}[{self._offset(name, indices)}]"
        return f"({text}{test})" if test else text

    def _offset(self, name: str, indices: Sequence[Expr]) -> str:
        return self._offset_in(self._f.shapes[name], indices)

    def _offset_in(self, shape: Sequence[int], indices: Sequence[Expr]) -> str:
        """Row-major offset of 1-based indices; those known only at run time are checked."""
        fixed, parts = 0, []
        for k, (size, index) in enumerate(zip(shape, indices, strict=True)):
            stride = math.prod(shape[k + 1 :])
            if is_const(index):
                fixed += (int(index.value) - 1) * stride
            else:
                checked = f"mdl_index(m, {self._text(index)}, {size})"
                parts.append(checked if stride == 1 else f"{stride} * {checked}")
        return " + ".join([*parts, *([str(fixed)] if fixed or not parts else [])])

    def _whole(self, n: Expr) -> str | None:
        """The name of a local array that `n` lists element by element."""
        first = n.args[0] if n.args else None
        if first is None or first.op != "call" or first.value != "[]" or first.args[0].op != "var":
            return None
        name = str(first.args[0].value)
        every = product(*(range(1, size + 1) for size in self._f.shapes[name]))
        same = [tuple(i.value for i in e.args[1:]) if e.op == "call" and e.args[0] is first.args[0] else None
                for e in n.args]  # fmt: skip
        return self.c_name(name) if same == list(every) else None


def returns_value(f: flat.Function) -> bool:
    return len(f.outputs) == 1 and not f.shapes[f.outputs[0]]


def by_pointer(f: flat.Function) -> tuple[str, ...]:
    """Results that are handed over through pointers."""
    return () if returns_value(f) else f.outputs


def c_function(f: flat.Function) -> str:
    """The C function that gives all results."""
    return function_name(f.name) + ("" if returns_value(f) else "_all")
