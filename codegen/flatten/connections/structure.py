"""What the connections of a whole model say before its equations are lowered: cardinality counts them (deprecated)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.connections.connectors import connectors, parts
from lacuna.codegen.flatten.equations.equations import unroll
from lacuna.codegen.flatten.expressions.constants import evaluate, is_known
from lacuna.codegen.flatten.expressions.lower import lower_scalar
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Value
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN
from lacuna.codegen.syntax import ast


@dataclass
class Structure:
    """Every section of the model; how many connections name each scalar, once somebody asks."""

    sections: list[tuple[ast.Section, ast.Class, Instance]] = field(default_factory=list)
    counts: Counter[str] | None = None

    def count(self, context: Context) -> Counter[str]:
        if self.counts is None:
            self.counts = Counter()  # while it is being counted, conditions on it see no connections
            counted: Counter[str] = Counter()
            for item, scope in structural_items(self.sections, context):
                if isinstance(item, ast.Connect):
                    ends = [_scalars(ref, scope) for ref in (item.left, item.right)]
                    for end in ends if all(ends) else ():  # to a component whose condition is false: no connection
                        counted.update(end)
            self.counts = counted
        return self.counts


def structural_items(
    sections: list[tuple[ast.Section, ast.Class, Instance]], context: Context
) -> Iterator[tuple[ast.Item, Scope]]:
    """connect and procedures of all equation sections, loops unrolled, conditions that are known decided."""
    for section, cls, instance in sections:
        if not section.algorithm and not section.initial:
            yield from _items(section.items, Scope(context, cls, instance))


def _items(items: list[ast.Item], scope: Scope) -> Iterator[tuple[ast.Item, Scope]]:
    for item in items:
        if isinstance(item, ast.Connect | ast.Procedure):
            yield item, scope
        elif isinstance(item, ast.For) and _holds_connections(item.body):
            for inner in unroll(item, scope):
                yield from _items(item.body, inner)
        elif isinstance(item, ast.If):
            for condition, body in item.branches:
                if not _holds_connections(body):
                    continue
                chosen = True if condition is None else _decided(condition, scope)
                if chosen:
                    yield from _items(body, scope)
                    break


def _holds_connections(items: list[ast.Item]) -> bool:
    for item in items:
        if isinstance(item, ast.Connect | ast.Procedure):
            return True
        if isinstance(item, ast.For) and _holds_connections(item.body):
            return True
        if isinstance(item, ast.If) and any(_holds_connections(body) for _, body in item.branches):
            return True
    return False


def _decided(condition: ast.Expression, scope: Scope) -> bool:
    value = lower_scalar(condition, scope, BOOLEAN)
    return is_known(value, scope.context) and bool(evaluate(value, scope.context, condition.span).value)


def cardinality(e: ast.Call, scope: Scope) -> Value:
    """How many connections name a connector (Modelica 3.6, 3.7.4.3; deprecated)."""
    if len(e.args) != 1 or not isinstance(e.args[0], ast.Ref):
        raise Diagnostic("R050", "cardinality takes a connector", e.span, "write cardinality(port)")
    if len(connectors(e.args[0], scope)) > 1:
        hint = "ask for each element: cardinality(port[1])"
        raise Diagnostic("R050", f"cardinality of the array {e.args[0]}", e.span, hint)
    counts = scope.context.table(Structure).count(scope.context)
    return ex.const(max((counts[name] for name in _scalars(e.args[0], scope)), default=0))


def _scalars(ref: ast.Ref, scope: Scope) -> set[str]:
    return {part.end.name for node in connectors(ref, scope) for part in parts(node, False).values()}
