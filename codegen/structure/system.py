"""Equations and unknowns as the structural passes see them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from zlib import crc32

from lacuna.codegen import flat
from lacuna.codegen.symbolic.evaluate import Value, evaluate
from lacuna.codegen.symbolic.expr import REAL, Expr, der, sub, to_text, var
from lacuna.codegen.symbolic.function_value import call_value
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import Rewriter


@dataclass(eq=False)
class Row:
    """One scalar continuous equation lhs = rhs."""

    lhs: Expr
    rhs: Expr
    source: flat.Equation
    integral: Row | None = None  # the equation that this one is the time derivative of

    @cached_property
    def residual(self) -> Expr:
        return sub(self.lhs, self.rhs)

    @cached_property
    def leaves(self) -> frozenset[Expr]:
        return leaves(self.lhs) | leaves(self.rhs)

    @property
    def text(self) -> str:
        text = self.source.text or f"{self.source.lhs} = {self.source.rhs}"
        row, order = self, 0
        while row.integral is not None:
            row, order = row.integral, order + 1
        return text if not order else f"{'d' * order}/{'dt' * order} of  {text}"


@dataclass(frozen=True)
class Switch:
    """left > right where the choice of states is made anew, which the algorithms of the model do."""

    left: Expr
    right: Expr
    source: flat.Equation
    text: str

    def rewritten(self, rewriter: Rewriter) -> Switch:
        return replace(self, left=rewriter.expression(self.left), right=rewriter.expression(self.right))


@dataclass
class System:
    """A square system in derivatives of the states and in algebraic variables (an index-reduced DAE)."""

    model: flat.FlatModel
    rows: list[Row]
    states: list[str]
    algebraics: list[str]
    dummies: list[str]  # algebraic variables that were derivatives before
    renamed: Rewriter  # from the derivatives of the flat model to the derivatives and variables of this system
    switches: list[Switch] = field(default_factory=list)  # of dynamic choices of states
    dynamic: list[str] = field(default_factory=list)  # states that stand now for this, now for that variable
    preferred: list[str] = field(default_factory=list)  # and for these at the start
    differentiated: list[tuple[Expr, Expr]] = field(default_factory=list)  # variables with derivatives that are dummies

    @cached_property
    def derivatives(self) -> list[Expr]:
        return [der(var(name)) for name in self.states]

    @cached_property
    def unknowns(self) -> list[Expr]:
        """Unknowns of the explicit form, in storage order."""
        return [*self.derivatives, *map(var, self.algebraics)]


class DeclaredValues:
    """Values that variables have as declared: parameters from their bindings, others from their start attribute."""

    def __init__(self, model: flat.FlatModel):
        self._model = model
        self._memo: dict[str, float | int | bool | None] = {}

    def __call__(self, e: Expr) -> float | None:
        """The value of `e`, with relations taken as false; None where it has none."""
        return evaluate(e, self._leaf, self._function)

    def _function(self, e: Expr, value: Callable[[Expr], Value | None]) -> Value | None:
        return call_value(e, value, self._model.functions)

    def parametric(self, e: Expr) -> float | None:
        """The value of an expression in parameters only, else None."""
        names = [str(n.value) for n in leaves(e) if n.op == "var"]
        fixed = all(self._model.variables[n].variability in (flat.CONSTANT, flat.PARAMETER) for n in names)
        return self(e) if fixed and all(n.op == "var" for n in leaves(e)) else None

    def guess(self, n: Expr) -> bool:
        """Whether a variable declares a start value of its own, one that an undeclared one would not have."""
        return n.op == "var" and self._model.variables[str(n.value)].start is not None and self(n) != 0.0

    def unit(self, n: Expr) -> str:
        """The declared unit of a variable, or of the variable that a derivative is of."""
        while n.op == "der":
            n = n.args[0]
        return self._model.variables[str(n.value)].unit

    def variable(self, name: str) -> float | int | bool | None:
        if name not in self._memo:
            self._memo[name] = None  # ends a cycle of start attributes
            v = self._model.variables[name]
            given = v.binding if v.variability in (flat.CONSTANT, flat.PARAMETER) else None
            given = given if given is not None else v.start
            default: float | int | bool = 0.0 if v.type == REAL else False if v.type == "Boolean" else 0
            if given is None and v.enumeration:
                default = 1
            self._memo[name] = default if given is None else self(given)
        return self._memo[name]

    def _leaf(self, n: Expr) -> float | int | bool | None:
        if n.op == "var":
            return self.variable(str(n.value))
        if n.op == "pre":
            return self.variable(str(n.args[0].value))
        return 0.0 if n.op in ("der", "time", "start_time") else False


class DefinedValues(DeclaredValues):
    """As declared, but a variable without a start value has what its own equation `v = e` gives it from the others:
    the elements of a rotation matrix are those at the start angle, not zero."""

    def __init__(self, model: flat.FlatModel, rows: Sequence[Row]):
        super().__init__(model)
        self._definitions: dict[str, Expr] = {}
        for row in rows:
            if row.integral is None and row.lhs.op == "var" and all(n.op in ("var", "time") for n in row.leaves):
                self._definitions.setdefault(str(row.lhs.value), row.rhs)

    def variable(self, name: str) -> float | int | bool | None:
        if name not in self._memo and self._model.variables[name].start is None and name in self._definitions:
            self._memo[name] = 0.0  # ends a cycle
            self._memo[name] = self(self._definitions[name])
        return super().variable(name)


class GenericValues(DefinedValues):
    """As defined, but no two variables lie where it happens to suit: where start values make constraints degenerate
    (a circuit without current, an angle of zero), those of the neighbourhood tell what the constraints determine.

    Each variable is moved by a fixed share of its own size, derivatives too. The shares are in [1/4, 3/4] and drawn by
    name, so that equal models give equal choices.
    """

    def variable(self, name: str) -> float | int | bool | None:
        v, value = self._model.variables[name], super().variable(name)
        if v.type != REAL or v.variability != flat.CONTINUOUS or value is None:
            return value
        return value + (abs(value) or (v.nominal and self(v.nominal)) or 1.0) * _share(name)

    def _leaf(self, n: Expr) -> float | int | bool | None:
        return _share(to_text(n)) if n.op == "der" else super()._leaf(n)


def _share(name: str) -> float:
    return 0.25 + crc32(name.encode()) / 2**33
