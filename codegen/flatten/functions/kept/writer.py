"""The statements of a function that runs at run time, and its variables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.equations.asserts import lower_assert
from lacuna.codegen.flatten.equations.effects import effect
from lacuna.codegen.flatten.expressions.constants import AtRunTime
from lacuna.codegen.flatten.expressions.lower import lower, lower_results, lower_scalar
from lacuna.codegen.flatten.functions.fitting import blank, declared_sizes, fit, typed, unknown_target
from lacuna.codegen.flatten.functions.kept.loops import Begun, bounds, looped
from lacuna.codegen.flatten.functions.kept.parts import matched, parts, variables_of
from lacuna.codegen.flatten.functions.kept.slices import follows_itself, sliced
from lacuna.codegen.flatten.functions.kept.stores import decided, deciding, read_what_is_set, stores
from lacuna.codegen.flatten.functions.kept.whole_calls import called
from lacuna.codegen.flatten.functions.locals import Local
from lacuna.codegen.flatten.names.elements import local_value
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Value, scalars, shape_of
from lacuna.codegen.flatten.references.iterators import iterate
from lacuna.codegen.flatten.references.references import read_local
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, FALSE, INTEGER, REAL, TRUE, Expr
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import references


class Writer:
    """Statements of one function; a target is (name, subscripts as values or None for all of it)."""

    def __init__(self, function: flat.Function, scope: Scope) -> None:
        self.function, self.scope = function, replace(scope, loop=self._looped)
        self.counter = 0
        self._begun: list[tuple[Local, Value, Value]] = []  # with their variables and, of records, what they hold

    def declare(self, name: str, variables: Value) -> None:
        """A variable of the function, or what a record consists of."""
        for part, value in parts(name, variables).items():
            items = scalars(value)
            kind = items[0].type if items else REAL
            self.function.shapes[part], self.function.types[part] = shape_of(value), kind
        self.scope.locals[name] = variables

    def declare_local(self, local: Local, inputs: dict[str, Value]) -> None:
        """An input, a result or a protected variable; what its declaration gives it follows by `begin`."""
        scope, default = self._declaring(local), local.declaration.modification.value
        if local.name in inputs:
            self.declare(local.name, inputs[local.name])
            return
        span = local.declaration.span
        if local.type.primitive is None:
            there = local.around_default(scope)
            given: Value = fit(local, lower(default, there), scope, span) if default else blank(local, scope)
        else:
            sized = default is not None and any(isinstance(d, ast.Colon) for d in local.declaration.dimensions)
            shape = declared_sizes(local, scope, lower(default, local.around_default(scope)) if sized else None)
            given = local_value(local.name, local.type.primitive, shape)
        variables = variables_of(local.name, local.type, given, scope.context, span)
        self.declare(local.name, variables)
        if local.type.primitive is None or default is not None:
            self._begun.append((local, variables, given))

    def _declaring(self, local: Local) -> Scope:
        """That of what stands in a declaration."""
        return replace(local.scope, locals=self.scope.locals, loop=self._looped)

    def begin(self) -> None:
        """The statements of the declarations, in their order: they may call the function itself, whose results are
        declared by now."""
        for local, variables, given in self._begun:
            span, default = local.declaration.span, local.declaration.modification.value
            if local.type.primitive is not None:
                scope = self._declaring(local)
                value = fit(local, lower(default, local.around_default(scope)), scope, default.span)
                self.assign([((local.name, variables), value)], default.span, self.function.body)
                continue
            for target, value in matched(variables, given, local.name, span):
                if isinstance(value, Expr) and value.op != "unset":
                    self.function.body += stores([(target, value)], span)

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
        """Over a range the loop is kept, unless sizes in it follow its variable; over an array it is unrolled."""
        if not iterators:
            result += self.block(item.body)
            return
        first, *rest = iterators
        outer, before = self.scope, (dict(self.function.shapes), dict(self.function.types))
        try:
            if isinstance(first.range, ast.Range):
                result.append(self._kept(item, first.range, first, rest))
            else:
                self._unrolled(item, iterate(first, outer, item.body), first, rest, result)
        except AtRunTime:
            if any(b.op != "const" for b in bounds(first.range, outer)):
                raise
            self.scope = outer
            self.function.shapes, self.function.types = before
            self._unrolled(item, iterate(first, outer, item.body), first, rest, result)
        finally:
            self.scope = outer

    def _kept(self, item: ast.For, written: ast.Range, first: ast.Iterator, rest: list[ast.Iterator]) -> flat.For:
        low, step, high = bounds(written, self.scope)
        name = first.name if first.name not in self.function.types else self._fresh(first.name)
        self.scope = self.scope.with_locals(**{first.name: ex.var(name, INTEGER)})
        body: list[flat.Statement] = []
        self._for(item, rest, body)
        return flat.For(name, low, step, high, body, item.span)

    def _unrolled(
        self, item: ast.For, values: Iterable[Value], first: ast.Iterator, rest: list[ast.Iterator],
        result: list[flat.Statement],
    ) -> None:  # fmt: skip
        """Round by round, in a loop of one round if a break leaves it."""
        rounds: list[flat.Statement] = []
        outer = self.scope
        for value in values:
            self.scope = outer.with_locals(**{first.name: value})
            self._for(item, rest, rounds)
        once, left = ex.const(1), not rest and _is_left(item.body)
        result += [flat.For(self._fresh(first.name), once, once, once, rounds, item.span)] if left else rounds

    def _looped(self, e: ast.Comprehension, begun: Begun, scope: Scope, required: list[Expr]) -> Value:
        return looped(e, begun, scope, required, self.function, self._fresh)

    def _fresh(self, stem: str) -> str:
        """A name that no variable can have."""
        self.counter += 1
        return f"{stem} {self.counter}"

    def _assignment(self, item: ast.Assignment, result: list[flat.Statement]) -> None:
        try:
            self._assigned(item, result)
        except AtRunTime:
            if not isinstance(item.target, ast.Ref) or not any(item.target.subscripts) or follows_itself(item.target):
                raise
            result += self._slice(item, item.target.names[0])

    def _slice(self, item: ast.Assignment, name: str) -> list[flat.Statement]:
        """What the value reads of the variable `name` is what that holds before."""
        whole, before = self.scope.locals.get(name), []
        if any(r.names[0] == name for r in references(item.value)) and name in self.function.shapes:
            copy = self._fresh("before")
            self.declare(copy, local_value(copy, self.function.types[name], self.function.shapes[name]))
            self.assign([((copy, self.scope.locals[copy]), whole)], item.span, before)

        def element(target: ast.Ref, value: ast.Expression, scope: Scope) -> list[flat.Statement]:
            read = scope.with_locals(**{name: self.scope.locals[copy]}) if before else scope
            given, body = lower(value, read), []
            self.scope, outer = scope, self.scope
            try:
                self.assign([(self._target(target), given)], item.span, body)
            finally:
                self.scope = outer
            return body

        return [*before, *sliced(item, self.scope, self._fresh, element)]

    def _assigned(self, item: ast.Assignment, result: list[flat.Statement]) -> None:
        several = isinstance(item.target, ast.Tuple)
        targets = item.target.items if several else [item.target]
        lowered = lower_results(item.value, self.scope, len(targets)) if several else lower(item.value, self.scope)
        values = lowered if several else [lowered]
        places = [None if t is None else self._target(t) for t in targets]
        whole = self._whole_call(places, values, item.span)
        if whole is not None:
            result.append(whole)
            return
        pairs = zip(places, values, strict=False)
        self.assign([(place, v) for place, v in pairs if place is not None], item.span, result)

    def _whole_call(
        self, places: list[tuple[str, Value] | None], values: list[Value], span: Span
    ) -> flat.AssignCall | None:
        """One call for variables that are all set to results of it; None where the values are anything else."""
        found = called(values, self.scope.context)
        if found is None:
            return None
        call, outputs = found
        names: list[str | None] = []
        for place, output in zip(places, outputs, strict=False):
            name, target = place or (None, None)
            if name is not None and (name not in self.function.types or target != self.scope.locals[name]):
                return None  # a part of it
            if name is not None and self.function.types[name] != output:
                return None
            names.append(name)
        return flat.AssignCall(tuple(names), call, span)

    def _target(self, ref: ast.Ref) -> tuple[str, Value]:
        name = ref.names[0]
        whole = self.scope.locals.get(name)
        if whole is None or not parts(name, whole).keys() <= self.function.types.keys():
            raise unknown_target(ref, self.function.types)
        if any(part in self.function.inputs for part in parts(name, whole)):
            raise Diagnostic("R058", f"the input {name} is assigned", ref.span, "copy it to a variable first")
        return name, read_local(ref, self.scope)

    def assign(self, pairs: list[tuple[tuple[str, Value], Value]], span: Span, result: list[flat.Statement]) -> None:
        """All targets at once: values that read what is assigned go through temporary variables."""
        steps = [step for (name, target), value in pairs for step in matched(target, value, name, span)]
        steps = [(t, typed(v, t.type, ex.to_text(t), span)) for t, v in steps]
        places = list(dict.fromkeys(e for target, _ in steps for e in deciding(target)))
        if len(steps) > 1 and read_what_is_set(places, steps):
            before = dict(zip(places, self._copied(places, span, result), strict=True))
            steps = [(decided(target, before), value) for target, value in steps]
        values = [value for _, value in steps]
        if len(steps) > 1 and read_what_is_set(values, steps):
            copies = self._copied(values, span, result)
            steps = [(target, copy) for (target, _), copy in zip(steps, copies, strict=True)]
        result += stores(steps, span)

    def _copied(self, values: list[Expr], span: Span, result: list[flat.Statement]) -> list[Expr]:
        """Elements of temporary variables, one for each type, that are set to the values."""
        copies: dict[str, Iterator[Expr]] = {}
        for kind in dict.fromkeys(value.type for value in values):
            name = self._fresh("before")
            self.declare(name, local_value(name, kind, (sum(value.type == kind for value in values),)))
            copies[kind] = iter(scalars(self.scope.locals[name]))
        found = [next(copies[value.type]) for value in values]
        result += stores(zip(found, values, strict=True), span)
        return found


def _is_left(items: Sequence[ast.Item]) -> bool:
    """Does a break in these statements leave the loop around them?"""
    return any(
        isinstance(item, ast.Break) or (isinstance(item, ast.If) and any(_is_left(body) for _, body in item.branches))
        for item in items
    )
