"""What the passes of flattening know of a component and of a variable, without knowing how they come about.

`instance.Instance` and `leaf.Leaf` are the classes that answer to these; names are looked up, modifications kept and
values found through them, so that none of those passes depends on the instance tree, which depends on all of them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from lacuna.codegen.errors import Span
from lacuna.codegen.flatten.names.values import Value
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.syntax import ast


class Kind(Protocol):
    """The type of a variable: the class of its enumeration with its literals, where it is of one."""

    cls: ast.Class | None
    literals: tuple[str, ...]


class Component(Protocol):
    """An instance of a structured class."""

    name: str
    cls: ast.Class
    variability: str
    parent: Component | None
    causality: str  # input, output or "", of itself or of what it is part of; so are the next two
    flow: bool
    stream: bool
    open_ended: bool  # itself or part of an expandable connector
    elements: Mapping[str, object]  # by name: what it declares and inherits
    classes: Sequence[ast.Class]  # its own and those it inherits

    def sees(self, name: str, cls: ast.Class) -> bool:
        """May what is written in `cls`, itself or a base of it, use the element `name`?"""

    def meant(self, name: str) -> object | None:
        """What `name` means to those who use it; of an element that is inner and outer, the outer one."""

    def child(self, name: str) -> object | None:
        """The component `name` of it, None where no such is declared."""


class Variable(Protocol):
    """A declared variable of a primitive type, scalar or array."""

    span: Span
    type: Kind
    variability: str
    is_structural: bool
    is_free: bool  # a parameter with fixed = false

    def binding(self) -> Value | None:
        """Its value by declaration equation or modification."""

    def attribute(self, name: str) -> Value | None:
        """One attribute of all its elements."""

    def element(self, value: Value | None, position: int) -> Expr | str | None:
        """The part of a binding or an attribute that belongs to one of its scalars."""
