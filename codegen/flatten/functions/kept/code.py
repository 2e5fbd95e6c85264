"""Functions that must run at run time: their bodies as statements over scalars and arrays of fixed size."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import AtRunTime, evaluate
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.functions.interpret import interpret
from lacuna.codegen.flatten.functions.kept.function_arguments import FunctionArguments, split
from lacuna.codegen.flatten.functions.kept.parts import matched, parts, rebuilt, variables_of
from lacuna.codegen.flatten.functions.kept.whole_calls import element_name
from lacuna.codegen.flatten.functions.kept.writer import Writer
from lacuna.codegen.flatten.functions.library.foreign import foreign_call
from lacuna.codegen.flatten.functions.library.random_numbers import GENERATORS
from lacuna.codegen.flatten.functions.locals import Local, Signature, signature_of
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.elements import element, local_value
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Value, indices, scalars, shape_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.annotated import OP
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, TRUE, Expr
from lacuna.codegen.symbolic.rewrite import Rewriter
from lacuna.codegen.syntax import ast

DONE = "done"  # the result of a function that has none


@dataclass
class Source:
    """What a kept function was made of, to run it on constants: part number `output` of its results, its scalar
    `element`. Inputs and results are built of variables of the function."""

    signature: Signature
    inputs: dict[str, Value]
    fixed: dict[str, Value]  # arguments that it is made for: what sizes follow from
    functions: FunctionArguments  # those among its arguments; what they have bound is among the inputs
    results: list[Value]
    output: int = 0
    element: int = 0


class Sources(dict[str, Source]):
    """Of the kept functions, by their names."""


def run(name: str, arguments: list[Expr], context: Context, span: Span) -> Expr:
    """A kept function on constant arguments: its (first) result as a constant."""
    source = context.table(Sources)[name]
    variables = [v for n, whole in source.inputs.items() for v in parts(n, whole).values()]
    given = (Array(v.shape, a.args) if isinstance(v, Array) else a for v, a in zip(variables, arguments, strict=True))
    known = {n: rebuilt(whole, given) for n, whole in source.inputs.items()}
    bound = source.fixed | known | source.functions.values(known)
    try:
        results = interpret(source.signature, {i.name: bound[i.name] for i in source.signature.inputs}, context, span)
    except AtRunTime as reason:
        message = f"{name} cannot be evaluated at translation: {reason.args[0]}"
        raise Diagnostic("F021", message, span, "give it constants and parameters only") from None
    found = [part for result in results for part in parts("", result).values()]
    return scalars(found[source.output])[source.element]


def is_done(value: Value, context: Context) -> bool:
    """Does `value` only say that a function without results has run?"""
    called = context.functions.get(str(value.value)) if isinstance(value, Expr) and value.op == "call" else None
    return called is not None and called.outputs == (DONE,)


def run_or_emit(cls: ast.Class, arguments: dict[str, Value], context: Context, span: Span) -> list[Value]:
    """The results of a function of our own: evaluated where all is constant, else computed at run time."""
    signature = signature_of(cls, context)
    if all(isinstance(s, Expr) and s.op == "const" for v in arguments.values() for s in scalars(v)):
        return interpret(signature, arguments, context, span)
    return emitted_call(signature, arguments, context, span)


def emitted_call(signature: Signature, arguments: dict[str, Value], context: Context, span: Span) -> list[Value]:
    """Calls that give the results of the function, one for each scalar of each result."""
    functions = split(signature, arguments, context)
    arguments = {n: v for n, v in arguments.items() if n not in functions.functions} | functions.bound
    base = _base(signature, arguments, functions, context, span)
    function, source = context.functions[base], context.table(Sources)[base]
    call_arguments = [
        ex.array(*v.items) if isinstance(v, Array) else v for v in _matching(source.inputs, arguments, span)
    ]
    units = {DONE: "", **{d.name: d.unit for d in signature.locals}}
    context.function_units[base] = units.get(function.outputs[0], "") if function.outputs else ""
    own = [_argument(i, function) for i in function.inputs]
    results: list[Value] = []
    for number, name in enumerate(function.outputs):
        shape, kind = function.shapes[name], function.types[name]
        if number == 0 and not shape:
            results.append(ex.call(base, *call_arguments, type=kind))
            continue
        items = []
        for position, index in enumerate(indices(shape) if shape else [()]):
            chosen = replace(source, output=number, element=position)
            selected = _selected(function, own, chosen, name, index, units.get(name, ""), context)
            items.append(ex.call(selected, *call_arguments, type=kind))
        results.append(Array(shape, tuple(items)) if shape else items[0])
    found = iter(results)
    return [rebuilt(result, found) for result in source.results]


def _matching(inputs: dict[str, Value], arguments: dict[str, Value], span: Span) -> list[Value]:
    """The parts of the arguments in the order of the inputs' variables."""
    found: list[Value] = []
    for name, variable in inputs.items():
        scalars_of = iter([value for _, value in matched(variable, arguments[name], name, span)])
        for part in parts(name, variable).values():
            items = tuple(next(scalars_of) for _ in scalars(part))
            found.append(Array(part.shape, items) if isinstance(part, Array) else items[0])
    return found


def _selected(
    function: flat.Function, own: list[Expr], source: Source, name: str, index: tuple[int, ...], unit: str,
    context: Context,
) -> str:  # fmt: skip
    """A function that calls `function` with its inputs, `own`, and gives one scalar of one of its results."""
    selected = element_name(function.name, name, index)
    if selected in context.functions:
        return selected
    kind, shape = function.types[name], function.shapes[name]
    call = ex.call(function.name, *own, type=kind)
    targets = tuple(n if n == name else None for n in function.outputs)
    picked = element(name, kind, tuple(map(ex.const, index))) if index else ex.var(name, kind)
    inputs = {n: function.shapes[n] for n in function.inputs}
    types = {n: function.types[n] for n in function.inputs}
    result = "result" if "result" not in {name, *inputs} else f"element of {name}"  # which no variable can be called
    context.functions[selected] = flat.Function(
        selected, function.inputs, (result,), {**inputs, name: shape, result: ()},
        {**types, name: kind, result: kind}, {},
        [flat.AssignCall(targets, call, function.span), flat.Assign(result, picked, function.span)], function.span,
    )  # fmt: skip
    context.table(Sources)[selected] = source
    context.function_units[selected] = unit
    return selected


def _argument(name: str, function: flat.Function) -> Expr:
    value = local_value(name, function.types[name], function.shapes[name])
    return ex.array(*value.items) if isinstance(value, Array) else value


def _base(
    signature: Signature, arguments: dict[str, Value], functions: FunctionArguments, context: Context, span: Span
) -> str:
    """The name of the function made for arguments of these sizes, and anew for what its sizes follow; where its course
    follows whole numbers that are known, for each of them."""
    fixed = {n: v for n, v in arguments.items() if _is_fixed(signature, n, v)}
    try:
        return _made(signature, arguments, fixed, functions, context, span)
    except Diagnostic as error:
        whole = {n: v for n, v in arguments.items() if n not in fixed and _are_counts(v)}
        if error.code != "F036" or not whole:
            raise
        return _made(signature, arguments, fixed | whole, functions, context, span)


def _made(
    signature: Signature, arguments: dict[str, Value], fixed: dict[str, Value], functions: FunctionArguments,
    context: Context, span: Span,
) -> str:  # fmt: skip
    cls, kinds = signature.cls, {local.name: local.type for local in signature.inputs} | functions.kinds
    numbers = {n: v for n, v in arguments.items() if n not in fixed}
    inputs = {n: variables_of(n, kinds[n], v, context, span) for n, v in numbers.items()}
    shapes = [shape_of(v) for n, whole in inputs.items() for v in parts(n, whole).values()]
    sizes = ",".join("x".join(map(str, s)) for s in shapes if s)
    name = (f"{cls.path}[{sizes}]" if sizes else cls.path) + (f"({_listed(fixed)})" if fixed else "")
    name += f"({functions.names})" if functions.functions else ""
    if name not in context.functions:
        for n, v in numbers.items():
            if any(isinstance(s, str) for s in scalars(v)):
                hint = "decide by an enumeration or a Boolean"
                raise Diagnostic("F036", f"{cls.name} has the String input {n} and runs at run time", span, hint)
        _emit(name, Source(signature, inputs, fixed, functions, []), context, span)
    return name


def _is_fixed(signature: Signature, name: str, value: Value) -> bool:
    """Whether the function is made anew for each value of an input: texts of external C, and constants that decide
    sizes."""
    if isinstance(value, str):
        return _is_foreign(signature)
    items = scalars(value)
    return name in signature.sizing and bool(items) and all(isinstance(s, Expr) and s.op == "const" for s in items)


def _are_counts(value: Value) -> bool:
    items = scalars(value)
    return bool(items) and all(isinstance(s, Expr) and s.op == "const" and s.type == INTEGER for s in items)


def _listed(fixed: dict[str, Value]) -> str:
    return ", ".join(repr(s) if isinstance(s, str) else ex.to_text(s) for v in fixed.values() for s in scalars(v))


def _is_foreign(signature: Signature) -> bool:
    """Whether the function is external C that is not of the library."""
    return signature.external is not None and signature.external.external.function not in GENERATORS


def _emit(name: str, source: Source, context: Context, span: Span) -> None:
    signature, inputs, fixed = source.signature, source.inputs, source.fixed
    cls = signature.cls
    names = tuple(n for i, v in inputs.items() for n in parts(i, v))
    function = flat.Function(name, names, (), {}, {}, {}, [], cls.span)
    context.functions[name] = function
    context.table(Sources)[name] = source
    scope = signature.scope_of(dict(fixed), context)
    writer = Writer(function, scope)
    for bound in source.functions.bound:
        writer.declare(bound, inputs[bound])
    writer.scope.locals |= source.functions.values(inputs)
    try:
        for local in (x for x in signature.in_order if x.name not in writer.scope.locals):
            number = _settled(local, signature, writer.scope)
            if number is None:
                writer.declare_local(local, inputs)
            else:
                writer.scope.locals[local.name] = number
        if not signature.outputs:
            writer.declare(DONE, local_value(DONE, BOOLEAN, ()))
            function.defaults[DONE] = TRUE
        results = {d.name: writer.scope.locals[d.name] for d in signature.outputs} or {DONE: ex.var(DONE, BOOLEAN)}
        function.outputs = tuple(n for d, v in results.items() for n in parts(d, v))
        source.results = list(results.values())
        writer.begin()
        if _is_foreign(signature):
            function.body += foreign_call(signature, inputs | fixed, writer, span)
        elif signature.external is not None:
            external = signature.external.external
            order = [str(a) for a in external.args]
            given, wanted = (tuple(n for n in order if (n in inputs) == asked) for asked in (True, False))
            function.body.append(flat.Native(external.function, given, wanted, cls.span))
        function.body += writer.block(signature.body)

        def settled(e: Expr) -> Expr | None:
            if e.op == OP:  # nothing is differentiated by time in a function
                return constant.expression(e.args[0])
            return None if e.value in function.shapes else _package_constant(e, context, span)

        constant = Rewriter(settled)
        function.body = constant.statements(function.body)
    except AtRunTime as reason:
        del context.functions[name], context.table(Sources)[name]
        message = f"in {cls.name}, {reason.args[0]} depends on an argument's value"
        error = Diagnostic("F036", message, span, "sizes may depend on the sizes of arguments, not on their values")
        error.notes.append((reason.args[1], "here"))
        raise error from None


def _settled(local: Local, signature: Signature, scope: Scope) -> Expr | None:
    """The number of an Integer variable that its declaration gives and nothing assigns: sizes may follow it."""
    value = local.declaration.modification.value
    protected = local not in signature.inputs and local not in signature.outputs
    if value is None or not protected or local.declaration.dimensions or local.type.primitive != INTEGER:
        return None
    if local.name in set(_targets(signature.body)):
        return None
    number = lower(value, local.around_default(scope))
    return number if isinstance(number, Expr) and number.op == "const" and number.type == INTEGER else None


def _targets(items: Iterable[ast.Item]) -> Iterator[str]:
    """Names of the variables that statements assign."""
    for item in items:
        if isinstance(item, ast.Assignment):
            targets = item.target.items if isinstance(item.target, ast.Tuple) else [item.target]
            yield from (target.names[0] for target in targets if target is not None)
        elif isinstance(item, ast.For | ast.While):
            yield from _targets(item.body)
        elif isinstance(item, ast.If):
            yield from _targets(inner for _, body in item.branches for inner in body)


def _package_constant(e: Expr, context: Context, span: Span) -> Expr | None:
    """The value of a constant of a package, which only models keep as a variable; local names have no dot."""
    entry = context.scalars.get(str(e.value)) if e.op == "var" and "." in str(e.value) else None
    return evaluate(e, context, span) if entry is not None and entry[0].variability == "constant" else None
