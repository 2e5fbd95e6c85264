"""The part of a function's variable that the left side of an assignment names: elements, and fields of records."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from math import prod

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.types import Type
from lacuna.codegen.flatten.expressions.constants import AtRunTime
from lacuna.codegen.flatten.functions.fitting import conform
from lacuna.codegen.flatten.functions.locals import signature_of
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Record, Value, integers, items_of, scalars, shape_of, shape_text
from lacuna.codegen.flatten.references.references import apply_subscripts
from lacuna.codegen.syntax import ast


@dataclass(frozen=True)
class Target:
    """The left side of an assignment at `span`; `flexible` are arrays that take the size of what is assigned."""

    ref: ast.Ref
    scope: Scope
    span: Span
    flexible: Collection[str]

    def updated(self, old: Value, value: Value, kind: Type, at: int = 0) -> Value:
        """`old`, of the type `kind`, with the part that is named, from name number `at` on, as `value`."""
        ref, subscripts, last = self.ref, self.ref.subscripts[at], at + 1 == len(self.ref.names)
        kinds = None if at else self.scope.index_types.get(ref.names[0])
        if not last:
            picked = (
                apply_subscripts(_numbers(old), subscripts, self.scope, ref, kinds) if isinstance(old, Array) else None
            )
            return self._field(old, value, at + 1) if picked is None else self._fields(old, picked, value, at + 1)
        if subscripts is None:
            if ref.names[at] in self.flexible and len(shape_of(old)) == len(shape_of(value)):
                self.scope.context.spend(len(scalars(value)), self.span)
                return value
            return conform(old, value, self.span, str(ref), kind, self.scope.context)
        picked = self._known(apply_subscripts(_numbers(old), subscripts, self.scope, ref, kinds))
        if shape_of(picked) != shape_of(value):
            message = f"{shape_text(shape_of(picked))} := {shape_text(shape_of(value))}"
            raise Diagnostic("R042", f"the sides differ in size: {message}", self.span, "both need the same size")
        items = list(old.items)
        for position, new in zip(items_of(picked), items_of(value), strict=True):
            items[position.value] = conform(
                old.items[position.value], new, self.span, str(ref), kind, self.scope.context
            )
        return Array(old.shape, tuple(items))

    def _known(self, picked: Value) -> Value:
        if any(p.op != "const" for p in scalars(picked)):
            raise AtRunTime("an index", self.span)
        return picked

    def _fields(self, old: Array, picked: Value, value: Value, at: int) -> Array:
        """`old` with a field of the records of the numbers `picked` as the parts of `value`, one each (10.6.9)."""
        shape, sizes = shape_of(self._known(picked)), shape_of(value)
        if sizes[: len(shape)] != shape:
            message = f"{self.ref} is of {shape_text(shape)} records, given {shape_text(sizes)}"
            raise Diagnostic("R042", message, self.span, "give a value for each of them")
        inner, parts, items = sizes[len(shape) :], items_of(value), list(old.items)
        for k, number in enumerate(scalars(picked)):
            part = Array(inner, parts[k * prod(inner) : (k + 1) * prod(inner)]) if inner else parts[k]
            items[number.value] = self._field(items[number.value], part, at)
        return Array(old.shape, tuple(items))

    def _field(self, old: Value, value: Value, at: int) -> Record:
        name = self.ref.names[at]
        if not isinstance(old, Record) or name not in old.fields:
            raise Diagnostic("R003", f"{self.ref} has no such element", self.ref.span, "only records have elements")
        kinds = {local.name: local.type for local in signature_of(old.cls, self.scope.context).locals}
        changed = self.updated(old.fields[name], value, kinds[name], at)
        return Record(old.name, old.fields | {name: changed}, old.cls)


def _numbers(value: Value) -> Array:
    """Those of the elements of an array, in their order."""
    return Array(shape_of(value), integers(list(range(prod(shape_of(value))))).items)
