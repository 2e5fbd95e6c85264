"""Calls in expressions: built-in operators, what the subset leaves out, functions and records of the model."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.classes.types import is_external
from lacuna.codegen.flatten.expressions.constants import is_known, known
from lacuna.codegen.flatten.expressions.enumerations import literal
from lacuna.codegen.flatten.expressions.lower import lower, lower_scalar
from lacuna.codegen.flatten.expressions.transport import OPERATOR, spatial_distribution
from lacuna.codegen.flatten.functions.declared import bind_arguments, call_function, written_arguments
from lacuna.codegen.flatten.functions.kept.code import is_done
from lacuna.codegen.flatten.functions.locals import differentiated, signature_of
from lacuna.codegen.flatten.names.component import Component
from lacuna.codegen.flatten.names.index_types import plain_type
from lacuna.codegen.flatten.names.scope import (
    Scope,
    base_class,
    base_classes,
    find_class,
    find_first,
    own_or_inherited,
    refuse_protected,
)
from lacuna.codegen.flatten.names.unknown import unknown_function
from lacuna.codegen.flatten.names.values import FunctionValue, Value, elementwise
from lacuna.codegen.flatten.names.views import constraints_of
from lacuna.codegen.flatten.references.references import refuse_conditional
from lacuna.codegen.library.classes import Library
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.differentiate import Differentiator
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, Expr
from lacuna.codegen.syntax import ast

_OUTSIDE = {  # clocks and state machines (chapters 16 and 17)
    "Clock": "use when sample(start, interval) then",
    "previous": "use pre(x) inside when sample(...)",
    "hold": "a discrete variable holds its value",
    "subSample": "use a second sample(...)",
    "superSample": "use a second sample(...)",
    "shiftSample": "use the start of sample(start, interval)",
    "backSample": "use the start of sample(start, interval)",
    "noClock": "clocks are left out",
    "interval": "use the parameter given to sample",
    "firstTick": "use initial(), or a discrete variable that counts",
    **dict.fromkeys(
        ("initialState", "transition", "activeState", "ticksInState", "timeInState"),
        "use the steps and transitions of Modelica.StateGraph, or an Integer that when-clauses set",
    ),
}


WORDS = frozenset((OPERATOR, "pure", "reinit", "assert", "terminate", *_OUTSIDE))  # no functions of a library
_OF_MODELS = ("initial", "terminal", "sample", "pre", "edge", "change")  # functions know no events (12.2)


def lower_call(e: ast.Call, scope: Scope) -> Value:
    """The value of a call; of several results the first."""
    name = str(e.function)
    handler = scope.context.lowering.functions.get(name.removeprefix(".")) if name not in scope.locals else None
    if handler is not None and not _is_hidden(e.function, scope):
        if scope.in_function and name.removeprefix(".") in _OF_MODELS:
            raise Diagnostic("R054", f"{name} in a function", e.span, "give its value as an argument")
        return handler(e, scope)
    results = call_of_model(e, scope)
    if not results or is_done(results[0], scope.context):
        raise Diagnostic("R004", f"{name} has no result", e.span, "call it as a statement of its own: f(x);")
    return results[0]


def _is_hidden(function: ast.Ref, scope: Scope) -> bool:
    """Whether a class that is declared or imported around the call hides the built-in function (5.3.1). Packages of the
    library are not looked through: each call of exp would read, and make the model depend on, the first of them."""
    if scope.cls is None:
        return False
    library = scope.context.library
    if function.absolute or len(function.names) > 1:
        return find_class(library, scope.cls, function) is not None
    return find_first(library, scope.cls, function.names[0], outermost=False) is not None


def call_of_model(e: ast.Call, scope: Scope) -> list[Value]:
    """All results of a function or record constructor declared in a model."""
    name = str(e.function)
    local = scope.locals.get(name)
    if name == OPERATOR and local is None and not _is_hidden(e.function, scope):
        return spatial_distribution(e, scope)
    if isinstance(local, FunctionValue):
        called = _partial_derivative if local.cls.derivative_of else call_function
        return called(local.cls, e, scope, local.bound)
    if name == "pure":
        return _taken_as_pure(e, scope)
    cls, holder = find_class(scope.context.library, scope.cls, e.function), scope.instance
    if cls is None:
        cls, holder = _of_component(e.function, scope)
    if cls is not None and cls.derivative_of is not None:
        return _partial_derivative(cls, e, scope, {})
    if cls is not None and cls.kind == "function":
        if cls.impure and scope.pure and not (scope.in_function and scope.context.library.foreign_package(e.span.file)):
            hint = f"call it when something happens (when ... then), or initially; or write pure({name}(...))"
            where = "an equation"
            if scope.in_function:  # the Modelica Standard Library does not keep to it: initializeImpureRandom
                where, hint = f"the pure function {scope.cls.name}", f"write impure before function {scope.cls.name}"
            raise Diagnostic("R082", f"the impure function {name} in {where}", e.span, hint)
        return call_function(cls, e, scope, _defaults_of(cls, e, holder, scope))
    if cls is not None and is_external(cls):
        return call_function(own_or_inherited(scope.context.library, cls, "constructor"), e, scope)
    if cls is not None and cls.kind == "record":
        return [scope.context.lowering.construct(cls, e, scope)]
    kind = plain_type(scope.context.library, cls) if cls is not None else None
    if kind is not None and kind.literals is not None:
        return [_literal_by_number(kind, e, scope)]
    if cls is not None:
        raise Diagnostic("R004", f"{name} is a {cls.kind} and cannot be called", e.function.span, "call a function")
    if name in _OUTSIDE or name.startswith("Connections."):
        hint = _OUTSIDE.get(name, "it stands alone in an equation section, under conditions known at translation only")
        raise Diagnostic("R091", f"{name} is outside the subset", e.function.span, hint)
    if name in ("reinit", "assert", "terminate"):
        raise Diagnostic("R004", f"{name} has no value", e.function.span, "it stands alone, ended by ';'")
    raise unknown_function(e.function, scope)


def _taken_as_pure(e: ast.Call, scope: Scope) -> list[Value]:
    """pure(f(x)): the results of an impure function where only pure ones may be called (12.3)."""
    if len(e.args) != 1 or e.named or not isinstance(e.args[0], ast.Call):
        raise Diagnostic("R050", "pure takes the call of a function", e.span, "pure(f(x))")
    return scope.context.lowering.results(e.args[0], replace(scope, pure=False))


def _literal_by_number(cls: ast.Class, e: ast.Call, scope: Scope) -> Expr:
    """E(n): the literal with that number, from 1 (4.9.5.3); of one that varies and is none, no value. Raises R045."""
    if len(e.args) != 1 or e.named:
        raise Diagnostic("R050", f"{cls.name} takes one number", e.span, f"{cls.name}(1)")
    number, count = lower_scalar(e.args[0], scope, INTEGER), len(cls.literals)
    if number.op != "const" and not is_known(number, scope.context):
        chosen = ex.nothing(INTEGER)
        for k in range(count, 0, -1):
            chosen = ex.if_else(ex.relation("==", number, ex.const(k)), literal(cls, k), chosen)
        return chosen
    found = int(known(number, scope, e.span, f"the number of a {cls.name}").value)
    if not 1 <= found <= count:
        hint = f"{cls.name} has the literals 1 to {count}"
        raise Diagnostic("R045", f"there is no literal {found} of {cls.name}", e.span, hint)
    return literal(cls, found)


def _defaults_of(cls: ast.Class, e: ast.Call, holder: Component | None, scope: Scope) -> dict[str, Value]:
    """Inputs that a short definition in the class of a component gives values: names there mean elements of it."""
    if cls.alias is None or holder is None or scope.in_function:
        return {}
    around = cls.parent or cls
    within = holder if _is_kind_of(holder.cls, around, scope.context.library) else None
    where = cls.written if isinstance(cls.written, Scope) else Scope(scope.context, around, within)
    open_ = {i.name for i in signature_of(cls, scope.context).inputs[len(e.args) :]} - set(e.named)
    found: dict[str, Value] = {}

    def take(tree: ast.Modification, where: Scope) -> None:
        for a in tree.arguments:
            if a.modification.value is not None and a.name in open_ - found.keys():
                found[a.name] = lower(a.modification.value, where)

    current: ast.Class | None = cls
    while current is not None and current.alias is not None and where.instance is not None:
        take(current.alias.modification, where)
        current = base_class(scope.context.library, current, current.alias.base, current.alias.modification)
        around = current.parent if current is not None else None
        same = around is not None and (around.origin or around) is (where.cls.origin or where.cls)
        where = replace(where, instance=where.instance if same else None)
    for tree, around in constraints_of(cls):
        take(tree, Scope(scope.context, around, holder))
    return found


def _is_kind_of(cls: ast.Class, other: ast.Class, library: Library) -> bool:
    """Whether `cls` is `other` or inherits from it."""
    same = (cls.origin or cls) is (other.origin or other)
    return same or any(_is_kind_of(base, other, library) for base in base_classes(library, cls))


def _of_component(ref: ast.Ref, scope: Scope) -> tuple[ast.Class | None, Component | None]:
    """The function that a component's class holds, as in a.f(x), and the component (5.3.2)."""
    node: object = scope.instance
    names = list(ref.names)
    while names and isinstance(node, Instance) and names[0] in node.elements:
        refuse_conditional(node, names[0], ref)
        node = node.meant(names.pop(0))
    if node is scope.instance or not isinstance(node, Instance):
        return None, None
    cls: ast.Class | None = node.cls
    for name in names:
        cls = _public_class(cls, name, ref, scope) if cls is not None else None
    return cls, node


def _public_class(cls: ast.Class, name: str, ref: ast.Ref, scope: Scope) -> ast.Class | None:
    """What `cls` holds under a name. Raises R017 where it is protected (4.1)."""
    found = own_or_inherited(scope.context.library, cls, name)
    if found is not None:
        refuse_protected(scope.context.library, cls, found, ref)
    return found


def _partial_derivative(cls: ast.Class, e: ast.Call, scope: Scope, given: dict[str, Value]) -> list[Value]:
    """A call of `function f = der(g, x, ...)` (12.7.2): g of variables in place of the arguments, differentiated."""
    function, (_, inputs) = differentiated(cls, scope.context), cls.derivative_of
    signature = signature_of(function, scope.context)
    written = written_arguments(function, signature.inputs, e, scope, given)
    arguments = bind_arguments(function, signature.inputs, written, e, scope)
    unknown = [n for n in inputs if not isinstance(arguments.get(n), Expr) or arguments[n].type == BOOLEAN]
    if unknown or len(signature.outputs) != 1:
        hint = "the function has one result, and the inputs are Real scalars"
        raise Diagnostic("R062", f"the derivative of {function.name} by {', '.join(inputs)}", e.span, hint)
    by = {n: ex.var(f"{cls.path}.{n}") for n in inputs}
    (value,) = call_function(function, replace(e, args=[], named={}), scope, {**arguments, **by})
    for name in inputs:
        rule = Differentiator(lambda n, x=by[name]: ex.ONE if n is x else ex.ZERO)
        value = elementwise(rule, [value], e.span, "a derivative")
    put = {by[n]: arguments[n] for n in inputs}
    return [elementwise(lambda x: ex.substitute(x, put), [value], e.span, "arguments")]
