"""The flat model: what `flatten` hands to the structural passes. Scalars and full names only.

Guaranteed here: no components, connections, arrays or inheritance are left (an array element is the scalar
"phase[2].i"); structural parameters are evaluated; if-equations have become if-expressions; algorithm
sections without `when` have become equations; bindings of continuous and discrete variables have become
equations; enumerations are Integers; every name used is in `variables`; every equation is scalar, typed
and dimensionally checked.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flat.foreign import Foreign, ForeignCode
from lacuna.codegen.symbolic.annotated import Rules
from lacuna.codegen.symbolic.expr import REAL, Expr

CONSTANT, PARAMETER, DISCRETE, CONTINUOUS = "constant", "parameter", "discrete", "continuous"


@dataclass
class Variable:
    name: str
    span: Span
    type: str = REAL  # Real | Integer | Boolean
    variability: str = CONTINUOUS  # constant | parameter | discrete | continuous
    causality: str = "local"  # local | input | output  (inputs of the top-level model only)
    binding: Expr | None = None  # of a constant or a parameter
    start: Expr | None = None
    start_at: Span | None = None  # where the start value is written, if not at the declaration
    fixed: Expr | None = None  # Boolean; None where not given
    min: Expr | None = None
    max: Expr | None = None
    nominal: Expr | None = None
    unit: str = ""
    inferred_unit: str = ""  # what the equations say where no unit is declared
    quantity: str = ""
    state_select: str = "default"  # never | avoid | default | prefer | always
    description: str = ""
    enumeration: tuple[str, ...] = ()  # literal names, where the type is an enumeration (values from 1)
    final: bool = False
    free: bool = False  # a parameter that the initial system is to find: it stands still after the start
    evaluated: bool = False  # a structural parameter: its value is part of the structure, not changeable
    awaited: bool = False  # an input of a component without a value of its own: something outside of it has to give one
    hidden: bool = False  # protected in a component: the model does not see it, nor does one that extends that

    @property
    def start_span(self) -> Span:
        """Where the start value is written."""
        return self.start_at or self.span


@dataclass
class Equation:
    """lhs = rhs, scalar; Real, Integer or Boolean."""

    lhs: Expr
    rhs: Expr
    span: Span
    origin: str = ""  # path of the component it belongs to, "" for the model itself
    text: str = ""  # as written, for comments and messages
    start: tuple[Expr, Expr] | None = None  # both sides at the start, where homotopy makes them others
    branches: tuple[tuple[Expr, Equation], ...] = ()  # of an if-equation, as written: for the check of units alone


@dataclass
class Assign:
    target: str
    value: Expr
    span: Span


@dataclass
class AssignCall:
    """(a, b, ...) := f(...): several results of one function; None skips one."""

    targets: tuple[str | None, ...]
    value: Expr
    span: Span


@dataclass
class AssignElement:
    """Functions only: target[index] := value with an index known at run time (1-based)."""

    target: str
    indices: tuple[Expr, ...]
    value: Expr
    span: Span


@dataclass
class Reinit:
    target: str
    value: Expr
    span: Span


@dataclass
class Assert:
    condition: Expr
    message: str
    span: Span
    level: str = "error"  # error | warning
    origin: str = ""
    shown: tuple[str, ...] = ()  # variables in the message


@dataclass
class Terminate:
    message: str
    span: Span


@dataclass
class If:
    """Branches in order; the condition of a final `else` is the constant true."""

    branches: list[tuple[Expr, list[Statement]]]
    span: Span


@dataclass
class While:
    condition: Expr
    body: list[Statement]
    span: Span


@dataclass
class For:
    """Functions only (elsewhere loops are unrolled): variable from first to last by step."""

    variable: str
    first: Expr
    step: Expr
    last: Expr
    body: list[Statement]
    span: Span


@dataclass
class Native:
    """Functions only: a C function of the generated file, given inputs, then places of outputs."""

    function: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    span: Span


@dataclass
class Return:
    span: Span


@dataclass
class Break:
    span: Span


@dataclass
class When:
    """when c1 then ... elsewhen c2 then ... ; each branch fires on the rising edge of its condition.

    In an equation section the statements are Assign, Reinit, Assert, Terminate, If with Reinit/Assert/Terminate
    or balanced assignments; in an algorithm also If and nested assignments in order.
    """

    branches: list[tuple[Expr, list[Statement]]]
    span: Span
    origin: str = ""


Statement = (
    Assign | AssignCall | AssignElement | Native | Foreign | Reinit | Assert | Terminate
    | If | While | For | Return | Break | When
)  # fmt: skip


@dataclass
class Algorithm:
    """An algorithm section with `when`: statements in order, run at events; it assigns discrete variables."""

    statements: list[Statement]
    targets: tuple[str, ...]
    span: Span
    origin: str = ""


@dataclass
class Function:
    """A function of the model, specialised to the array sizes of its calls (`name` is unique per sizes).

    `locals` holds inputs, outputs and protected variables; `shape` () for a scalar. An element with a constant or
    run-time index is read as call("[]", var(name), index...) with 1-based indices.
    """

    name: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    shapes: dict[str, tuple[int, ...]]
    types: dict[str, str]
    defaults: dict[str, Expr]  # declared values of outputs and protected variables, where given
    body: list[Statement]
    span: Span


@dataclass
class Experiment:
    start_time: float = 0.0
    stop_time: float = 1.0
    tolerance: float = 1e-6
    interval: float | None = None


@dataclass
class FlatModel:
    name: str
    span: Span
    description: str = ""
    variables: dict[str, Variable] = field(default_factory=dict)
    equations: list[Equation] = field(default_factory=list)
    initial_equations: list[Equation] = field(default_factory=list)
    whens: list[When] = field(default_factory=list)
    algorithms: list[Algorithm] = field(default_factory=list)
    asserts: list[Assert] = field(default_factory=list)
    functions: dict[str, Function] = field(default_factory=dict)
    experiment: Experiment = field(default_factory=Experiment)
    files: dict[str, str] = field(default_factory=dict)  # every file read -> SHA-256 of its text
    warnings: list[Diagnostic] = field(default_factory=list)
    foreign: ForeignCode = field(default_factory=ForeignCode)
    derivatives: Rules = field(default_factory=dict)  # of the annotated values in the equations
