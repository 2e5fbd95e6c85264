"""Running the body of a function on values: numbers give numbers, expressions give expressions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.instance import package_of
from lacuna.codegen.flatten.classes.types import Type
from lacuna.codegen.flatten.equations.asserts import lower_assert
from lacuna.codegen.flatten.equations.effects import effect
from lacuna.codegen.flatten.expressions.choices import merged_value
from lacuna.codegen.flatten.expressions.constants import AtRunTime
from lacuna.codegen.flatten.expressions.lower import lower, lower_results, lower_scalar
from lacuna.codegen.flatten.functions.effort import MAX_NESTED_STEPS, nested_call, one_more_step
from lacuna.codegen.flatten.functions.fitting import SizeVaries, blank, fit, result_of, unknown_target
from lacuna.codegen.flatten.functions.library.random_numbers import GENERATORS
from lacuna.codegen.flatten.functions.locals import Local, Signature
from lacuna.codegen.flatten.functions.parts import Target
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.values import (
    Record,
    Value,
    integers,
    is_open,
    scalars,
    shape_of,
)
from lacuna.codegen.flatten.references.iterators import iterate
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, TRUE, Expr
from lacuna.codegen.syntax import ast

Named = Callable[[Local, Value, Span], Value]
MAX_STEPS = 50_000
MAX_SYMBOLIC_STEPS = 400


def interpret(
    signature: Signature, arguments: dict[str, Value], context: Context, span: Span, named: Named | None = None,
    once: bool = False,
) -> list[Value]:  # fmt: skip
    """Results of the function on `arguments`. Raises AtRunTime where its course depends on unknown values; with `once`,
    loops without a known end are passed once, and no assert holds it up: who reads units asks for no values. `named`
    gives what stands for a value that is assigned, there, to a variable that declares a unit.
    """
    if signature.external is not None:
        return _native(signature, arguments, span)
    run = _Run(signature, context, dict(arguments), span)
    run.named = {local.name: partial(named, local) for local in signature.locals if named is not None and local.unit}
    run.inputs, run.once = frozenset(arguments), once
    run.kinds = {local.name: local.type for local in signature.locals}
    for local in signature.in_order:
        if local.declaration.causality == "input":
            continue
        scope = replace(local.scope, locals=run.locals)
        default = local.declaration.modification.value
        if default is not None:
            value = fit(local, lower(default, local.around_default(scope)), scope, default.span)
            run.locals[local.name] = _named_constant(local, signature.cls, value, context) if run.symbolic else value
            run.name(local.name, default.span)
        else:
            if local.is_flexible:
                run.flexible.add(local.name)
            run.locals[local.name] = blank(local, scope)
    with nested_call(run.symbolic, span):
        run.block(signature.body)
    return [result_of(local, run.locals[local.name], signature.cls, context) for local in signature.outputs]


def _native(signature: Signature, arguments: dict[str, Value], span: Span) -> list[Value]:
    """A generator of random numbers on a known state: (state, number)."""
    (state,) = arguments.values()
    if any(not isinstance(w, Expr) or w.op != "const" for w in scalars(state)):
        raise AtRunTime("a random number", span)
    words, number = GENERATORS[signature.external.external.function]([w.value for w in scalars(state)])
    given = {"Integer": integers(words), "Real": ex.const(number)}
    return [given[local.type.primitive] for local in signature.outputs]


def _named_constant(local: Local, cls: ast.Class, value: Value, context: Context) -> Value:
    """A constant with a unit stays a constant of the model, by its name: a mere number would have no unit."""
    if local.declaration.variability != "constant" or not local.unit or isinstance(value, Record):
        return value
    return package_of(context, cls).child(local.name).value()


class _Run:
    def __init__(self, signature: Signature, context: Context, values: dict[str, Value], span: Span) -> None:
        self.scope = signature.scope_of(values, context)
        self.locals = values
        self.span = span
        self.inputs: frozenset[str] = frozenset()
        self.kinds: dict[str, Type] = {}  # what is declared: a Real may hold the text of an Integer
        self.named: dict[str, Callable[[Value, Span], Value]] = {}
        self.flexible: set[str] = set()  # arrays declared with `:`, which take the size of what is assigned (12.4.5)
        self.once = False
        self.steps = 0
        symbolic = any(is_open(s) for v in values.values() for s in scalars(v))
        self.symbolic = symbolic
        self.limit = MAX_SYMBOLIC_STEPS if symbolic else MAX_STEPS

    def block(self, items: Sequence[ast.Item]) -> str:
        """Run statements; "break" or "return" where one of these ended the block."""
        for item in items:
            self.steps += 1
            if self.steps > self.limit or one_more_step() > MAX_NESTED_STEPS:
                if self.symbolic:
                    raise AtRunTime("a long computation", item.span)
                message = f"no end after {MAX_STEPS if self.steps > self.limit else MAX_NESTED_STEPS} statements"
                raise Diagnostic("F034", message, item.span, "does the loop reach its end?")
            signal = self._item(item)
            if signal:
                return signal
        return ""

    def _item(self, item: ast.Item) -> str:
        if isinstance(item, ast.Assignment):
            self._assign(item)
        elif isinstance(item, ast.If):
            return self._if(item)
        elif isinstance(item, ast.For):
            return self._for(item, 0)
        elif isinstance(item, ast.While):
            return self._while(item)
        elif isinstance(item, ast.Break):
            return "break"
        elif isinstance(item, ast.Return):
            return "return"
        elif isinstance(item, ast.Procedure):
            self._procedure(item)
        else:
            what = type(item).__name__.lower()
            raise Diagnostic("R059", f"'{what}' in a function", item.span, "functions have no events")
        return ""

    def _while(self, item: ast.While) -> str:
        while self.once or self._decided(item.condition):
            signal = self.block(item.body)
            self.steps += 1
            if signal == "return":
                return signal
            if signal == "break" or self.once:
                break
        return ""

    def _procedure(self, item: ast.Procedure) -> None:
        if str(item.call.function) != "assert":
            for a in effect(item, self.scope):
                if a.condition is not ex.FALSE:
                    raise AtRunTime("a call for its asserts", item.span)
                if a.level == "error":
                    self._fail(a)
            return
        check = lower_assert(item.call, self.scope)
        if self.once:
            return
        if check.condition.op != "const":
            raise AtRunTime("an assert", item.span)
        if not check.condition.value and check.level == "error":
            self._fail(check)

    def _fail(self, check: flat.Assert) -> None:
        if self.symbolic and self.scope.conditional:
            raise AtRunTime("an assert", check.span)
        error = Diagnostic("F035", f"the function failed: {check.message}", self.span, "change the arguments")
        error.notes.append((check.span, "by this assert"))
        raise error

    def _decided(self, written: ast.Expression) -> bool:
        condition = lower_scalar(written, self.scope, BOOLEAN)
        if condition.op != "const":
            raise AtRunTime("the condition of a loop", written.span)
        return bool(condition.value)

    def _for(self, item: ast.For, at: int) -> str:
        iterator = item.iterators[at]
        shadowed = self.locals.get(iterator.name)
        values = iterate(iterator, self.scope, item.body)
        signal = ""
        for value in values:
            self.locals[iterator.name] = value
            inner = at + 1 < len(item.iterators)
            signal = self._for(item, at + 1) if inner else self.block(item.body)
            if signal:
                break
        if shadowed is None:
            self.locals.pop(iterator.name, None)
        else:
            self.locals[iterator.name] = shadowed
        return "return" if signal == "return" else ""

    def _if(self, item: ast.If) -> str:
        outcomes: list[tuple[Expr, dict[str, Value]]] = []
        before, whole = dict(self.locals), self.scope
        for written, body in item.branches:
            self._set(before)
            condition = TRUE if written is None else lower_scalar(written, self.scope, BOOLEAN)
            if condition.op == "const" and not condition.value:
                continue
            if condition is TRUE and not outcomes:
                return self.block(body)
            self.scope = replace(whole, conditional=True)
            if self.block(body) and not self.once:
                raise AtRunTime("leaving a branch early", item.span)
            outcomes.append((condition, dict(self.locals)))
            if condition is TRUE:
                break
        self.scope = whole
        if not outcomes:
            self._set(before)
            return ""
        if outcomes[-1][0] is not TRUE:
            outcomes.append((TRUE, before))
        merged = dict(outcomes[-1][1])
        for condition, values in reversed(outcomes[:-1]):
            for name, value in values.items():
                if name in merged and merged[name] is not value:
                    if name in self.flexible and shape_of(value) != shape_of(merged[name]):
                        raise SizeVaries(name, item.span)
                    merged[name] = merged_value(condition, value, merged[name], item.span)
        self._set(merged)
        return ""

    def _set(self, values: dict[str, Value]) -> None:
        self.locals.clear()
        self.locals.update(values)

    def _assign(self, item: ast.Assignment) -> None:
        if isinstance(item.target, ast.Tuple):
            results = lower_results(item.value, self.scope, len(item.target.items))
            for target, value in zip(item.target.items, results, strict=False):
                if target is not None:
                    self._store(target, value, item.span)
        else:
            self._store(item.target, lower(item.value, self.scope), item.span)

    def _store(self, target: ast.Ref, value: Value, span: Span) -> None:
        name = target.names[0]
        if name not in self.locals:
            raise unknown_target(target, self.locals)
        if name in self.inputs:
            raise Diagnostic("R058", f"the input {name} is assigned", span, "copy it to a variable first")
        part = Target(target, self.scope, span, self.flexible)
        self.locals[name] = part.updated(self.locals[name], value, self.kinds[name])
        self.name(name, span)

    def name(self, variable: str, span: Span) -> None:
        """Have what stands for its value in place of it, where the variable declares a unit."""
        if variable in self.named:
            self.locals[variable] = self.named[variable](self.locals[variable], span)
