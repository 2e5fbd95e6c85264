"""When-equations to the statements that run at the events."""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.equations.asserts import lower_assert, lower_message
from lacuna.codegen.flatten.equations.effects import effect
from lacuna.codegen.flatten.equations.equations import (
    check_target,
    check_types,
    equalities,
    origin_of,
    unroll_equations,
)
from lacuna.codegen.flatten.expressions.constants import is_known, variability
from lacuna.codegen.flatten.expressions.lower import lower, lower_scalar
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import scalars, shape_of, shape_text
from lacuna.codegen.symbolic.expr import BOOLEAN, FALSE, TRUE, Expr
from lacuna.codegen.symbolic.rewrite import assigned
from lacuna.codegen.syntax import ast


def flatten_when(item: ast.When, scope: Scope) -> flat.When:
    """A vector of conditions becomes one branch for each: any rising edge fires the body once."""
    branches = []
    for written, body in item.branches:
        statements = when_body(body, replace(scope, pure=False))
        branches += [(condition, statements) for condition in when_conditions(written, scope)]
    _same_targets([body for _, body in branches], item.span, "elsewhen")
    return flat.When(branches, item.span, origin_of(scope))


def _same_targets(bodies: list[list[flat.Statement]], span: Span, what: str) -> None:
    """Branches set the same variables (Modelica 3.6, 8.3.5): else it would be open which equation holds. R065."""
    sets = [set(assigned(body)) for body in bodies]
    differing = sorted(set.union(*sets) - set.intersection(*sets))
    if differing:
        name = differing[0]
        hint = f"add {name} = pre({name}) where it is missing, or write separate when-equations"
        raise Diagnostic("R065", f"'{what}': only some branches set {', '.join(differing)}", span, hint)


def when_conditions(written: ast.Expression, scope: Scope) -> list[Expr]:
    """The conditions of a when-clause. Only `initial()` itself, alone or in the vector, is active at the start (8.6):
    what a function makes of it is true there already and does not become true later."""
    value = lower(written, scope)
    conditions = scalars(value)
    parts = written.elements if isinstance(written, ast.ArrayLiteral) else [written]
    if len(parts) == len(conditions):
        pairs = zip(conditions, parts, strict=True)
        conditions = [FALSE if isinstance(c, Expr) and c.op == "initial" and not _asks(w) else c for c, w in pairs]
    if len(shape_of(value)) > 1:
        hint = "write one vector: when {a, b} then"
        raise Diagnostic("R020", f"the condition of when is {shape_text(shape_of(value))}", written.span, hint)
    for condition in conditions:
        if not isinstance(condition, Expr) or condition.type != BOOLEAN:
            hint = "use a comparison, sample(...), or a Boolean variable"
            raise Diagnostic("R020", "the condition of when is not a Boolean", written.span, hint)
        if variability(condition, scope.context) == "continuous":
            hint = "conditions change at events: leave noEvent out, or give a function's result GenerateEvents"
            raise Diagnostic("R063", "the condition of when varies between events (8.3.5)", written.span, hint)
    return conditions


def _asks(written: ast.Expression) -> bool:
    return isinstance(written, ast.Call) and str(written.function) == "initial"


def when_body(body: list[ast.Item], scope: Scope) -> list[flat.Statement]:
    statements: list[flat.Statement] = []
    for item in body:
        if isinstance(item, ast.Equality):
            statements += _assignments(item, scope)
        elif isinstance(item, ast.For):
            for inner in unroll_equations(item, scope):
                statements += when_body(item.body, inner)
        elif isinstance(item, ast.If):
            statements += _if(item, scope)
        elif isinstance(item, ast.Procedure):
            statements += procedure(item, scope)
        else:
            what = "when" if isinstance(item, ast.When) else "connect"
            hint = "combine the conditions: when a and b then" if what == "when" else "connections never change"
            raise Diagnostic("R057", f"'{what}' inside of when", item.span, hint)
    return statements


def _if(item: ast.If, scope: Scope) -> list[flat.Statement]:
    branches = []
    for written, body in item.branches:
        condition = TRUE if written is None else lower_scalar(written, scope, BOOLEAN)
        if condition is not FALSE:
            branches.append((condition, when_body(body, scope)))
        if condition is TRUE:
            break
    if branches and branches[0][0] is TRUE:
        return branches[0][1]
    bodies = [body for _, body in branches] + ([[]] if branches and branches[-1][0] is not TRUE else [])
    if not all(is_known(condition, scope.context) for condition, _ in branches):
        _same_targets(bodies, item.span, "if")
    return [flat.If(branches, item.span)] if branches else []


def _assignments(item: ast.Equality, scope: Scope) -> list[flat.Statement]:
    statements: list[flat.Statement] = []
    for equation in equalities(item, scope):
        target, value = equation.lhs, equation.rhs
        check_target(target, item.span, scope)
        _refuse_part_of_a_component(target, item.span, scope)
        check_types(target, value, item.span, scope)
        statements.append(flat.Assign(str(target.value), value, item.span))
    return statements


def _refuse_part_of_a_component(target: Expr, span: Span, scope: Scope) -> None:
    """Raises R058 where a model or a block in this one declares what a when-clause here sets (4.4.4)."""
    owner = scope.context.scalars[str(target.value)][0].instance
    between = []
    while owner is not None and owner is not scope.instance:
        between.append(owner)
        owner = owner.parent
    own = next((c for c in between if owner is not None and c.cls.kind in ("model", "block")), None)
    if own is not None:
        hint = f"set a variable of this model, and connect it or give it to {own.name}"
        raise Diagnostic("R058", f"{target.value} is a variable of the {own.cls.kind} {own.name}", span, hint)


def procedure(item: ast.Procedure, scope: Scope) -> list[flat.Statement]:
    """reinit, assert and terminate as statements."""
    name, call = str(item.call.function), item.call
    if name == "assert":
        return [lower_assert(call, scope)]
    if name == "terminate":
        message = lower_message(call.args[0], scope, []) if len(call.args) == 1 else None
        if message is None:
            raise Diagnostic("R050", "terminate takes one message", item.span, 'terminate("why")')
        return [flat.Terminate(message, item.span)]
    if name == "reinit":
        return _reinit(call, scope)
    return [*effect(item, scope)]


def _reinit(call: ast.Call, scope: Scope) -> list[flat.Statement]:
    if len(call.args) != 2 or call.named:
        raise Diagnostic("R050", "reinit takes a state and its new value", call.span, "reinit(v, -e*pre(v))")
    target, value = (lower(a, scope) for a in call.args)
    if shape_of(target) != shape_of(value):
        message = f"reinit: {shape_text(shape_of(target))} and {shape_text(shape_of(value))}"
        raise Diagnostic("R042", message, call.span, "both need the same size")
    result: list[flat.Statement] = []
    for t, v in zip(scalars(target), scalars(value), strict=True):
        check_target(t, call.args[0].span, scope)
        check_types(t, v, call.span, scope)
        result.append(flat.Reinit(str(t.value), v, call.span))
    return result


def refuse_inner_whens(items: list[ast.Item], inside: str = "") -> None:
    """A when-statement stands in no other statement (11.2.7.2). Raises R057."""
    for item in items:
        if isinstance(item, ast.When) and inside:
            raise Diagnostic("R057", f"'when' inside of {inside}", item.span, "write 'when' around, or its condition")
        bodies = [body for _, body in item.branches] if isinstance(item, ast.If) else []
        bodies += [item.body] if isinstance(item, ast.For | ast.While) else []
        for body in bodies:
            refuse_inner_whens(body, type(item).__name__.lower())
