"""Reductions over ranges that vary (Modelica 3.6, 10.3.4.1), in functions that run at run time.

`sum(x[i] for i in 1:n)`
becomes the call of a function that has the loop; what the expression reads are its inputs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from lacuna.codegen import flat
from lacuna.codegen.errors import Span
from lacuna.codegen.flatten.expressions.constants import AtRunTime
from lacuna.codegen.flatten.expressions.lower import lower, lower_scalar
from lacuna.codegen.flatten.names.elements import local_value
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Value, scalars, shape_of, with_scalars
from lacuna.codegen.flatten.references.iterators import iterate
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import INTEGER, Expr
from lacuna.codegen.symbolic.rewrite import expressions
from lacuna.codegen.syntax import ast

RESULT = "result of the loop"  # which no variable can be called

Begun = Callable[[Value], tuple[Expr, Callable[[Expr, Expr], Expr]]]  # of values to reduce: a start, and how to go on
Fresh = Callable[[str], str]  # a name that the function which has the reduction does not use yet


def bounds(e: ast.Range, scope: Scope) -> tuple[Expr, Expr, Expr]:
    """The first value, the step and the last value of a range of Integers."""
    low, high = (lower_scalar(b, scope, INTEGER) for b in (e.first, e.last))
    return low, lower_scalar(e.step, scope, INTEGER) if e.step else ex.const(1), high


def sizes_fit(required: Sequence[Expr], span: Span) -> list[flat.Statement]:
    """What has to hold of sizes that vary."""
    return [flat.Assert(c, "the sizes of arrays differ", span) for c in required]


def looped(
    e: ast.Comprehension, begun: Begun, scope: Scope, required: list[Expr], outer: flat.Function, fresh: Fresh
) -> Value:
    """The reduction of `e`, in the function `outer`, where what is `required` holds; of arrays one for each element."""
    first = _Loop(e, begun, required, outer, fresh, 0)
    calls = [first.call(scope)]
    for k in range(1, len(scalars(first.value))):
        calls.append(_Loop(e, begun, required, outer, fresh, k).call(scope))
    return with_scalars(first.value, iter(calls))


class _Loop:
    """The loop that reduces scalar number `element` of the values."""

    def __init__(
        self, e: ast.Comprehension, begun: Begun, required: list[Expr], outer: flat.Function, fresh: Fresh, element: int
    ) -> None:
        self.e, self.begun, self.required, self.outer = e, begun, required, outer
        self.fresh, self.element = fresh, element
        self.value: Value | None = None  # one of those that are reduced
        self.start = ex.ZERO
        self.own = {RESULT}

    def call(self, scope: Scope) -> Expr:
        name = f"{self.fresh('loop')} of {self.outer.name}"
        body = self._over(self.e.iterators, scope)
        if self.value is None:
            raise AtRunTime("an iterator", self.e.span)  # one of them runs over nothing
        body = [*sizes_fit(self.required, self.e.span), flat.Assign(RESULT, self.start, self.e.span), *body]
        names = [n for e in expressions(body) for n in ex.walk(e) if n.op == "var" and n.value not in self.own]
        inputs = {str(n.value): self._whole(n) for n in names}
        shapes = {n: shape_of(v) for n, v in inputs.items()} | {RESULT: ()}
        types = {n: scalars(v)[0].type for n, v in inputs.items()} | {RESULT: self.start.type}
        made = flat.Function(name, tuple(inputs), (RESULT,), shapes, types, {}, body, self.e.span)
        scope.context.functions[name] = made
        arguments = (ex.array(*v.items) if isinstance(v, Array) else v for v in inputs.values())
        return ex.call(name, *arguments, type=self.start.type)

    def _over(self, iterators: Sequence[ast.Iterator], scope: Scope) -> list[flat.Statement]:
        """The last iterator is the outermost, as in `{e for i in a, j in b}`."""
        if not iterators:
            return [self._joined(scope)]
        *rest, last = iterators
        try:
            values = iterate(last, scope, self.e.body)
        except AtRunTime:
            if not isinstance(last.range, ast.Range):
                raise
            low, step, high = bounds(last.range, scope)
            variable = self.fresh(last.name)
            self.own.add(variable)
            inner = scope.with_locals(**{last.name: ex.var(variable, INTEGER)})
            return [flat.For(variable, low, step, high, self._over(rest, inner), self.e.span)]
        return [s for v in values for s in self._over(rest, scope.with_locals(**{last.name: v}))]

    def _joined(self, scope: Scope) -> flat.Statement:
        self.value = lower(self.e.body, scope)
        self.start, join = self.begun(self.value)
        item = scalars(self.value)[self.element]
        return flat.Assign(RESULT, join(ex.var(RESULT, self.start.type), item), self.e.span)

    def _whole(self, n: Expr) -> Value:
        """The variable of the function that `n` names, or that of a loop around."""
        name = str(n.value)
        return local_value(name, n.type, self.outer.shapes[name]) if name in self.outer.shapes else n
