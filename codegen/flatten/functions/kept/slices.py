"""Parts of arrays between bounds that vary, assigned element by element (Modelica 3.6, 10.5.1): `y[1:n] := x[1:n]`."""

from __future__ import annotations

from collections.abc import Callable

from lacuna.codegen import flat
from lacuna.codegen.flatten.expressions.reduce.open_arrays import Assigned
from lacuna.codegen.flatten.functions.kept.loops import Fresh, sizes_fit
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import INTEGER
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import references

Element = Callable[[ast.Ref, ast.Expression, Scope], list[flat.Statement]]  # what assigns one, in such a scope


def follows_itself(target: ast.Ref) -> bool:
    """Whether what is assigned decides which part of it that is."""
    return any(r.names[0] == target.names[0] for r in references(target.subscripts))


def sliced(item: ast.Assignment, scope: Scope, fresh: Fresh, assigned: Element) -> list[flat.Statement]:
    """The loop over what is assigned, in `scope`."""
    part = Assigned(item.target, item.value, scope)
    scope, indices = part.scope, [fresh("element") for _ in part.bounds]
    names = [ast.Ref(item.span, (i,), (None,)) for i in indices]
    target, value = part.both(*names)
    scope = part.scope.with_locals(**{i: ex.var(i, INTEGER) for i in indices})
    body = assigned(target, value, scope)
    for index, (low, high) in zip(indices, part.bounds, strict=True):
        body = [flat.For(index, low, ex.const(1), high, body, item.span)]
    return [*sizes_fit(part.required, item.span), *body]
