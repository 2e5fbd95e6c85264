"""Functions that must run at run time: their bodies as statements over scalars and arrays of fixed size."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.equations.asserts import lower_assert
from lacuna.codegen.flatten.equations.effects import effect
from lacuna.codegen.flatten.expressions.constants import AtRunTime, evaluate
from lacuna.codegen.flatten.expressions.elements import element, local_value
from lacuna.codegen.flatten.expressions.lower import lower, lower_results, lower_scalar
from lacuna.codegen.flatten.functions.interpret import unknown_target
from lacuna.codegen.flatten.functions.locals import Signature, declared_sizes, fit, typed
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Record, Value, indices, scalars, shape_of, shape_text
from lacuna.codegen.flatten.references.iterators import iterate
from lacuna.codegen.flatten.references.references import apply_subscripts
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, FALSE, INTEGER, REAL, TRUE, Expr
from lacuna.codegen.symbolic.rewrite import Rewriter
from lacuna.codegen.syntax import ast

DONE = "done"  # the result of a function that has none


@dataclass
class Source:
    """What a kept function was made of, to run it on constants: result number `output`, its scalar `element`."""

    signature: Signature
    inputs: tuple[str, ...]
    shapes: dict[str, tuple[int, ...]]
    output: int
    element: int


class Sources(dict[str, Source]):
    """Of the kept functions, by their names."""


def is_done(value: Value, context: Context) -> bool:
    """Does `value` only say that a function without results has run?"""
    called = context.functions.get(str(value.value)) if isinstance(value, Expr) and value.op == "call" else None
    return called is not None and called.outputs == (DONE,)


def emitted_call(signature: Signature, arguments: dict[str, Value], context: Context, span: Span) -> list[Value]:
    """Calls that give the results of the function, one for each scalar of each result."""
    base = _base(signature, arguments, context, span)
    function = context.functions[base]
    call_arguments = [ex.array(*v.items) if isinstance(v, Array) else v for v in arguments.values()]
    units = {DONE: "", **{d.name: d.unit for d in signature.locals}}
    context.function_units[base] = units[function.outputs[0]] if function.outputs else ""
    results: list[Value] = []
    for number, name in enumerate(function.outputs):
        shape, kind = function.shapes[name], function.types[name]
        if number == 0 and not shape:
            results.append(ex.call(base, *call_arguments, type=kind))
            continue
        items = []
        for position, index in enumerate(indices(shape) if shape else [()]):
            selected = _selected(function, signature, name, number, position, index, units[name], context)
            items.append(ex.call(selected, *call_arguments, type=kind))
        results.append(Array(shape, tuple(items)) if shape else items[0])
    return results


def _selected(
    function: flat.Function, signature: Signature, name: str, number: int, position: int, index: tuple[int, ...],
    unit: str, context: Context,
) -> str:  # fmt: skip
    """A function that calls `function` and gives one scalar of one of its results."""
    text = "[" + ",".join(map(str, index)) + "]" if index else ""
    selected = f"{function.name}.{name}{text}"
    if selected in context.functions:
        return selected
    kind, shape = function.types[name], function.shapes[name]
    call = ex.call(function.name, *(_argument(i, function) for i in function.inputs), type=kind)
    targets = tuple(n if n == name else None for n in function.outputs)
    picked = element(name, kind, tuple(map(ex.const, index))) if index else ex.var(name, kind)
    inputs = {n: function.shapes[n] for n in function.inputs}
    types = {n: function.types[n] for n in function.inputs}
    context.functions[selected] = flat.Function(
        selected, function.inputs, ("result",), {**inputs, name: shape, "result": ()},
        {**types, name: kind, "result": kind}, {},
        [flat.AssignCall(targets, call, function.span), flat.Assign("result", picked, function.span)], function.span,
    )  # fmt: skip
    context.table(Sources)[selected] = Source(signature, function.inputs, inputs, number, position)
    context.function_units[selected] = unit
    return selected


def _argument(name: str, function: flat.Function) -> Expr:
    value = local_value(name, function.types[name], function.shapes[name])
    return ex.array(*value.items) if isinstance(value, Array) else value


def _base(signature: Signature, arguments: dict[str, Value], context: Context, span: Span) -> str:
    cls = signature.cls
    shapes = {n: shape_of(v) for n, v in arguments.items()}
    sizes = ",".join("x".join(map(str, s)) for s in shapes.values() if s)
    name = f"{cls.path}[{sizes}]" if sizes else cls.path
    if name not in context.functions:
        for n, v in arguments.items():
            if isinstance(v, Record) or any(isinstance(s, str) for s in scalars(v)):
                what = "record" if isinstance(v, Record) else "String"
                hint = "give its fields one by one" if what == "record" else "decide by an enumeration or a Boolean"
                raise Diagnostic("F036", f"{cls.name} has the {what} input {n} and runs at run time", span, hint)
        _emit(name, signature, shapes, context, span)
    return name


def _emit(name: str, signature: Signature, shapes: dict[str, tuple[int, ...]], context: Context, span: Span) -> None:
    cls, inputs = signature.cls, tuple(shapes)
    outputs = tuple(d.name for d in signature.outputs) or (DONE,)
    function = flat.Function(name, inputs, outputs, {}, {}, {}, [], cls.span)
    context.functions[name] = function
    context.table(Sources)[name] = Source(signature, inputs, shapes, 0, 0)
    writer = _Writer(function, Scope(context, cls, None, {}, in_function=True))
    try:
        for d in signature.locals:
            if d.type.primitive not in (REAL, INTEGER, BOOLEAN):
                hint = "use scalars and arrays in functions with loops of unknown length"
                raise Diagnostic("F036", f"{d.name} is no number or Boolean", d.declaration.span, hint)
            scope = replace(d.scope, locals=writer.scope.locals)
            shape = shapes.get(d.name)
            default = d.declaration.modification.value
            writer.declare(d.name, d.type.primitive, declared_sizes(d, scope, None) if shape is None else shape)
            if shape is None and default is not None:
                value = fit(d, lower(default, scope), scope, default.span)
                writer.assign([((d.name, None), value)], default.span, function.body)
        if not signature.outputs:
            writer.declare(DONE, BOOLEAN, ())
            function.defaults[DONE] = TRUE
        if cls.external is not None:
            order = [str(a) for a in cls.external.args]
            given, wanted = (tuple(n for n in order if (n in inputs) == asked) for asked in (True, False))
            function.body.append(flat.Native(cls.external.function, given, wanted, cls.span))
        function.body += writer.block(signature.body)
        function.body = Rewriter(lambda e: _package_constant(e, context, span)).statements(function.body)
    except AtRunTime as reason:
        del context.functions[name], context.table(Sources)[name]
        message = f"in {cls.name}, {reason.args[0]} depends on an argument's value"
        error = Diagnostic("F036", message, span, "sizes may depend on the sizes of arguments, not on their values")
        error.notes.append((reason.args[1], "here"))
        raise error from None


def _package_constant(e: Expr, context: Context, span: Span) -> Expr | None:
    """The value of a constant of a package, which only models keep as a variable; local names have no dot."""
    entry = context.scalars.get(str(e.value)) if e.op == "var" and "." in str(e.value) else None
    return evaluate(e, context, span) if entry is not None and entry[0].variability == "constant" else None


class _Writer:
    """Statements of one function; a target is (name, subscripts as values or None for all of it)."""

    def __init__(self, function: flat.Function, scope: Scope) -> None:
        self.function, self.scope = function, scope
        self.counter = 0

    def declare(self, name: str, kind: str, shape: tuple[int, ...]) -> None:
        self.function.shapes[name], self.function.types[name] = shape, kind
        self.scope.locals[name] = local_value(name, kind, shape)

    def block(self, items: Sequence[ast.Item]) -> list[flat.Statement]:
        result: list[flat.Statement] = []
        for item in items:
            self._item(item, result)
        return result

    def _item(self, item: ast.Item, result: list[flat.Statement]) -> None:
        if isinstance(item, ast.Assignment):
            self._assignment(item, result)
        elif isinstance(item, ast.If):
            self._if(item, result)
        elif isinstance(item, ast.For):
            self._for(item, list(item.iterators), result)
        elif isinstance(item, ast.While):
            condition = lower_scalar(item.condition, self.scope, BOOLEAN)
            result.append(flat.While(condition, self.block(item.body), item.span))
        elif isinstance(item, ast.Break):
            result.append(flat.Break(item.span))
        elif isinstance(item, ast.Return):
            result.append(flat.Return(item.span))
        elif isinstance(item, ast.Procedure) and str(item.call.function) == "assert":
            result.append(lower_assert(item.call, self.scope))
        elif isinstance(item, ast.Procedure):
            result += effect(item, self.scope)
        else:
            what = type(item).__name__.lower()
            raise Diagnostic("R059", f"'{what}' in a function", item.span, "functions compute values only")

    def _if(self, item: ast.If, result: list[flat.Statement]) -> None:
        branches = []
        for written, body in item.branches:
            condition = TRUE if written is None else lower_scalar(written, self.scope, BOOLEAN)
            if condition is not FALSE:
                branches.append((condition, self.block(body)))
            if condition is TRUE:
                break
        if branches and branches[0][0] is TRUE:
            result += branches[0][1]
        elif branches:
            result.append(flat.If(branches, item.span))

    def _for(self, item: ast.For, iterators: list[ast.Iterator], result: list[flat.Statement]) -> None:
        """Over a range the loop is kept; over an array it is unrolled."""
        if not iterators:
            result += self.block(item.body)
            return
        first, *rest = iterators
        outer = self.scope
        bounds = first.range
        if isinstance(bounds, ast.Range):
            low, high = (lower_scalar(b, outer, INTEGER) for b in (bounds.first, bounds.last))
            step = lower_scalar(bounds.step, outer, INTEGER) if bounds.step else ex.const(1)
            name = first.name if first.name not in self.function.types else self._fresh(first.name)
            self.scope = outer.with_locals(**{first.name: ex.var(name, INTEGER)})
            body: list[flat.Statement] = []
            self._for(item, rest, body)
            result.append(flat.For(name, low, step, high, body, item.span))
        else:
            for value in iterate(first, outer, item.body):
                self.scope = outer.with_locals(**{first.name: value})
                self._for(item, rest, result)
        self.scope = outer

    def _fresh(self, stem: str) -> str:
        self.counter += 1
        return f"{stem}_{self.counter}"

    def _assignment(self, item: ast.Assignment, result: list[flat.Statement]) -> None:
        if not isinstance(item.target, ast.Tuple):
            self.assign([(self._target(item.target), lower(item.value, self.scope))], item.span, result)
            return
        values = lower_results(item.value, self.scope)
        pairs = zip(item.target.items, values, strict=False)
        self.assign([(self._target(t), v) for t, v in pairs if t is not None], item.span, result)

    def _target(self, ref: ast.Ref) -> tuple[str, Value | None]:
        if len(ref.names) > 1:
            raise Diagnostic("F036", "records in a function that runs at run time", ref.span, "use scalars and arrays")
        if ref.names[0] not in self.function.types:
            raise unknown_target(ref, self.function.types)
        if ref.names[0] in self.function.inputs:
            raise Diagnostic("R058", f"the input {ref.names[0]} is assigned", ref.span, "copy it to a variable first")
        if ref.subscripts[0] is None:
            return ref.names[0], None
        whole = self.scope.locals[ref.names[0]]
        return ref.names[0], apply_subscripts(whole, ref.subscripts[0], self.scope, ref)

    def assign(
        self, pairs: list[tuple[tuple[str, Value | None], Value]], span: Span, result: list[flat.Statement]
    ) -> None:
        """All targets at once: values that read what is assigned go through temporary variables."""
        steps: list[tuple[Expr, Expr]] = []
        for (name, part), value in pairs:
            old = self.scope.locals[name] if part is None else part
            if shape_of(old) != shape_of(value) or isinstance(value, Record):
                message = f"{name}: {shape_text(shape_of(old))} := {shape_text(shape_of(value))}"
                raise Diagnostic("R042", f"the sides differ in size: {message}", span, "both need the same size")
            steps += zip(scalars(old), scalars(value), strict=True)
        steps = [(t, typed(v, t.type, ex.to_text(t), span)) for t, v in steps]
        if len(steps) > 1 and any(self._reads(v, pairs) for _, v in steps):
            temporary = self._fresh("before")
            self.declare(temporary, steps[0][0].type, (len(steps),))
            copies = scalars(self.scope.locals[temporary])
            result += [_store(copy, value, span) for copy, (_, value) in zip(copies, steps, strict=True)]
            steps = [(target, copy) for (target, _), copy in zip(steps, copies, strict=True)]
        result += [_store(target, value, span) for target, value in steps]

    @staticmethod
    def _reads(value: Expr, pairs: list[tuple[tuple[str, Value | None], Value]]) -> bool:
        names = {name for (name, _), _ in pairs}
        return any(n.op == "var" and n.value in names for n in ex.walk(value))


def _store(target: Expr, value: Expr, span: Span) -> flat.Statement:
    if target.op == "var":
        return flat.Assign(str(target.value), value, span)
    return flat.AssignElement(str(target.args[0].value), target.args[1:], value, span)
