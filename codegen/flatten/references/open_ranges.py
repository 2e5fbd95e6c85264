"""Reductions over ranges that vary, in models: `sum(u[i] for i in 1:k)` goes over all elements that u has, each where
it is among them (Modelica 3.6, 10.3.4.1). Outside of the array there is no value, which ends the run.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.expressions.lower import NOT_THERE, lower
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Value, scalars, with_scalars
from lacuna.codegen.flatten.references.iterators import iterate, varying_bounds
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import TRUE, Expr
from lacuna.codegen.syntax import ast

Join = Callable[[Expr, Expr], Expr]


def expanded(
    e: ast.Comprehension,
    begun: Callable[[Value], tuple[Expr, Join]],
    scope: Scope,
    required: list[Expr],
    reason: Diagnostic,
) -> Value:
    """The reduction of `e` where what is `required` holds, of arrays one for each element. Raises `reason` where it is
    another one than such a range, or nothing says how far that may go."""
    terms = _Terms(e, reason)
    terms.over(e.iterators, scope, TRUE)
    if not (terms.open and terms.found):
        raise reason
    first = terms.found[0][1]
    starts, join = begun(first)
    within = TRUE
    for condition in (*required, *terms.required):
        within = ex.logical_and(within, condition)
    items: list[Expr] = [starts] * len(scalars(first))
    for condition, value in terms.found:
        each = zip(items, scalars(value), strict=True)
        items = [join(so_far, ex.if_else(condition, item, starts)) for so_far, item in each]
    return with_scalars(first, (ex.if_else(within, item, ex.nothing(item.type)) for item in items))


class _Terms:
    """What is reduced, each with when it is."""

    def __init__(self, e: ast.Comprehension, reason: Diagnostic) -> None:
        self.e, self.reason, self.open = e, reason, False
        self.found: list[tuple[Expr, Value]] = []
        self.required: list[Expr] = []

    def over(self, iterators: Sequence[ast.Iterator], scope: Scope, condition: Expr) -> None:
        """The last iterator is the outermost, as in `{e for i in a, j in b}`."""
        if not iterators:
            self._term(scope, condition)
            return
        *rest, last = iterators
        bounds = varying_bounds(last, scope)
        if bounds is None:
            for value in iterate(last, scope, self.e.body):
                self.over(rest, scope.with_locals(**{last.name: value}), condition)
            return
        self.open = True
        low, step, high = bounds
        values = self._candidates(last, scope)
        if not ex.is_const(step, 1) or not all(isinstance(v, Expr) and v.type == ex.INTEGER for v in values):
            raise self._refusal()
        none = ex.relation("<", high, low)
        inside = [ex.relation(">=", low, ex.const(1)), ex.relation("<=", high, ex.const(len(values)))]
        self._require(condition, ex.logical_or(none, ex.logical_and(*inside)))
        for value in values:
            among = ex.logical_and(ex.relation("<=", low, value), ex.relation("<=", value, high))
            self.over(rest, scope.with_locals(**{last.name: value}), ex.logical_and(condition, among))

    def _candidates(self, iterator: ast.Iterator, scope: Scope) -> tuple[Value, ...]:
        """What the variable may be: the indices of what it subscripts by itself."""
        try:
            return iterate(replace(iterator, range=None), scope, self.e.body)
        except Diagnostic as error:
            if error.code != "R047":
                raise
            raise self._refusal() from None

    def _refusal(self) -> Diagnostic:
        hint = "in steps of 1, the variable of the loop by itself a subscript: sum(u[i] for i in 1:k); or in a function"
        return replace(self.reason, hint=hint)

    def _require(self, condition: Expr, needed: Expr) -> None:
        self.required.append(ex.logical_or(ex.logical_not(condition), needed))

    def _term(self, scope: Scope, condition: Expr) -> None:
        """An element that does not exist is none of those that are reduced."""
        try:
            value = lower(self.e.body, replace(scope, conditional=True))
        except Diagnostic as error:
            if error.code not in NOT_THERE or condition is TRUE:
                raise
            self._require(condition, ex.FALSE)
            return
        self.found.append((condition, value))
