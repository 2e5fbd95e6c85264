"""The syntax tree of expressions; part of `ast`."""

from __future__ import annotations

from dataclasses import dataclass, field

from lacuna.codegen.errors import Span


@dataclass(slots=True, eq=False)
class Literal:
    span: Span
    value: float | int | bool | str


@dataclass(slots=True, eq=False)
class Ref:
    """A name such as motor.phase[2].i: identifiers, each with its subscripts (None where there are none)."""

    span: Span
    names: tuple[str, ...]
    subscripts: tuple[tuple[Expression, ...] | None, ...]
    absolute: bool = False  # written with a leading dot

    def __str__(self) -> str:
        return ".".join(self.names)


@dataclass(slots=True, eq=False)
class Call:
    span: Span
    function: Ref
    args: list[Expression]
    named: dict[str, Expression] = field(default_factory=dict)


@dataclass(slots=True, eq=False)
class PartialFunction:
    """function f(a = 1) as an argument: a function with some of its inputs given (Modelica 3.6, 12.4.2.1)."""

    span: Span
    function: Ref
    named: dict[str, Expression] = field(default_factory=dict)


@dataclass(slots=True, eq=False)
class Part:
    """(e)[1, :] or (e).name: elements of the value of an expression in parentheses."""

    span: Span
    whole: Expression
    subscripts: tuple[Expression, ...] | None = None
    name: str = ""


@dataclass(slots=True, eq=False)
class NoValue:
    """`break` in the place of a modification's value: what is declared there is taken away (7.2.7)."""

    span: Span


@dataclass(slots=True, eq=False)
class Unary:
    span: Span
    op: str  # - + not .- .+
    operand: Expression


@dataclass(slots=True, eq=False)
class Binary:
    span: Span  # of the operator
    op: str
    left: Expression
    right: Expression


@dataclass(slots=True, eq=False)
class IfExpression:
    span: Span
    branches: list[tuple[Expression, Expression]]
    otherwise: Expression


@dataclass(slots=True, eq=False)
class ArrayLiteral:
    """{a, b, c}"""

    span: Span
    elements: list[Expression]


@dataclass(slots=True, eq=False)
class MatrixLiteral:
    """[a, b; c, d]"""

    span: Span
    rows: list[list[Expression]]


@dataclass(slots=True, eq=False)
class Range:
    span: Span
    first: Expression
    step: Expression | None
    last: Expression


@dataclass(slots=True, eq=False)
class Iterator:
    span: Span
    name: str
    range: Expression | None  # None: what the name is used as a subscript of decides it (11.2.2.1)


@dataclass(slots=True, eq=False)
class Comprehension:
    """e for i in a:b, j in c:d (the argument of a reduction, or the inside of braces)."""

    span: Span
    body: Expression
    iterators: list[Iterator]
    braces: bool = False  # {e for i in r}: an array, whatever it is an argument of


@dataclass(slots=True, eq=False)
class Colon:
    span: Span


@dataclass(slots=True, eq=False)
class End:
    span: Span


@dataclass(slots=True, eq=False)
class Tuple:
    """(a, , c) on the left of a call with several results; None skips one."""

    span: Span
    items: list[Expression | None]


Expression = (
    Literal | Ref | Call | Unary | Binary | IfExpression | ArrayLiteral | MatrixLiteral | Range | Comprehension
    | Colon | End | Tuple | PartialFunction | Part | NoValue
)  # fmt: skip
