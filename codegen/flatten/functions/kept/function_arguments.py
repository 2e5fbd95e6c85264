"""Functions as arguments of functions that run at run time (Modelica 3.6, 12.4.2). A function is made anew for each
function that it is given; what that one has bound varies, and becomes inputs: `f.a` of `function f(a = x)`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from lacuna.codegen.flatten.classes.types import Type
from lacuna.codegen.flatten.functions.locals import Signature, inputs_of
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.values import FunctionValue, Value, scalars
from lacuna.codegen.symbolic.expr import REAL, Expr


@dataclass
class FunctionArguments:
    """The functions among the arguments of a call, and what they have bound and is a number of the call."""

    functions: dict[str, FunctionValue] = field(default_factory=dict)
    kinds: dict[str, Type] = field(default_factory=dict)  # declared types of what is bound, by `input.name`
    bound: dict[str, Value] = field(default_factory=dict)

    @property
    def names(self) -> str:
        """The functions as part of a name, with what decides their course and is known."""
        return "; ".join(f"{n} = {self._name(n, f)}" for n, f in self.functions.items())

    def _name(self, name: str, function: FunctionValue) -> str:
        parts = []
        for n, value in function.bound.items():
            if isinstance(value, FunctionValue):
                parts.append(f"{n} = {self._name(f'{name}.{n}', value)}")
            elif f"{name}.{n}" not in self.bound:
                parts.append(f"{n} = {', '.join(str(getattr(s, 'value', s)) for s in scalars(value))}")
        return f"{function.cls.path}({', '.join(parts)})" if parts else function.cls.path

    def values(self, variables: dict[str, Value]) -> dict[str, Value]:
        """The functions by their inputs, what is bound replaced by the `variables` of the same names."""
        return {n: _bound_to(n, f, lambda name, value: variables.get(name, value)) for n, f in self.functions.items()}


def split(signature: Signature, arguments: dict[str, Value], context: Context) -> FunctionArguments:
    """What functions are among `arguments`."""
    result = FunctionArguments({n: v for n, v in arguments.items() if isinstance(v, FunctionValue)})

    def note(name: str, function: FunctionValue) -> None:
        kinds = {i.name: i.type for i in inputs_of(function.cls, context)}
        for n, value in function.bound.items():
            if isinstance(value, FunctionValue):
                note(f"{name}.{n}", value)
            elif not _decides_its_course(value):
                result.bound[f"{name}.{n}"], result.kinds[f"{name}.{n}"] = value, kinds[n]

    for name, function in result.functions.items():
        note(name, function)
    return result


def _bound_to(name: str, function: FunctionValue, new: Callable[[str, Value], Value]) -> FunctionValue:
    def replaced(n: str, value: Value) -> Value:
        return _bound_to(n, value, new) if isinstance(value, FunctionValue) else new(n, value)

    return FunctionValue(function.cls, {n: replaced(f"{name}.{n}", v) for n, v in function.bound.items()})


def _decides_its_course(value: Value) -> bool:
    """Texts, and numbers of no continuous kind that are known: sizes and branches may follow them."""
    return all(
        isinstance(s, str) or (isinstance(s, Expr) and s.op == "const" and s.type != REAL) for s in scalars(value)
    )
