"""Equation sections: each item to the pass that knows it, loops unroll_equationsed."""

from __future__ import annotations

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.connections.overconstrained import STATEMENTS, graph_of
from lacuna.codegen.flatten.equations.asserts import lower_assert
from lacuna.codegen.flatten.equations.conditionals import flatten_if
from lacuna.codegen.flatten.equations.effects import effect
from lacuna.codegen.flatten.equations.equations import Collected, equalities, unroll_equations
from lacuna.codegen.flatten.equations.when import flatten_when
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.syntax import ast


def scope_of(section: ast.Section, cls: ast.Class, instance: Instance) -> Scope:
    """Where the names of a section are looked up that `instance` has from `cls`, itself or a base."""
    return Scope(instance.context, cls, instance, initial=section.initial, pure=not section.initial)


def flatten_items(items: list[ast.Item], scope: Scope, out: Collected) -> None:
    """Add the equations of `items`; each faulty one is reported and left out."""
    for item in items:
        with scope.context.attempt():
            flatten_item(item, scope, out)


def flatten_item(item: ast.Item, scope: Scope, out: Collected) -> None:
    if isinstance(item, ast.Equality):
        out.equations += equalities(item, scope)
    elif isinstance(item, ast.Connect):
        out.connections.append((item, scope))
    elif isinstance(item, ast.If):
        flatten_if(item, scope, out, flatten_item)
    elif isinstance(item, ast.For):
        for inner in unroll_equations(item, scope):
            for body_item in item.body:
                flatten_item(body_item, inner, out)
    elif isinstance(item, ast.When):
        out.whens.append(flatten_when(item, scope))
    elif isinstance(item, ast.Procedure) and str(item.call.function) in STATEMENTS:
        graph_of(scope.context)
        out.branches.append(item)
    else:
        out.asserts += assertion(item, scope)


def assertion(item: ast.Item, scope: Scope) -> list[flat.Assert]:
    """assert(condition, message, level), or a call of a function for what it asserts. Raises R056 for an operator."""
    call = item.call if isinstance(item, ast.Procedure) else None
    name = str(call.function) if call else ""
    if name == "assert":
        return [lower_assert(call, scope)]
    if name in ("reinit", "terminate"):
        hint = f"put it under a condition: when ... then {name}(...); end when;"
        raise Diagnostic("R056", f"{name} outside of when", item.span, hint)
    return effect(item, scope)
