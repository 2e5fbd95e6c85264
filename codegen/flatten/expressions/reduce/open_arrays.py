"""Arrays whose size varies, as `a[1:n] .* b[1:n]`: no values, but what a reduction goes over, element by element
(Modelica 3.6, 10.3.4, 10.6)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import AtRunTime
from lacuna.codegen.flatten.expressions.lower import lower, lower_scalar
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import shape_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.affine import offset
from lacuna.codegen.symbolic.expr import INTEGER, Expr
from lacuna.codegen.syntax import ast

Bounds = tuple[Expr, Expr]  # of an index, which goes in steps of 1
Open = tuple[tuple[Bounds, ...], Callable[..., ast.Expression]]  # of each dimension; and the element at such indices
_BY_ELEMENT = ("+", "-", ".+", ".-", ".*", "./", ".^", "and", "or")
SIZES = (AtRunTime, Diagnostic)


def is_open(reason: AtRunTime | Diagnostic, scope: Scope) -> bool:
    """Whether what has no value for that reason may be of a size that varies, where a reduction goes over such."""
    if isinstance(reason, AtRunTime):
        return scope.loop is not None
    return reason.code == "F021" and not scope.in_function


class Elements:
    """Those of the expression `e`, in the names of `scope`; `required` is what its sizes have to be."""

    def __init__(self, e: ast.Expression, scope: Scope) -> None:
        self.scope, self.span = scope, e.span
        self.required: list[Expr] = []
        self.bounds, self._at = self._open(e) or ((), lambda: e)

    def each(self) -> ast.Comprehension:
        """`e[i] for i in r` of an array."""
        return self._over(self.bounds, self._at)

    def summed(self) -> ast.Call | None:
        """The sum that `e`, a product of vectors, comes to; None of anything else."""
        found = self._at() if not self.bounds else None
        return found if isinstance(found, ast.Call) else None

    def _over(self, bounds: tuple[Bounds, ...], at: Callable[..., ast.Expression]) -> ast.Comprehension:
        indices = [self._named(f"index {len(self.scope.locals)}", None) for _ in bounds]
        ranges = [ast.Range(self.span, self._value(low), None, self._value(high)) for low, high in bounds]
        iterators = [ast.Iterator(self.span, i.names[0], r) for i, r in zip(indices, ranges, strict=True)]
        return ast.Comprehension(self.span, at(*indices), iterators)

    def _named(self, name: str, value: Expr | None) -> ast.Ref:
        """A name that no variable can have."""
        self.scope = self.scope.with_locals(**{name: ex.const(1) if value is None else value})
        return ast.Ref(self.span, (name,), (None,))

    def _value(self, value: Expr) -> ast.Expression:
        if value.op == "const":
            return ast.Literal(self.span, value.value)
        return self._named(f"bound {len(self.scope.locals)}", value)

    def _moved(self, index: ast.Expression, start: Expr, own: Expr) -> ast.Expression:
        """The index that is as far from `own` as `index` is from `start`."""
        return index if start is own else ast.Binary(self.span, "+", index, self._value(ex.sub(own, start)))

    def _of(self, e: ast.Expression) -> Open:
        try:
            value = lower(e, self.scope)
        except SIZES as reason:
            if not is_open(reason, self.scope):
                raise
            found = self._open(e)
            if found is None:
                raise
            return found
        bounds = tuple((ex.const(1), ex.const(n)) for n in shape_of(value))
        return bounds, (lambda *i: ast.Part(e.span, e, i)) if bounds else (lambda: e)

    def _open(self, e: ast.Expression) -> Open | None:
        if isinstance(e, ast.Ref):
            return self._slice(e)
        if isinstance(e, ast.Unary):
            bounds, at = self._of(e.operand)
            return bounds, lambda *i: replace(e, operand=at(*i))
        if isinstance(e, ast.Binary):
            return self._binary(e)
        if isinstance(e, ast.Comprehension):
            return self._comprehension(e)
        name = str(e.function) if isinstance(e, ast.Call) else ""
        if name in ("fill", "zeros", "ones") and not e.named:
            return self._filled(e, name)
        if name == "transpose" and len(e.args) == 1:
            bounds, at = self._of(e.args[0])
            return (bounds[::-1], lambda i, j: at(j, i)) if len(bounds) == 2 else None
        if name in ex.BUILTINS and not e.named and len(e.args) == ex.BUILTINS[name]:
            bounds, elements = self._aligned([self._of(a) for a in e.args], e.span, name)
            return bounds, lambda *i: replace(e, args=elements(*i))
        return None

    def _slice(self, e: ast.Ref) -> Open | None:
        """Where the subscripts leave several elements the index goes from bound to bound itself, in steps of 1."""
        bounds: list[Bounds] = []
        e = self._with_all(e)
        places: dict[tuple[int, int], Callable[[ast.Expression], ast.Expression]] = {}
        for k, subscripts in enumerate(e.subscripts):
            whole = replace(e, names=e.names[: k + 1], subscripts=(*e.subscripts[:k], None))
            for at, written in enumerate(subscripts or ()):
                if isinstance(written, ast.Range | ast.Colon):
                    size = ex.const(shape_of(lower(whole, self.scope))[at])
                    own, place = self._range(written, replace(self.scope, end=size))
                    bounds.append(own)
                    places[k, at] = place
                elif shape_of(lower(written, replace(self.scope, end=ex.const(1)))):
                    return None  # a vector of subscripts
        if not bounds:
            return None

        def element(*indices: ast.Expression) -> ast.Expression:
            by = {where: place(i) for (where, place), i in zip(places.items(), indices, strict=True)}
            subscripts = [
                s and tuple(by.get((k, at), one) for at, one in enumerate(s)) for k, s in enumerate(e.subscripts)
            ]
            return replace(e, subscripts=tuple(subscripts))

        return tuple(bounds), element

    def _filled(self, e: ast.Call, name: str) -> Open:
        value = e.args[0] if name == "fill" else ast.Literal(e.span, int(name == "ones"))
        sizes = [lower_scalar(a, self.scope, INTEGER) for a in e.args[name == "fill" :]]
        return tuple((ex.const(1), n) for n in sizes), lambda *i: value

    def _comprehension(self, e: ast.Comprehension) -> Open | None:
        """`{e for i in a:b}`: the element at k is the one of `{e for i in k:k}`."""
        written = e.iterators[0].range
        if len(e.iterators) > 1 or not isinstance(written, ast.Range) or written.step is not None:
            return None
        low, high = (lower_scalar(b, self.scope, INTEGER) for b in (written.first, written.last))

        def element(k: ast.Expression) -> ast.Expression:
            iterator = replace(e.iterators[0], range=ast.Range(e.span, k, None, k))
            return ast.Part(e.span, replace(e, iterators=[iterator]), (ast.Literal(e.span, 1),))

        return ((low, high),), element

    def _with_all(self, e: ast.Ref) -> ast.Ref:
        """With a subscript for each dimension where there are any: `A[1:n]` is `A[1:n, :]`."""
        subscripts = []
        for k, written in enumerate(e.subscripts):
            if written is not None:
                whole = replace(e, names=e.names[: k + 1], subscripts=(*e.subscripts[:k], None))
                missing = len(shape_of(lower(whole, self.scope))) - len(written)
                written = (*written, *(ast.Colon(e.span),) * missing)
            subscripts.append(written)
        return replace(e, subscripts=tuple(subscripts))

    def _range(
        self, e: ast.Range | ast.Colon, scope: Scope
    ) -> tuple[Bounds, Callable[[ast.Expression], ast.Expression]]:
        """From where to where an index goes, and the subscript that it stands for."""
        if isinstance(e, ast.Colon):
            return (ex.const(1), scope.end), lambda i: i
        low, high = (lower_scalar(b, scope, INTEGER) for b in (e.first, e.last))
        if e.step is None:
            return (low, high), lambda i: i
        step = lower_scalar(e.step, scope, INTEGER)
        last = ex.call("integer", ex.div(ex.sub(high, low), step))
        first, by = self._value(low), self._value(step)
        return (ex.const(0), last), lambda i: ast.Binary(e.span, "+", first, ast.Binary(e.span, "*", by, i))

    def _binary(self, e: ast.Binary) -> Open | None:
        left, right = self._of(e.left), self._of(e.right)
        ranks = len(left[0]), len(right[0])
        if e.op == "*" and all(ranks):
            return self._contracted(e, left, right) if max(ranks) <= 2 else None
        if e.op not in _BY_ELEMENT and not (e.op == "*" or (e.op == "/" and ranks[1] == 0)):
            return None
        if e.op in ("+", "-") and 0 in ranks:
            hint = f"element by element: .{e.op}"
            raise Diagnostic("R042", f"{e.op} of a scalar and an array", e.span, hint)
        bounds, elements = self._aligned([left, right], e.span, e.op)
        return bounds, lambda *i: ast.Binary(e.span, e.op, *elements(*i))

    def _aligned(
        self, parts: list[Open], span: Span, what: str
    ) -> tuple[tuple[Bounds, ...], Callable[..., list[ast.Expression]]]:
        """Scalars and arrays of one size: the indices are those of the first array."""
        lead = next((bounds for bounds, _ in parts if bounds), ())
        for bounds, _ in parts:
            if len(bounds) not in (0, len(lead)):
                message = f"{what} of arrays of {len(lead)} and {len(bounds)} dimensions"
                raise Diagnostic("R042", message, span, "both need the same size")
            for own, other in zip(bounds, lead, strict=False):
                self._require_same(own, other, span, what)

        def elements(*indices: ast.Expression) -> list[ast.Expression]:
            moved = [
                [self._moved(i, first[0], own[0]) for i, first, own in zip(indices, lead, bounds, strict=False)]
                for bounds, _ in parts
            ]
            return [at(*own) for (_, at), own in zip(parts, moved, strict=True)]

        return lead, elements

    def _contracted(self, e: ast.Binary, left: Open, right: Open) -> Open:
        """The product of vectors and matrices: the sum over the index between them."""
        (*rows, inner), at = left
        (other, *columns), of = right
        self._require_same(inner, other, e.span, "*")

        def element(*indices: ast.Expression) -> ast.Expression:
            i, j = indices[: len(rows)], indices[len(rows) :]
            product = self._over(
                (inner,), lambda k: ast.Binary(e.span, "*", at(*i, k), of(self._moved(k, inner[0], other[0]), *j))
            )
            return ast.Call(e.span, ast.Ref(e.span, ("sum",), (None,), absolute=True), [product])

        return (*rows, *columns), element

    def _require_same(self, a: Bounds, b: Bounds, span: Span, what: str) -> None:
        """As many elements here as there. Raises R042 where it is known that there are not."""
        if offset(ex.sub(a[1], a[0]), ex.sub(b[1], b[0])) == 0:
            return
        counts = [ex.maximum(ex.add(ex.sub(high, low), ex.const(1)), ex.const(0)) for low, high in (a, b)]
        same = ex.relation("==", *counts)
        if same is ex.FALSE:
            sizes = " and ".join(ex.to_text(c) for c in counts)
            raise Diagnostic("R042", f"{what} of {sizes} elements", span, "both need the same size")
        self.required.append(same)


class Assigned(Elements):
    """Those of a part of an array and of its value, which have the same size."""

    def __init__(self, target: ast.Ref, value: ast.Expression, scope: Scope) -> None:
        super().__init__(target, scope)
        given = self._of(value)
        if len(given[0]) != len(self.bounds):
            message = f"{target} has {len(self.bounds)} dimensions, its value {len(given[0])}"
            raise Diagnostic("R042", message, target.span, "both need the same size")
        self.both = self._aligned([(self.bounds, self._at), given], target.span, ":=")[1]
