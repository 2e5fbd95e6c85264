"""What one run of flattening shares: the library, the scalars by name, the findings."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
import hashlib
from pathlib import Path
from typing import Any, TypeVar

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flat import Function
from lacuna.codegen.flatten.names.component import Component, Variable
from lacuna.codegen.flatten.names.values import Value
from lacuna.codegen.library.classes import Library
from lacuna.codegen.symbolic.annotated import DerivativeRule
from lacuna.codegen.symbolic.expr import Expr
from lacuna.codegen.units.check import Body

T = TypeVar("T")
MAX_ERRORS = 10
MAX_ELEMENTS = 300_000


@dataclass(frozen=True)
class Lowering:
    """How each kind of expression becomes a value (see `lower`); the parts stand in files of their own."""

    nodes: Mapping[type, Callable[..., Value]]  # by kind of node
    functions: Mapping[str, Callable[..., Value]]  # built-in functions by name
    words: frozenset[str]  # what is called and is neither
    results: Callable[..., list[Value]]  # all results of the call of a function of the model
    overloaded: Callable[..., Value]  # an operator of operator records
    construct: Callable[..., Value]  # a call of a record
    text: Callable[..., Value | None]  # String of a record
    run: Callable[[str, list[Expr], Context, Span], Expr]  # a kept function on constants
    expanded: Callable[..., Value]  # a reduction in a model over a range that varies


@dataclass(slots=True)
class Attempt:
    """See `Context.attempt`. There is one for each item of a model: a generator takes three times as long."""

    context: Context

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: object) -> bool:
        if isinstance(error, Diagnostic):
            self.context.note(error)
        return isinstance(error, Diagnostic)


@dataclass
class Context:
    library: Library
    folder: Path  # of the model's file: data files are looked for here
    lowering: Lowering
    model: str = ""  # the name of the class that is flattened
    scalars: dict[str, tuple[Variable, int]] = field(default_factory=dict)
    packages: dict[int, Component] = field(default_factory=dict)
    functions: dict[str, Function] = field(default_factory=dict)
    evaluated: set[str] = field(default_factory=set)  # structural parameters: names of scalars
    evaluating: list[str] = field(default_factory=list)
    constants: dict[str, Expr] = field(default_factory=dict)  # values of those
    variabilities: dict[Expr, str] = field(default_factory=dict)
    places: dict[tuple[str, str], Span] = field(default_factory=dict)  # of bindings and attributes: (variable, which)
    argument_units: list[tuple[Expr, str, str, Span]] = field(default_factory=list)  # value, unit, what, where
    function_units: dict[str, str] = field(default_factory=dict)  # of the result, by name of a kept function
    literal_units: dict[str, str] = field(default_factory=dict)  # of results and of numbers given to inputs, by names
    bodies: list[Body] = field(default_factory=list)  # of functions, for the unit check
    body: Body | None = None  # the one that is being run for it
    derivatives: dict[str, list[DerivativeRule]] = field(default_factory=dict)  # of annotated values, by their keys
    calls: list[tuple[str, bool]] = field(default_factory=list)  # being inlined: of which function, if undecided
    elements: int = 0
    files: dict[str, str] = field(default_factory=dict)
    errors: list[Diagnostic] = field(default_factory=list)
    warnings: list[Diagnostic] = field(default_factory=list)
    tables: dict[type, Any] = field(default_factory=dict)

    def table(self, kind: type[T]) -> T:
        """The one `kind` of this run, made when first asked for: what a pass keeps for itself."""
        found = self.tables.get(kind)
        if found is None:
            found = self.tables[kind] = kind()
        return found

    def note_file(self, path: Path, content: bytes) -> None:
        """The model depends on this file from now on."""
        self.files[str(path)] = hashlib.sha256(content).hexdigest()

    def attempt(self) -> Attempt:
        """Collect a Diagnostic raised inside, so that independent findings come together."""
        return Attempt(self)

    def note(self, error: Diagnostic) -> None:
        """A finding, once. Raises the first where there are too many."""
        if all(str(error) != str(known) for known in self.errors):
            self.errors.append(error)
        if len(self.errors) >= MAX_ERRORS or self.elements > MAX_ELEMENTS:
            self.finish(whole=False)

    @contextmanager
    def nothing_inlined(self) -> Iterator[None]:
        """While a function is written that stays one: it may be called by those that it calls."""
        inlined, self.calls = self.calls, []
        try:
            yield
        finally:
            self.calls = inlined

    def spend(self, count: int, span: Span) -> None:
        """Count array elements and passes of loops. Raises F037 for a model out of all proportion."""
        self.elements += count
        if self.elements > MAX_ELEMENTS:
            hint = "are the sizes and ranges as meant?"
            raise Diagnostic("F037", f"more than {MAX_ELEMENTS} array elements and loop passes", span, hint)

    def finish(self, whole: bool = True) -> None:
        """Raise the first finding, which carries the others, if there was any; `whole`: there are no more of them."""
        if self.errors:
            first = self.errors[0]
            first.others = self.errors[1:]
            first.cut = not whole
            raise first
