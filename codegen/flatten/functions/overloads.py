"""Operators of operator records: which function an expression means (Modelica 3.6, chapter 14)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.restrictions import check_class
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.functions.declared import bind_arguments, call_function, written_arguments
from lacuna.codegen.flatten.functions.locals import Local, signature_of
from lacuna.codegen.flatten.names.scope import Scope, base_classes, own_or_inherited
from lacuna.codegen.flatten.names.values import (
    Array,
    Record,
    Value,
    fold,
    items_of,
    shape_of,
    shape_text,
    stack,
    transpose,
)
from lacuna.codegen.symbolic.expr import INTEGER, REAL, Expr
from lacuna.codegen.syntax import ast

_OF_ARRAYS = ("+", "-", ".+", ".-", ".*", "./", ".^")  # element by element, whatever the elements are (10.6)
CONSTRUCTOR, TEXT = "'constructor'", "'String'"
_OPERANDS = {"'not'": (1,), "'-'": (1, 2), "'0'": (0,), TEXT: (1,)}  # other operators have two (14.5, 14.6)


def operator_record(value: Value, scope: Scope) -> ast.Class | None:
    """The operator record that `value`, or each element of it, is of: by any name, as connector V = input Complex."""
    first = next(iter(items_of(value)), None)
    cls = first.cls if isinstance(first, Record) else None
    plain = _declared(cls, scope)
    return cls if isinstance(plain, ast.Class) and plain.operator else None


def overloaded(op: str, operands: Sequence[Value], span: Span, scope: Scope) -> Value:
    """The value of an operator of which one operand at least is an operator record. Raises R079."""
    classes = [cls for cls in (operator_record(v, scope) for v in operands) if cls is not None]
    if op.startswith(".") and any(map(shape_of, operands)):
        return _element_by_element(op, operands, span, scope)  # never a product of whole arrays (10.6.2)
    found = _call_one(f"'{op}'", classes, operands, span, scope)
    if found is None and len(operands) == 2:
        found = _converted(f"'{op}'", operands, span, scope)
    if found is not None:
        return found
    if any(map(shape_of, operands)):
        return _element_by_element(op, operands, span, scope)
    if not classes:
        hint = "make it an operator record, or name its fields"
        raise Diagnostic("R079", f"a record has no operator {op}", span, hint)
    hint = f"declare an operator '{op}' for these operands in {classes[0].name}"
    raise Diagnostic("R079", f"{classes[0].name} has no operator {op} for these operands", span, hint)


def _element_by_element(op: str, operands: Sequence[Value], span: Span, scope: Scope) -> Value:
    """The rules for arrays of numbers, applied to arrays of operator records (10.6)."""
    if op == "*" and all(map(shape_of, operands)):
        return _product(operands[0], operands[1], span, scope)
    shapes = {shape_of(v) for v in operands if shape_of(v)}
    with_scalar = any(not shape_of(v) for v in operands)
    elementwise = op in _OF_ARRAYS or (op in ("*", "/") and with_scalar and not (op == "/" and shape_of(operands[1])))
    if len(shapes) != 1 or not elementwise or (op in ("+", "-") and with_scalar and len(operands) == 2):
        raise Diagnostic("R079", f"{op} of arrays of records of these sizes", span, "write a loop over the elements")
    shape = shapes.pop()
    count = len(next(v.items for v in operands if isinstance(v, Array)))
    columns = [v.items if isinstance(v, Array) else (v,) * count for v in operands]
    plain = op.removeprefix(".")
    items = [overloaded(plain, row, span, scope) for row in zip(*columns, strict=True)]
    return Array(shape, items_of(stack(items, span))) if items else Array(shape, ())


def _product(a: Array, b: Array, span: Span, scope: Scope) -> Value:
    """The product of vectors or matrices, one at least of operator records, by their '*' and '+' (10.6.3)."""
    if a.shape[-1] != b.shape[0] or max(len(a.shape), len(b.shape)) > 2 or not a.shape[-1]:
        message = f"a product of sizes {shape_text(a.shape)} and {shape_text(b.shape)}"
        raise Diagnostic("R079", message, span, "inner sizes must agree; .* multiplies element by element")

    def dot(row: Array, column: Array) -> Value:
        terms = [overloaded("*", pair, span, scope) for pair in zip(row.items, column.items, strict=True)]
        return fold(lambda x, y: overloaded("+", [x, y], span, scope), terms)

    rows = a.rows() if len(a.shape) == 2 else [a]
    columns = transpose(b).rows() if len(b.shape) == 2 else [b]
    items = tuple(dot(row, column) for row in rows for column in columns)
    return Array(a.shape[:-1] + b.shape[1:], items) if a.shape[:-1] + b.shape[1:] else items[0]


def _converted(name: str, operands: Sequence[Value], span: Span, scope: Scope) -> Value | None:
    """With the operand that is no operator record made one by its constructor (14.4)."""
    results = []
    for k, cls in enumerate(operator_record(v, scope) for v in operands):
        other = operands[1 - k]
        if cls is None or operator_record(other, scope) is not None:
            continue
        made = _call_one(CONSTRUCTOR, [cls], [other], span, scope) if not shape_of(other) else None
        if made is not None:
            both = (operands[0], made) if k == 0 else (made, operands[1])
            results.append(_call_one(name, [cls], both, span, scope))
    return next((r for r in results if r is not None), None)


def construct(cls: ast.Class, e: ast.Call, scope: Scope) -> Value:
    """A call of a record: by a constructor that it declares and that fits, else by its fields (14.3)."""
    if not (cls.origin or cls).operator or own_or_inherited(scope.context.library, cls, CONSTRUCTOR) is None:
        return _from_fields(cls, e, scope)
    values = [lower(a, scope) for a in e.args]
    named = {name: lower(value, scope) for name, value in e.named.items()}
    arrays = [v for v in (*values, *named.values()) if shape_of(v)]
    found = _call_one(CONSTRUCTOR, [cls], values, e.span, scope, named)
    if found is None and arrays and not named:
        rows = [v.items if isinstance(v, Array) else (v,) * len(arrays[0].items) for v in values]
        each = [_call_one(CONSTRUCTOR, [cls], row, e.span, scope) for row in zip(*rows, strict=True)]
        if all(made is not None for made in each):
            return Array(arrays[0].shape, tuple(each))
    if found is None:
        hint = f"declare a function for it in {cls.name}.{CONSTRUCTOR}, or give what one of them takes"
        raise Diagnostic("R079", f"no constructor of {cls.name} takes these arguments (14.3)", e.span, hint)
    return found


def _from_fields(cls: ast.Class, e: ast.Call, scope: Scope) -> Value:
    """Record(a, field = b): fields by position and name, the rest by their defaults, final ones always (12.6); or
    Record(component): the elements of those names (12.6.1)."""
    declared = signature_of(cls, scope.context).locals
    kept = [f for f in declared if f.declaration.variability != "constant" or f.declaration.modification.value is None]
    fields = [replace(f, scope=replace(f.scope, in_function=scope.in_function)) for f in kept]
    free = [f for f in fields if not (f.declaration.final and f.declaration.modification.value is not None)]
    written = written_arguments(cls, free, e, scope, {})
    whole = written[free[0].name][0] if len(e.args) == 1 and not e.named and free[0].type.primitive else None
    if whole is not None and items_of(whole) and all(isinstance(item, Record) for item in items_of(whole)):
        made = [_cast(cls, item, e.span, scope) for item in items_of(whole)]
        return stack(made, e.span) if isinstance(whole, Array) else made[0]
    return Record(cls.path, bind_arguments(cls, fields, written, e, scope), cls)


def _cast(cls: ast.Class, whole: Record, span: Span, scope: Scope) -> Record:
    """The fields of a record taken from what has elements of their names."""
    fields: dict[str, Value] = {}
    for local in signature_of(cls, scope.context).locals:
        if local.name not in whole.fields:
            hint = "give the fields by their names"
            raise Diagnostic("R050", f"{whole.name} has no element {local.name} of {cls.name}", span, hint)
        value = whole.fields[local.name]
        nested = local.type.cls if local.type.primitive is None else None
        fields[local.name] = _cast(nested, value, span, scope) if nested and isinstance(value, Record) else value
    return Record(cls.path, fields, cls)


def text_by_operator(value: Record, e: ast.Call, scope: Scope) -> Value | None:
    """String(value, ...) by the operator 'String' of its record (14.4); None where it has none."""
    cls = operator_record(value, scope)
    if cls is None:
        return None
    named = {name: lower(option, scope) for name, option in e.named.items()}
    return _call_one(TEXT, [cls], [value, *(lower(a, scope) for a in e.args[1:])], e.span, scope, named)


def _call_one(
    name: str, classes: Sequence[ast.Class], values: Sequence[Value], span: Span, scope: Scope,
    named: dict[str, Value] | None = None,
) -> Value | None:  # fmt: skip
    """The result of the one function of operator `name` that fits; None where there is none. Raises R079 for two."""
    fitting: list[tuple[ast.Class, dict[str, Value]]] = []
    for f in _functions(name, classes, scope):
        _check_inputs(name, f, classes[0], span, scope)
        bound = _bound(signature_of(f, scope.context).inputs, values, named or {}, scope)
        if bound is not None and all((f.origin or f) is not (g.origin or g) for g, _ in fitting):
            fitting.append((f, bound))
    if not fitting:
        return None
    if len(fitting) > 1:
        message = f"{' and '.join(f.name for f, _ in fitting)} of the operator {name} both fit"
        raise Diagnostic("R079", message, span, "call the one that is meant by its name")
    function, bound = fitting[0]
    _check_results(name, function, classes[0], span, scope)
    call = ast.Call(span, ast.Ref(span, (function.name,), (None,)), [], {})
    results = call_function(function, call, scope, bound)
    if not results:
        hint = "a constructor gives its result by its fields: output R result(x = x)"
        raise Diagnostic("R079", f"{function.name} of {name} calls itself for its result", function.span, hint)
    return results[0]


def _functions(name: str, classes: Sequence[ast.Class], scope: Scope) -> Iterator[ast.Class]:
    library = scope.context.library
    for cls in classes:
        operator = own_or_inherited(library, cls, name)
        if operator is None:
            continue
        check_class(operator, scope.context)
        if operator.kind == "function":
            yield operator
            continue
        for inner in library.members(operator):
            found = own_or_inherited(library, operator, inner)
            if found is not None and found.kind == "function":
                yield found


def _check_inputs(name: str, function: ast.Class, cls: ast.Class, span: Span, scope: Scope) -> None:
    """Operands have no default value, what comes after them has one (14.5, 14.6); a constructor has any inputs, but
    two records are not made of each other (14.3)."""
    inputs = signature_of(function, scope.context).inputs
    open_ended = [i.declaration.modification.value is None for i in inputs]
    operands = open_ended.index(False) if False in open_ended else len(open_ended)
    if name == CONSTRUCTOR:
        if open_ended.count(True) == 1:
            _refuse_both_ways(function, inputs[open_ended.index(True)], cls, span, scope)
        return
    if operands not in _OPERANDS.get(name, (2,)) or True in open_ended[operands:]:
        wanted = " or ".join(map(str, _OPERANDS.get(name, (2,))))
        hint = f"the operator {name} has {wanted} inputs without default, and further ones with"
        message = f"{function.name} of the operator {name} of {cls.name} has {operands} operands"
        raise Diagnostic("R079", message, function.span, hint)


def _refuse_both_ways(function: ast.Class, given: Local, cls: ast.Class, span: Span, scope: Scope) -> None:
    """Raises R079 where the record that `function` makes a `cls` of can be made of a `cls`, too."""
    other = given.type.cls
    if other is None or not (other.origin or other).operator or _declared(other, scope) is _declared(cls, scope):
        return
    for back in _functions(CONSTRUCTOR, [other], scope):
        inputs = [i for i in signature_of(back, scope.context).inputs if i.declaration.modification.value is None]
        if len(inputs) == 1 and _declared(inputs[0].type.cls, scope) is _declared(cls, scope):
            message = f"{cls.name} is made of {other.name}, and {other.name} of {cls.name}"
            error = Diagnostic("R079", message, function.span, "remove one of the two constructors (14.3)")
            error.notes.append((back.span, "the other one"))
            raise error


def _check_results(name: str, function: ast.Class, cls: ast.Class, span: Span, scope: Scope) -> None:
    """One result; of a constructor the record, of 'String' a String (14.3, 14.4)."""
    outputs = signature_of(function, scope.context).outputs
    hint = "see chapter 14 of the specification"
    if len(outputs) != 1:
        raise Diagnostic("R079", f"{function.name} of {name} has {len(outputs)} results, not one", span, hint)
    result = outputs[0].type
    if name == TEXT and result.primitive != "String":
        raise Diagnostic("R079", f"the operator {name} of {cls.name} gives no String", span, hint)
    if name == CONSTRUCTOR and _declared(result.cls, scope) is not _declared(cls, scope):
        raise Diagnostic("R079", f"the constructor {function.name} of {cls.name} gives something else", span, hint)


def _declared(found: object, scope: Scope) -> object:
    """The class that a record is of, what is short for it and what it is seen from left out."""
    while isinstance(found, ast.Class) and found.alias is not None:
        bases = base_classes(scope.context.library, found)
        if not bases:
            break
        found = bases[0]
    return (found.origin or found) if isinstance(found, ast.Class) else found


def _bound(
    inputs: list[Local], values: Sequence[Value], named: dict[str, Value], scope: Scope
) -> dict[str, Value] | None:
    """Values by the names of the inputs, where they are a valid match: all given, of the right types and dimensions."""
    names = [i.name for i in inputs]
    bound = dict(zip(names, values, strict=False)) | named
    if len(values) > len(names) or len(bound) < len(values) + len(named) or not named.keys() <= set(names):
        return None
    for local in inputs:
        given = bound.get(local.name)
        if given is None:
            if local.declaration.modification.value is None:
                return None
        elif not _matches(local, given, scope):
            return None
    return bound


def _matches(local: Local, value: Value, scope: Scope) -> bool:
    if len(shape_of(value)) != len(local.declaration.dimensions) + len(local.type.dimensions):
        return False
    for item in items_of(value):
        if isinstance(item, Record):
            if local.type.cls is None or _declared(item.cls, scope) is not _declared(local.type.cls, scope):
                return False
        else:
            found = item.type if isinstance(item, Expr) else "String"
            if found != local.type.primitive and (local.type.primitive, found) != (REAL, INTEGER):
                return False
    return True
