"""The syntax tree of a .mo file: what was written, with its place, and nothing resolved."""

from __future__ import annotations

from dataclasses import dataclass, field

from lacuna.codegen.errors import Span
from lacuna.codegen.syntax.expression_nodes import (
    ArrayLiteral as ArrayLiteral,
)
from lacuna.codegen.syntax.expression_nodes import (
    Binary as Binary,
)
from lacuna.codegen.syntax.expression_nodes import (
    Call as Call,
)
from lacuna.codegen.syntax.expression_nodes import (
    Colon as Colon,
)
from lacuna.codegen.syntax.expression_nodes import (
    Comprehension as Comprehension,
)
from lacuna.codegen.syntax.expression_nodes import (
    End as End,
)
from lacuna.codegen.syntax.expression_nodes import (
    Expression as Expression,
)
from lacuna.codegen.syntax.expression_nodes import (
    IfExpression as IfExpression,
)
from lacuna.codegen.syntax.expression_nodes import (
    Iterator as Iterator,
)
from lacuna.codegen.syntax.expression_nodes import (
    Literal as Literal,
)
from lacuna.codegen.syntax.expression_nodes import (
    MatrixLiteral as MatrixLiteral,
)
from lacuna.codegen.syntax.expression_nodes import (
    NoValue as NoValue,
)
from lacuna.codegen.syntax.expression_nodes import (
    Part as Part,
)
from lacuna.codegen.syntax.expression_nodes import (
    PartialFunction as PartialFunction,
)
from lacuna.codegen.syntax.expression_nodes import (
    Range as Range,
)
from lacuna.codegen.syntax.expression_nodes import (
    Ref as Ref,
)
from lacuna.codegen.syntax.expression_nodes import (
    Tuple as Tuple,
)
from lacuna.codegen.syntax.expression_nodes import (
    Unary as Unary,
)


@dataclass(slots=True, eq=False)
class Equality:
    span: Span
    left: Expression
    right: Expression
    text: str


@dataclass(slots=True, eq=False)
class Connect:
    span: Span
    left: Ref
    right: Ref


@dataclass(slots=True, eq=False)
class If:
    """If-equation or if-statement; the condition of `else` is None."""

    span: Span
    branches: list[tuple[Expression | None, list[Item]]]


@dataclass(slots=True, eq=False)
class For:
    span: Span
    iterators: list[Iterator]
    body: list[Item]


@dataclass(slots=True, eq=False)
class When:
    span: Span
    branches: list[tuple[Expression, list[Item]]]


@dataclass(slots=True, eq=False)
class Procedure:
    """A call that stands alone: assert(...), terminate(...), reinit(...)."""

    span: Span
    call: Call


@dataclass(slots=True, eq=False)
class Assignment:
    span: Span
    target: Ref | Tuple
    value: Expression
    text: str


@dataclass(slots=True, eq=False)
class While:
    span: Span
    condition: Expression
    body: list[Item]


@dataclass(slots=True, eq=False)
class Break:
    span: Span


@dataclass(slots=True, eq=False)
class Return:
    span: Span


Item = Equality | Connect | If | For | When | Procedure | Assignment | While | Break | Return


@dataclass(slots=True, eq=False)
class Section:
    span: Span
    algorithm: bool
    initial: bool
    items: list[Item]
    stray_breaks: list[Span] = field(default_factory=list)  # in no loop


@dataclass(slots=True, eq=False)
class Argument:
    """One entry of a modification: name(...) = value, or a redeclaration."""

    span: Span
    name: str
    modification: Modification
    each: bool = False
    final: bool = False
    redeclare: Component | Class | None = None
    replaces: bool = False  # written with `redeclare`; else with `replaceable` only


@dataclass(slots=True, eq=False)
class Modification:
    span: Span
    arguments: list[Argument] = field(default_factory=list)
    value: Expression | None = None
    left_out: list[Ref | Connect] = field(default_factory=list)  # of an extends clause: break NAME, break connect(a, b)


@dataclass(slots=True, eq=False)
class Component:
    span: Span
    name: str
    type: Ref
    dimensions: list[Expression]  # Colon where the size follows from the binding
    modification: Modification
    condition: Expression | None = None
    description: str = ""
    variability: str = ""  # parameter | constant | discrete
    causality: str = ""  # input | output
    flow: bool = False
    stream: bool = False
    final: bool = False
    protected: bool = False
    redeclares: bool = False  # an element written with `redeclare`, in place of an inherited one
    inner: bool = False
    outer: bool = False
    replaceable: bool = False
    constraint: Extends | None = None  # constrainedby CLASS(...)
    annotation: Modification | None = None


@dataclass(slots=True, eq=False)
class Import:
    """import A.B; of a list, import A.{B, C}, one of these for each name."""

    span: Span
    path: Ref
    alias: str  # "" for the last name of the path
    every: bool  # import A.B.*


@dataclass(slots=True, eq=False)
class Extends:
    span: Span
    base: Ref
    modification: Modification
    protected: bool = False


@dataclass(slots=True, eq=False)
class External:
    """external "C" y = f(x) annotation(...): the language, the call and what the annotation says."""

    span: Span
    language: str
    result: Ref | None = None
    function: str = ""  # "" where the function is called by its Modelica name
    args: list[Expression] = field(default_factory=list)
    annotation: Modification | None = None


@dataclass(slots=True, eq=False)
class Alias:
    """type A = B[n](...): a short class definition."""

    span: Span
    base: Ref
    dimensions: list[Expression]
    modification: Modification
    causality: str = ""
    target: Class | None = None  # the class meant, where no name was written


@dataclass(slots=True, eq=False)
class Class:
    span: Span
    kind: str  # model block connector record type package function class operator
    name: str
    partial: bool = False
    encapsulated: bool = False
    expandable: bool = False  # expandable connector
    operator: bool = False  # operator record, operator function
    impure: bool = False
    final: bool = False
    protected: bool = False
    inner: bool = False
    outer: bool = False
    replaceable: bool = False
    redeclares: bool = False  # written with `redeclare`, in place of an inherited class
    constraint: Extends | None = None  # constrainedby CLASS(...)
    extends_same: Modification | None = None  # of `model extends NAME(...)`: how the inherited NAME is modified
    derivative_of: tuple[Ref, tuple[str, ...]] | None = None  # function f = der(g, x, y)
    description: str = ""
    components: list[Component] = field(default_factory=list)
    extends: list[Extends] = field(default_factory=list)
    imports: list[Import] = field(default_factory=list)
    classes: dict[str, Class] = field(default_factory=dict)
    sections: list[Section] = field(default_factory=list)
    alias: Alias | None = None
    literals: tuple[tuple[str, str], ...] | None = None  # of an enumeration: name, description
    external: External | None = None
    annotation: Modification | None = None
    parent: Class | None = None
    within: str = ""
    # Of a class as seen from another (flatten/names/views.py):
    origin: Class | None = None
    redeclared: dict[str, Class] = field(default_factory=dict)
    whole: Class | None = None
    written: object = None  # the scope of its modifications
    constrained: tuple[Modification, Class] | None = None  # of a constraining clause, and where that stands
    stands_for: Class | None = None  # the class that it was redeclared in place of
    number: int = 1  # among the views that would have one path

    @property
    def path(self) -> str:
        """Full name, such as Lacuna.Electrical.Resistor."""
        name = self.name if self.number == 1 else f"{self.name}#{self.number}"
        if self.parent is not None and self.parent.name:
            return f"{self.parent.path}.{name}"
        return f"{self.within}.{name}" if self.within else name
