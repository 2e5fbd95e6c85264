"""Dimensional check of a flat model: every equation, binding, attribute, assignment and argument."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.symbolic.annotated import meant_by
from lacuna.codegen.symbolic.expr import REAL, Expr, to_text, var
from lacuna.codegen.units.inference import UNKNOWN, Finding, UnitError, UnitInference, of_variable
from lacuna.codegen.units.undeclared import Undeclared
from lacuna.units import Unit, UnknownSymbol, factors_of, format_unit, is_standard, of_factors, parse_unit

MAX_FINDINGS = 10  # of a model's own
MAX_COUNTED = 1000  # of libraries
Required = tuple[Expr, str, str, Span]  # value, declared unit, which input of which function, where


@dataclass
class Body:
    """A function's body on names in place of its variables: the units of these, and what values are to have."""

    units: dict[str, str] = field(default_factory=dict)
    values: list[Required] = field(default_factory=list)


def check_units(
    model: flat.FlatModel,
    arguments: Iterable[Required] = (),
    function_units: dict[str, str] | None = None,
    places: dict[tuple[str, str], Span] | None = None,
    package: Callable[[str], str] = lambda file: "",
    literals: dict[str, str] | None = None,
    bodies: Iterable[Body] = (),
) -> list[Diagnostic]:
    """Every finding, one a place, in order of the model; at most MAX_FINDINGS of a severity, those in libraries
    aside, which `package` tells by their name. Without any unit there is no check.

    `arguments` are values given to inputs with a unit; `function_units` the units of results by function;
    `places` says where the binding or an attribute of a variable was written, where not in its declaration; `literals`
    are the units of results of functions and of numbers given to their inputs, by the names that marked values have
    for them; `bodies` those of the functions.
    """
    if not any(v.unit for v in model.variables.values()):
        return []
    check = _Check(model, function_units or {}, places or {}, package)
    check.units |= {name: parse_unit(unit) for name, unit in (literals or {}).items()}
    return check.run(arguments, bodies)


def drop_unread(model: flat.FlatModel) -> None:
    """Variables whose unit cannot be read declare none to all that comes after the check."""
    for v in model.variables.values():
        try:
            if v.unit:
                parse_unit(v.unit)
        except ValueError:
            v.unit = ""


def _as_written(equations: Iterable[flat.Equation]) -> Iterator[flat.Equation]:
    """Those of the branches of an if-equation, each of which has units of its own (8.3.4), behind it."""
    for e in equations:
        yield e
        yield from _as_written(branch for _, branch in e.branches)


def without_branches(model: flat.FlatModel) -> None:
    """Nothing but the check of units looks at them."""
    for e in (*model.equations, *model.initial_equations):
        e.branches = ()


class _Check:
    def __init__(
        self,
        model: flat.FlatModel,
        function_units: dict[str, str],
        places: dict[tuple[str, str], Span],
        package: Callable[[str], str],
    ) -> None:
        self.package, self.counts = package, Counter()
        self.seen: set[tuple[str, Span]] = set()
        self.model, self.function_units, self.places = model, function_units, places
        self.findings: list[Diagnostic] = []
        self.units: dict[str, Finding] = {}
        for v in model.variables.values():
            try:
                self.units[v.name] = of_variable(v.unit, v.type, v.variability)
                self._notation(v)
            except UnknownSymbol as reason:
                self.units[v.name] = UNKNOWN
                message = f"{v.name}: {reason}: what is in it is not checked"
                hint = "products are written N.m, quotients rad/s"
                self._note(Diagnostic("W015", message, v.span, hint, severity="warning"))
            except ValueError as reason:
                self.units[v.name] = UNKNOWN
                self._note(Diagnostic("U005", f"{v.name}: {reason}", v.span, 'such as "N.m.s/rad"'))

    def _notation(self, v: flat.Variable) -> None:
        """A warning where a declared unit is written otherwise than the language writes units."""
        if v.unit and not is_standard(v.unit):
            meant = of_factors(factors_of(v.unit))
            message = f"{v.name}: {v.unit!r} is no unit as the language writes them (19.1), and is read as {meant}"
            self._note(Diagnostic("W014", message, v.span, f'unit="{meant}"', severity="warning"))

    def run(self, arguments: Iterable[Required], bodies: Iterable[Body]) -> list[Diagnostic]:
        arguments = list(arguments)
        self._take_of_inputs(arguments)
        if UNKNOWN in self.units.values():
            Undeclared(self.units, self._inference).infer(self._pairs())
        inference = self._inference()
        for e in _as_written((*self.model.equations, *self.model.initial_equations)):
            self._equation(inference, e)
        for v in self.model.variables.values():
            self._variable(inference, v)
        for w in self.model.whens:
            self._statements(inference, [w])
        for a in self.model.algorithms:
            self._statements(inference, a.statements)
        self._statements(inference, self.model.asserts)
        self._required(inference, arguments)
        for body in bodies:
            known = {name: parse_unit(unit) if unit else UNKNOWN for name, unit in body.units.items()}
            self._required(self._inference(self.units | known), body.values)
        self._note_inferred()
        return self.findings

    def _required(self, inference: UnitInference, values: Iterable[Required]) -> None:
        for value, unit, what, span in values:
            self._guarded(span, lambda v=value, u=unit, w=what: inference.require(v, parse_unit(u), w))

    def _inference(self, units: Mapping[str, Finding] | None = None) -> UnitInference:
        known = self.units if units is None else units
        return UnitInference(lambda e: known.get(str(e.value), UNKNOWN), lambda name: self.function_units.get(name, ""))

    def _guarded(self, span: Span, action: Callable[[], object], text: Callable[[], str] | None = None) -> None:
        try:
            action()
        except UnitError as reason:
            message = reason.message + (f"\n    in the equation {text()}" if text is not None else "")
            finding = Diagnostic(reason.code, message, span, reason.hint, severity=reason.severity)
            self._note(finding)
        except ValueError as reason:
            self._note(Diagnostic("U005", str(reason), span, 'such as "N.m.s/rad"'))

    def _note(self, finding: Diagnostic) -> None:
        foreign = bool(self.package(finding.span.file))
        limit = MAX_COUNTED if foreign else MAX_FINDINGS
        kind = foreign, finding.severity
        if (finding.code, finding.span) not in self.seen and self.counts[kind] < limit:
            self.seen.add((finding.code, finding.span))
            self.counts[kind] += 1
            self.findings.append(finding)

    def _equation(self, inference: UnitInference, e: flat.Equation) -> None:
        def text() -> str:
            whole = f"{to_text(e.lhs)} = {to_text(e.rhs)}"
            return whole if len(whole) <= 160 else e.text

        for condition, _ in e.branches:
            self._guarded(e.span, lambda c=condition: inference.of(c))
        if not e.branches:
            self._guarded(e.span, lambda: self._sides(inference, e.lhs, e.rhs), text)

    @staticmethod
    def _sides(inference: UnitInference, lhs: Expr, rhs: Expr) -> None:
        left, right = inference.of(lhs), inference.of(rhs)
        if isinstance(left, Unit) and isinstance(right, Unit) and not left.same(right):
            raise inference.disagreement("U001", "left and right", lhs, left, rhs, right)

    def _variable(self, inference: UnitInference, v: flat.Variable) -> None:
        own = self.units[v.name]
        for what in ("binding", "start", "min", "max", "nominal"):
            value = getattr(v, what)
            if value is not None:
                span = self.places.get((v.name, what), v.span)
                self._guarded(span, lambda x=value, w=what: self._value(inference, v.name, own, x, w))

    @staticmethod
    def _value(inference: UnitInference, name: str, own: Finding, value: Expr, what: str) -> None:
        found = inference.of(value)
        if isinstance(own, Unit) and isinstance(found, Unit) and not own.same(found):
            raise inference.disagreement("U001", f"{name} and its {what}", var(name), own, value, found)

    def _statements(self, inference: UnitInference, body: Iterable[flat.Statement]) -> None:
        for s in body:
            match s:
                case flat.Assign() | flat.Reinit():
                    target = var(s.target)
                    self._guarded(
                        s.span, lambda t=target, v=s.value: self._sides(inference, t, v),
                        lambda s=s: f"{s.target} = {to_text(s.value)}",
                    )  # fmt: skip
                case flat.Assert():
                    self._guarded(s.span, lambda c=s.condition: inference.of(c))
                case flat.If() | flat.When():
                    for condition, inner in s.branches:
                        self._guarded(s.span, lambda c=condition: inference.of(c))
                        self._statements(inference, inner)
                case flat.While():
                    self._guarded(s.span, lambda c=s.condition: inference.of(c))
                    self._statements(inference, s.body)

    def _note_inferred(self) -> None:
        """The SI units that were found for variables that declare none."""
        for v in self.model.variables.values():
            found = self.units[v.name]
            if not v.unit and v.type == REAL and isinstance(found, Unit) and found.factor == 1.0:
                v.inferred_unit = format_unit(found)

    def _take_of_inputs(self, arguments: list[Required]) -> None:
        """A variable without a unit that is handed to a function has that of the input."""
        for value, unit, _, _ in arguments:
            if value.op == "var" and self.units.get(str(value.value)) == UNKNOWN:
                with suppress(ValueError):  # told where the argument is checked
                    self.units[str(value.value)] = parse_unit(unit)

    def _pairs(self) -> list[tuple[Expr, Expr]]:
        """Sides of equations, and variables with what is bound to them, that may tell a unit."""
        pairs = [(e.lhs, e.rhs) for e in _as_written(self.model.equations) if not e.branches]
        bound = ((v.name, v.binding) for v in self.model.variables.values() if v.binding is not None)
        return pairs + [
            (var(n), b) for n, b in bound if self.units[n] == UNKNOWN and (b.op != "const" or meant_by(b) is not None)
        ]
