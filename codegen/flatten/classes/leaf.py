"""A declared variable of a primitive type, scalar or array, with its attributes and binding."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from math import prod

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.types import ATTRIBUTES, EXTERNAL, Type
from lacuna.codegen.flatten.expressions.constants import evaluate, is_parameter
from lacuna.codegen.flatten.expressions.enumerations import IndexType, literal
from lacuna.codegen.flatten.expressions.lower import modifier_value
from lacuna.codegen.flatten.names.component import Component
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Record, Value, indices, items_of, shape_of, shape_text
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast
from lacuna.suggest import did_you_mean


class Given(dict[str, Expr]):
    """Values from outside for elements of arrays, by their full names."""


class Leaf:
    """`names` are its scalars in row-major order: x, or x[1], x[2], ... ("A[1,2]" for a matrix)."""

    def __init__(
        self,
        context: Context,
        instance: Component,
        declaration: ast.Component,
        name: str,
        found: Type,
        shape: tuple[int, ...],
        modifier: Modifier,
        index_types: tuple[IndexType, ...] = (),
    ) -> None:
        self.instance, self.declaration, self.name, self.type = instance, declaration, name, found
        self.shape, self.modifier, self.index_types = shape, modifier, index_types
        self.span = declaration.span
        self.primitive = found.primitive
        self.variability = self._variability()
        self.causality = declaration.causality or found.causality or instance.causality
        self.flow, self.stream = declaration.flow or instance.flow, declaration.stream or instance.stream
        self.open_ended = instance.open_ended  # in an expandable connector: its direction follows from the connections
        self.relayed: set[str] = set()  # scalars that a connected expandable connector brought: driven elsewhere
        if shape:
            self.names = tuple(f"{name}[{','.join(map(str, i))}]" for i in indices(shape))
        else:
            self.names = (name,)
        self._binding: Value | None = None
        self._bound = self._lowering = False
        check_attributes(self.primitive, name, modifier)
        for position, scalar in enumerate(self.names):
            context.scalars[scalar] = (self, position)

    def _variability(self) -> str:
        """The stricter of the declaration's own and the surrounding component's."""
        order = ("constant", "parameter", "discrete", "")
        given = (self.declaration.variability, self.instance.variability)
        if self.primitive != "Real" and not any(given):
            return "discrete"
        return min(given, key=order.index) or "continuous"

    @property
    def is_structural(self) -> bool:
        return self.variability in ("constant", "parameter")

    @cached_property
    def is_free(self) -> bool:
        """A parameter that initial equations determine, in an array some of it; one with a binding has its value by
        that (8.6)."""
        free = self.variability == "parameter" and self.modifier.value is None
        return free and any(value is ex.FALSE for value in self.fixed)

    @cached_property
    def fixed(self) -> tuple[Expr | None, ...]:
        """The attribute of each element, known at translation: it decides which equations there are at the start."""
        found = self.attribute("fixed")
        if found is None:
            return (None,) * len(self.names)
        place, what = self.modifier.children["fixed"].span, f"fixed of {self.name}"
        return tuple(self._fixed(value, what, place) for value in items_of(found))

    def _fixed(self, value: Value, what: str, place: Span) -> Expr:
        context = self.instance.context
        if not isinstance(value, Expr) or value.type != ex.BOOLEAN:
            raise Diagnostic("R024", f"{what} is no Boolean", place, "write true or false")
        if not is_parameter(value, context):
            raise Diagnostic("R055", f"{what} varies in time", place, "use parameters and constants")
        constant = evaluate(value, context, place, what)
        if self.variability == "constant" and constant is ex.FALSE:
            hint = "declare it as a parameter, or leave fixed out"
            raise Diagnostic("R035", f"the constant {self.name} has fixed = false (8.6)", place, hint)
        return constant

    def value(self) -> Value:
        """The variable(s) as expressions; a String is its text."""
        if self.primitive in ("String", EXTERNAL):
            return self.text()
        if not self.shape:
            return ex.var(self.name, self.primitive)
        return self._elements

    @cached_property
    def _elements(self) -> Array:
        return Array(self.shape, tuple(ex.var(n, self.primitive) for n in self.names))

    def text(self) -> Value:
        value = self.binding()
        if value is None:
            hint = 'bind it: = "..."' if self.primitive == "String" else "bind it to a call of its constructor"
            raise Diagnostic("F020", f"the {self.primitive} {self.name} has no value", self.span, hint)
        return value

    def bind(self, value: ast.Expression, scope: Scope) -> None:
        """Take a value from an equation."""
        self.modifier = replace(self.modifier, value=value, scope=scope, index=())
        self._bound = False

    def binding(self) -> Value | None:
        """The value of its declaration equation or binding, checked for size and type; None where it has none."""
        if self._lowering:
            raise Diagnostic("F022", f"the value of {self.name} depends on itself", self.span, "break the circle")
        if not self._bound:
            self._lowering = True
            try:
                if self.modifier.value is not None:
                    self._binding = self._fit(
                        self._meant(modifier_value(self._holding())), self.modifier, "the binding"
                    )
                self._binding = self._with_given(self._binding)
            finally:
                self._lowering = False
            self._bound = True
        return self._binding

    def _with_given(self, value: Value | None) -> Value | None:
        """The value with the elements that are given from outside; where there is none, that of all of them."""
        given = {n: e for n, e in self.instance.context.table(Given).items() if n in self.names}
        if not given:
            return value
        if self.modifier.final:
            raise Diagnostic("R031", f"{self.name} is final and cannot be set", self.span, "remove the modification")
        items = [given.get(n) or self.element(value, k) for k, n in enumerate(self.names)]
        if None in items:
            return value
        found = tuple(self._number_for_type(i) if n in given else i for n, i in zip(self.names, items, strict=True))
        return Array(self.shape, found) if self.shape else found[0]

    def _meant(self, value: Value) -> Value:
        """A value that is given from outside as what it means for this type."""
        outside = self.modifier.scope is None and isinstance(value, Expr) and value.op == "const"
        return self._number_for_type(value) if outside else value

    def _number_for_type(self, value: Expr) -> Expr:
        """A number from outside, where there are numbers only: 0 and 1 are false and true, 1 to n the literals of an
        enumeration. Raises R024 for any other number."""
        if not (self.primitive == ex.BOOLEAN or self.type.literals):
            return value
        meanings = [literal(self.type.cls, n + 1) for n in range(len(self.type.literals))] or [ex.FALSE, ex.TRUE]
        for meaning in meanings:
            if float(meaning.value) == float(value.value):
                return meaning
        kind = f"{self.primitive}, and {value.value:g} is neither 0 nor 1"
        if self.type.literals:
            kind = f"of an enumeration of {len(meanings)} literals, and {value.value:g} is the number of none"
        hint = ", ".join(f"{n} is {name}" for n, name in enumerate(self.type.literals, 1)) or "0 is false, 1 is true"
        raise Diagnostic("R024", f"{self.name} is {kind}", self.span, hint)

    def _holding(self) -> Modifier:
        """The modifier whose value holds at all times where this is no parameter (12.3)."""
        if self.variability == "parameter" or self.modifier.scope is None:
            return self.modifier
        return replace(self.modifier, scope=replace(self.modifier.scope, pure=True))

    def attribute(self, name: str) -> Value | None:
        """One attribute of all elements (a scalar where the variable is one)."""
        child = self.modifier.children.get(name)
        if child is None or child.value is None:
            return None
        return self._fit(modifier_value(child), child, name)

    def _fit(self, value: Value, modifier: Modifier, what: str) -> Value:
        if isinstance(value, Record):
            hint = "use one field of it"
            raise Diagnostic("R041", f"a record for the {self.primitive} {self.name}", modifier.span, hint)
        if modifier.each and isinstance(value, Array) and not self.type.dimensions and what != "the binding":
            message = f"each {what} is an array of size {shape_text(value.shape)}, one element is wanted"
            raise Diagnostic("R036", message, modifier.span, "remove 'each', or give the value of one element")
        if shape_of(value) == self.shape:
            return value
        own = shape_of(value)
        if modifier.each and own and self.type.dimensions and self.shape[-len(own) :] == own:  # a type that is an array
            return Array(self.shape, items_of(value) * (prod(self.shape) // max(prod(own), 1)))
        if not isinstance(value, Array) and modifier.each:
            return Array(self.shape, (value,) * prod(self.shape))
        sizes = f"{self.name} has size {shape_text(self.shape)}, {what} {shape_text(shape_of(value))}"
        hint = f"write each {what} = ..." if what != "the binding" else "use fill(value, n)"
        if isinstance(value, Array):
            hint = "both need the same size"
        raise Diagnostic("R036", sizes, modifier.span, hint)

    def element(self, value: Value | None, position: int) -> Expr | str | None:
        return value.items[position] if isinstance(value, Array) else value


def check_attributes(primitive: str, variable: str, modifier: Modifier) -> None:
    """Raises R035 for what is said of a variable of a primitive type and is no attribute of it."""
    for name, child in modifier.children.items():
        if name not in ATTRIBUTES[primitive]:
            hint = did_you_mean(name, ATTRIBUTES[primitive], "see the attributes in docs/language.md")
            raise Diagnostic("R035", f"{primitive} has no attribute {name}", child.span, hint)
        inner = next(iter(child.children), None)
        if inner is not None:
            message = f"{name} of {variable} is a value and has no {inner}"
            raise Diagnostic("R035", message, child.span, f"{inner} is an attribute of the variable")
