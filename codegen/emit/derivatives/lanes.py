"""Directional derivatives as C: coefficients in front, then one loop over the directions of a bundle.

The tangent of y = e(a, b) is d_y = (de/da) d_a + (de/db) d_b. The partial derivatives do not depend on the direction:
they are computed once; in the loop stands a sum of products for each equation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from lacuna.codegen import flat
from lacuna.codegen.dae.storage import Storage
from lacuna.codegen.emit.text.body import Body
from lacuna.codegen.emit.text.expression import number
from lacuna.codegen.emit.text.steps import comment
from lacuna.codegen.structure.causal import Division, LinearBlock, NonlinearBlock, Step, unknowns_of
from lacuna.codegen.structure.sorting.tearing import Assignment
from lacuna.codegen.structure.system import Row
from lacuna.codegen.symbolic.expr import Expr, is_const, mul, neg, sub, var
from lacuna.codegen.symbolic.gradient import Gradients, Terms

Place = Callable[[Expr], str | None]  # the row of a leaf's tangents, such as "v[3]"; None where it has none


class Lanes:
    """The loop of one function; `place` says where tangents are kept. Coefficients go into `body`, which must know
    them (`Body.plan`) before the first is written."""

    def __init__(self, body: Body, gradients: Gradients, place: Place, equation_index: Callable[[flat.Equation], int]):
        self._body, self._gradients, self._place, self._equation_index = body, gradients, place, equation_index
        self._names: dict[Expr, str] = {}
        self._arrays: dict[str, str] = {}
        self._arguments: set[str] = set()
        self._loads: list[str] = []
        self._lines: list[str] = []
        self._coefficients = 0
        self._comment = ""

    def given(self, *arrays: str) -> None:
        """Rows that are arguments of the function rather than part of the bundle."""
        self._arguments.update(arrays)

    # -- what the loop computes -------------------------------------------------------------------------------

    def steps(self, needed: Mapping[Step, set[Expr]]) -> None:
        """Tangents of what is needed of each step's unknowns; the unknowns themselves are known at the point."""
        for step, unknowns in needed.items():
            match step:
                case Assignment():
                    self.define(step.unknown, self._gradients(step.value), step.row)
                case Division():
                    self._division(step)
                case LinearBlock():
                    self._block(step, step.matrix, unknowns)
                case NonlinearBlock():
                    self._block(step, step.jacobian, unknowns)

    def coefficients(self, steps: list[Step]) -> list[Expr]:
        """What the function of these steps has to plan."""
        found: list[Expr] = []
        for step in steps:
            match step:
                case Assignment():
                    found += _coefficients(self._gradients(step.value))
                case Division():
                    found += [*_coefficients(self._quotient(step)), step.denominator]
                case LinearBlock() | NonlinearBlock():
                    inner = [row.residual for row in step.residuals] + [a.value for a in step.assignments]
                    found += [d for e in inner for d in _coefficients(self._gradients(e))]
                    matrix = step.matrix if isinstance(step, LinearBlock) else step.jacobian
                    found += [a for line in matrix for a in line]
        return found

    def define(self, leaf: Expr, terms: Terms, row: Row | None = None) -> None:
        """The tangent of a leaf as a local of the loop."""
        self.note(row)
        name = self._identifier(leaf)
        self._lines.append(f"const mdl_lanes {name} = {self.sum(terms)};")
        self._names[leaf] = name

    def store(self, leaf: Expr) -> None:
        """Write the local of a leaf to its row."""
        place = self._place(leaf)
        assert place is not None, leaf
        self._lines.append(f"{self.row(place)} = {self._names[leaf]};")

    def write(self, place: str, terms: Terms) -> None:
        self._lines.append(f"{self.row(place)} = {self.sum(terms)};")

    def note(self, row: Row | None) -> None:
        text = comment(row.source, row.text) if row else ""
        if text and text != self._comment:
            self._lines.append(text)
        self._comment = text

    def finish(self) -> None:
        """Put the loop at the end of the body."""
        if not self._lines:
            return
        body = self._body
        body.line("const int lanes = tangent->lanes;")
        for name, text in sorted(self._arrays.items()):
            body.line(f"mdl_lanes *{name} = {text};")
        body.line("for (int lane = 0; lane < lanes; ++lane) {")
        for line in (*self._loads, *self._lines):
            body.line("  " + line)
        body.line("}")

    # -- text -------------------------------------------------------------------------------------------------

    def row(self, place: str) -> str:
        """The present lanes of a row: `v[3]` -> `tangent_v[3 * lanes + lane]`."""
        array, _, index = place.rstrip("]").partition("[")
        name = f"tangent_{array}"
        if array not in self._arguments:
            self._arrays[name] = f"tangent->{array}"
        return f"{name}[{index} * lanes + lane]" if index else f"{name}[lane]"

    def sum(self, terms: Terms, known: Mapping[Expr, str | None] | None = None) -> str:
        """The sum of products; `known` gives other names of leaves, None for a tangent of zero."""
        text = ""
        for coefficient, leaf in terms:
            name = known[leaf] if known and leaf in known else self._name(leaf)
            if name is None:
                continue
            negative, factor = self._factor(coefficient)
            product = f"{factor} * {name}" if factor else name
            text += (" - " if negative else " + ") + product if text else ("-" if negative else "") + product
        return text or "(mdl_lanes){0.0}"

    def _factor(self, coefficient: Expr) -> tuple[bool, str]:
        """(negative, text) of a coefficient, no text for one."""
        if coefficient.op == "neg":
            negative, text = self._factor(coefficient.args[0])
            return not negative, text
        if is_const(coefficient):
            value = float(coefficient.value)
            return value < 0, "" if abs(value) == 1 else number(abs(value))
        text = self._body.value(coefficient, 7)
        if text.isidentifier():
            return False, text
        self._coefficients += 1
        local = var(f"$c{self._coefficients}")
        self._body.let(local, coefficient)
        return False, self._body.names.leaf(local)

    def _identifier(self, leaf: Expr) -> str:
        return self._body.names.identifier(f"$d_{leaf}")

    def _name(self, leaf: Expr) -> str | None:
        """The local of a leaf's tangent, loaded where it was not computed here; None where the leaf does not move."""
        if leaf not in self._names:
            place = self._place(leaf)
            if place is None:
                return None
            name = self._names[leaf] = self._identifier(leaf)
            self._loads.append(f"const mdl_lanes {name} = {self.row(place)};")
        return self._names[leaf]

    # -- blocks -----------------------------------------------------------------------------------------------

    def _quotient(self, step: Division) -> Terms:
        """d u = (d numerator - u d denominator) / denominator; the division itself is left to the loop."""
        terms = {n: d for d, n in self._gradients(step.numerator)}
        for d, n in self._gradients(step.denominator):
            part = mul(step.unknown, d)
            terms[n] = sub(terms[n], part) if n in terms else neg(part)
        return [(d, n) for n, d in terms.items()]

    def _division(self, step: Division) -> None:
        self.note(step.row)
        divisor = self._divisor(step.unknown, step.denominator, step.row)
        name = self._identifier(step.unknown)
        self._lines.append(f"const mdl_lanes {name} = ({self.sum(self._quotient(step))}) / {divisor};")
        self._names[step.unknown] = name

    def _divisor(self, unknown: Expr, value: Expr, row: Row) -> str:
        body = self._body
        divisor = f"{body.names.leaf(unknown)}_divisor"
        body.line(f"const double {divisor} = {body.value(value)};")
        body.line(f"if ({divisor} == 0.0) {self._fail(row)}")
        return divisor

    def _fail(self, row: Row) -> str:
        return f"return mdl_fail(m, MDL_FAILURE_SINGULAR, {self._equation_index(row.source)}, 0.0);"

    def _block(self, step: LinearBlock | NonlinearBlock, matrix: list[list[Expr]], needed: set[Expr]) -> None:
        """J d_tears = -(tangent of the residuals with tears held), then the tangents of the assignments.

        Implicit function theorem: the block's residuals stay zero in every direction."""
        held: dict[Expr, str | None] = dict.fromkeys(step.tears)
        for a in step.assignments:
            held[a.unknown] = f"{self._identifier(a.unknown)}_held"
            self._lines.append(f"const mdl_lanes {held[a.unknown]} = {self.sum(self._gradients(a.value), held)};")
        for row in step.residuals:
            self.note(row)
        right = [f"-({self.sum(self._gradients(row.residual), held)})" for row in step.residuals]
        self._solve(step, matrix, right, needed)
        for a in step.assignments:
            if a.unknown in needed:
                self.define(a.unknown, self._gradients(a.value), a.row)

    def _solve(
        self, step: LinearBlock | NonlinearBlock, matrix: list[list[Expr]], right: list[str], needed: set[Expr]
    ) -> None:
        """Tangents of all tears at once; those that nothing needs get no name."""
        body, size = self._body, len(step.tears)
        names = [self._identifier(u) for u in step.tears]
        self._names.update(zip(step.tears, names, strict=True))
        if size == 1:
            divisor = self._divisor(step.tears[0], matrix[0][0], step.residuals[0])
            self._lines.append(f"const mdl_lanes {names[0]} = {right[0]} / {divisor};")
            return
        block = f"{body.names.leaf(step.tears[0])}_block"
        values = ", ".join(body.value(a) for line in matrix for a in line)
        body.line(f"double {block}_a[{size * size}] = {{{values}}};")
        body.line(f"int {block}_order[{size}];")
        body.line(f"if (mdl_factor({size}, {block}_a, {block}_order)) {self._fail(step.residuals[0])}")
        self._lines.append(f"const mdl_lanes {block}_b[{size}] = {{{', '.join(right)}}};")
        self._lines.append(f"mdl_lanes {block}_x[{size}];")
        self._lines.append(f"mdl_substitute({size}, {block}_a, {block}_order, {block}_b, {block}_x);")
        self._lines += [
            f"const mdl_lanes {name} = {block}_x[{k}];"
            for k, (tear, name) in enumerate(zip(step.tears, names, strict=True))
            if tear in needed
        ]


def needed_tangents(steps: Sequence[Step], wanted: set[Expr], gradients: Gradients) -> dict[Step, set[Expr]]:
    """The steps, in order, that the tangents of the wanted unknowns follow from; with each what is needed of it."""
    needed, live = {}, set(wanted)
    for step in reversed(steps):
        if live.isdisjoint(unknowns_of(step)):
            continue
        blocks = isinstance(step, LinearBlock | NonlinearBlock)
        for a in reversed(step.assignments if blocks else []):
            if a.unknown in live:
                live.update(leaf for _, leaf in gradients(a.value))
        needed[step] = live.intersection(unknowns_of(step))
        live.update(leaf for e in _differentiated(step) for _, leaf in gradients(e))
    return dict(reversed(needed.items()))


def _differentiated(step: Step) -> list[Expr]:
    """What the tangents of a step are derivatives of."""
    match step:
        case Assignment():
            return [step.value]
        case Division():
            return [step.numerator, step.denominator]
    return [*(row.residual for row in step.residuals), *(a.value for a in step.assignments)]


def _coefficients(terms: Terms) -> list[Expr]:
    return [d for d, _ in terms]


def rows_of(storage: Storage) -> Place:
    """Rows of a bundle at a complete point."""

    def place(leaf: Expr) -> str | None:
        if leaf.op == "time":
            return "t"
        text = storage.point(leaf)
        return text.removeprefix("m->") if text else None

    return place
