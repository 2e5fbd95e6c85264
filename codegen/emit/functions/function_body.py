"""The body of one function of the model in C: declarations, statements, array elements."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
import math
import re

from lacuna.codegen import flat
from lacuna.codegen.emit.functions.endless import ROUNDS, frame, has_row, may_not_end, row_of
from lacuna.codegen.emit.functions.foreign import foreign_lines
from lacuna.codegen.emit.text.c_text import c_comment
from lacuna.codegen.emit.text.doubts import Doubts
from lacuna.codegen.emit.text.expression import function_name, lower_powers, to_c
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.emit.text.steps import place
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.symbolic.expr import BOOLEAN, TRUE, Expr, is_const
from lacuna.codegen.symbolic.expr import nothing as no_value
from lacuna.codegen.symbolic.function_tangent import by_name
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import expressions


class FunctionBody:
    def __init__(
        self,
        f: flat.Function,
        functions: dict[str, flat.Function],
        names: Names,
        assert_index: Callable[[flat.Assert], int],
    ):
        self._assert_index = assert_index
        self._frame, self._guarded = frame(f), may_not_end(f, functions)
        self._end = assert_index(row_of(f)) if has_row(f, functions) else -1
        self._doubts = Doubts(lambda: self._end, in_function=True)
        self._f, self._functions, self._tables = f, functions, names
        self._names = Names(f.shapes)
        self._lines: list[str] = []
        self._depth = 1
        self._lowered: dict[Expr, Expr] = {}

    def write(self) -> str:
        f = self._f
        read = {leaf.value for e in (*f.defaults.values(), *expressions(f.body)) for leaf in leaves(e)}
        if self._guarded:
            self._line(f"if (!mdl_enter(m, {self._frame}, {self._end})) {{ {self._refuse()} }}")
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
        where = f"/* {place(f.span)}  function {c_comment(f.name)} */"
        return "\n".join([where, f"{self._signature()} {{", *unused, body, "}"])

    def c_name(self, name: str) -> str:
        return self._names.identifier(name)

    def _place(self, name: str) -> str:
        """The pointer through which a result is given."""
        return self._names.identifier(f"{name} out")

    def _signature(self) -> str:
        f = self._f
        inputs, _ = declarations(f, self._names)
        arguments = [*inputs, *(f"{c_type(f, n)} *{self._place(n)}" for n in by_pointer(f))]
        kind = c_type(f, f.outputs[0]) if returns_value(f) else "void"
        return f"static {kind} {c_function(f)}({', '.join(arguments)})"

    # -- declarations and results -----------------------------------------------------------------------------

    def _declare(self, name: str) -> None:
        """A variable that nothing was assigned to has no value (12.4.4): what comes of it ends the run."""
        shape, default = self._f.shapes[name], self._f.defaults.get(name)
        c_name, nothing = self.c_name(name), to_c(no_value(self._f.types[name]), lambda n: None)
        if not shape:
            self._line(f"{c_type(self._f, name)} {c_name} = {nothing if default is None else self._text(default)};")
        elif default is not None and default.args:
            elements = ", ".join(map(self._text, default.args))
            self._line(f"double {c_name}[{math.prod(shape)}] = {{{elements}}};")
        else:
            size = max(1, math.prod(shape))
            self._line(f"double {c_name}[{size}];")
            self._line(f"for (int next = 0; next < {size}; next++) {c_name}[next] = {nothing};")

    def _leave(self) -> str:
        """Statements that hand over the results and return."""
        f, parts = self._f, [f"((mdl_data *)m)->stack -= {self._frame};"] if self._guarded else []
        for n in by_pointer(f):
            c_name, place = self.c_name(n), self._place(n)
            copied = f"memcpy({place}, {c_name}, sizeof {c_name})" if f.shapes[n] else f"*{place} = {c_name}"
            parts.append(f"if ({place}) {{ {copied}; }}")
        if returns_value(f):
            parts.append(f"return {self.c_name(f.outputs[0])};")
        else:
            parts.append("return;")
        return " ".join(parts)

    def _refuse(self) -> str:
        """Statements that return NaN without having begun."""
        f = self._f
        parts = [f"if ({self._place(n)}) {{ *{self._place(n)} = {_nothing(f, n)}; }}" for n in by_pointer(f)]
        return " ".join([*parts, f"return {_nothing(f, f.outputs[0])};" if returns_value(f) else "return;"])

    def _fail(self, kind: str, index: int = -1) -> str:
        """Note a failure and return NaN everywhere."""
        parts = [f"(void)mdl_fail((mdl_data *)m, MDL_FAILURE_{kind}, {index}, 0.0);"]
        for n in self._f.outputs:
            target = self.c_name(n) + ("[0]" if self._f.shapes[n] else "")
            parts.append(f"{target} = {_nothing(self._f, n)};")
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

    def _round(self) -> str:
        return f"if (++((mdl_data *)m)->rounds > {ROUNDS}) {{ {self._fail('LOOP', self._end)} }}"

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
                self._block(f"while ({self._text(s.condition)})", s.body, self._round())
            case flat.For():
                self._for(s)
            case flat.Native():
                places = [("" if self._f.shapes[n] else "&") + self.c_name(n) for n in s.outputs]
                self._line(f"mdl_{s.function}({', '.join([*map(self.c_name, s.inputs), *places])});")
            case flat.Foreign():
                for line in foreign_lines(s, self._f, self.c_name, self._fail("FOREIGN")):
                    self._line(line)
            case flat.Return():
                self._line(self._leave())
            case flat.Break():
                self._line("break;")
            case flat.Assert():
                if s.level == "error":
                    failure = self._fail("ASSERT", self._assert_index(s))
                    self._line(f"if (!({self._text(s.condition)})) {{ {failure} }}")
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
        """The range is evaluated once, before the loop and its variable begin (Modelica 3.6, 11.2.2)."""
        i, range_ = self.c_name(s.variable), {"first": s.first, "last": s.last, "step": s.step}
        kept = {what: self._names.identifier(f"{s.variable} {what}") for what, e in range_.items() if not is_const(e)}
        if kept:
            self._line("{")
            self._depth += 1
        for what, name in kept.items():
            self._line(f"const double {name} = {self._text(range_[what])};")
        first, last, step = (kept.get(what) or self._text(e) for what, e in range_.items())
        if is_const(s.step):
            test = f"{i} {'<=' if s.step.value > 0 else '>='} {last}"
        else:
            test = f"({step}) > 0.0 ? {i} <= {last} : {i} >= {last}"
        self._block(f"for (double {i} = {first}; {test}; {i} += {step})", s.body, self._round())
        if kept:
            self._depth -= 1
            self._line("}")

    # -- expressions ------------------------------------------------------------------------------------------

    def _text(self, e: Expr) -> str:
        return to_c(lower_powers(e, self._lowered), self._lookup, doubts=self._doubts)

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


def _nothing(f: flat.Function, name: str) -> str:
    """What a result is where the function failed."""
    return "0" if c_type(f, name) == "int" else "NAN"


def declarations(f: flat.Function, names: Names) -> tuple[list[str], list[str]]:
    """(declarations, identifiers) of the arguments of the C function."""
    identifiers = [names.identifier(n) for n in f.inputs]
    stars = ["*" if f.shapes[n] else "" for n in f.inputs]
    declared = [f"const {c_type(f, n)} {s}{c}" for n, s, c in zip(f.inputs, stars, identifiers, strict=True)]
    return ["const mdl_data *m", *declared], identifiers


def c_type(f: flat.Function, name: str) -> str:
    """Numbers, and elements of any array, are double; a Boolean is int."""
    return "int" if f.types[name] == BOOLEAN and not f.shapes[name] else "double"


def returns_value(f: flat.Function) -> bool:
    return len(f.outputs) == 1 and not f.shapes[f.outputs[0]]


def by_pointer(f: flat.Function) -> tuple[str, ...]:
    """Results that are handed over through pointers."""
    return () if returns_value(f) else f.outputs


def c_function(f: flat.Function) -> str:
    """The C function that gives all results."""
    return function_name(f.name, whole=not returns_value(f))
