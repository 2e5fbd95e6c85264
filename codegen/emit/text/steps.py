"""The steps of a causalised system as C: assignments, checked divisions, linear and nonlinear blocks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from lacuna.codegen import flat
from lacuna.codegen.emit.functions.linear import solved
from lacuna.codegen.emit.text.body import Body
from lacuna.codegen.emit.text.c_text import c_comment
from lacuna.codegen.emit.text.limited import has_exponentials, limited
from lacuna.codegen.errors import Span
from lacuna.codegen.structure.causal import Division, LinearBlock, NonlinearBlock, Step, expressions_of
from lacuna.codegen.structure.sorting.tearing import Assignment
from lacuna.codegen.structure.system import Row
from lacuna.codegen.symbolic.expr import Expr, var


def comment(source: flat.Equation, text: str | None = None) -> str:
    """`/* file:line  equation */`"""
    text = text or source.text or f"{source.lhs} = {source.rhs}"
    return f"/* {place(source.span)}  {c_comment(text)} */"


def place(span: Span) -> str:
    """file:line, for comments."""
    return f"{c_comment(Path(span.file).name)}:{span.line}"


class StepWriter:
    """Writes steps into a body; `equation_index(row)` for failures, `start(unknown)` the entry value of a tear."""

    def __init__(
        self,
        body: Body,
        equation_index: Callable[[flat.Equation], int],
        start: Callable[[Expr], str],
        nominal: Callable[[Expr], Expr],
    ):
        self._body, self._equation_index, self._start, self._nominal = body, equation_index, start, nominal
        self._last_comment = ""

    def plan(self, steps: Sequence[Step]) -> list[Expr]:
        """Expressions that the steps compute in the function's own scope."""
        return [e for step in steps if not isinstance(step, NonlinearBlock) for e in expressions_of(step)]

    def write(self, steps: Sequence[Step]) -> None:
        for step in steps:
            match step:
                case Assignment():
                    self._assignment(step)
                case Division():
                    self._division(step)
                case LinearBlock():
                    self._linear(step)
                case NonlinearBlock():
                    self._nonlinear(step)

    def note(self, row: Row) -> None:
        self._body.doubts.row = partial(self._equation_index, row.source)
        text = comment(row.source, row.text)
        if text != self._last_comment:
            self._body.line(text)
        self._last_comment = text

    def _assignment(self, step: Assignment, declare: bool = True) -> None:
        self.note(step.row)
        self._body.let(step.unknown, step.value, declare)

    def _fail(self, kind: str, row: Row, value: str = "0.0") -> str:
        return f"return mdl_fail(m, MDL_FAILURE_{kind}, {self._equation_index(row.source)}, {value});"

    def _solve(self, block: str, step: LinearBlock) -> None:
        """A singular matrix is told at the equation that comes with the unknown that it does not determine."""
        body, size = self._body, len(step.tears)
        body.line(f"const int {block}_singular = {solved(size, f'{block}_a', f'{block}_b')};")
        sizes = [self._nominal(u) for u in step.tears]
        with body.scope(f"if ({block}_singular)", sizes):
            equation = self._equation_of(step.residuals, f"{block}_singular")
            nominal = ", ".join(map(body.size, sizes))
            body.line(f"const double {block}_nominal[{size}] = {{{nominal}}};")
            body.line(f"const int {block}_equation = {equation};")
            arguments = f"m, {size}, {block}_singular - 1, {block}_a, {block}_b, {block}_nominal"
            body.line(f"if (mdl_least({arguments})) "
                      f"return mdl_fail(m, MDL_FAILURE_SINGULAR, {block}_equation, 0.0);")  # fmt: skip
            body.line(f"m->undetermined = 1 + {block}_equation;")

    def _equation_of(self, rows: Sequence[Row], singular: str) -> str:
        """The equation of the unknown that mdl_solve names, of the first one where it names none."""
        equations = ", ".join(str(self._equation_index(row.source)) for row in (rows[0], *rows))
        return f"(const int[]){{{equations}}}[{singular}]"

    def _division(self, step: Division) -> None:
        body = self._body
        self.note(step.row)
        divisor = f"{body.names.leaf(step.unknown)}_divisor"
        body.line(f"const double {divisor} = {body.value(step.denominator)};")
        name = body.names.leaf(step.unknown)
        if step.guess:
            body.line(f"double {name} = {body.value(step.numerator)};")
            body.line(f"if ({divisor} == 0.0 && {name} != 0.0) {self._fail('SINGULAR', step.row)}")
            body.line(f"{name} = {divisor} == 0.0 ? {self._start(step.unknown)} : {name} / {divisor};")
        else:
            body.line(f"if ({divisor} == 0.0) {self._fail('SINGULAR', step.row)}")
            numerator = body.value(step.numerator, 7)
            body.line(f"const double {name} = {numerator} / {divisor};")
        body.define(step.unknown)

    def _linear(self, step: LinearBlock) -> None:
        body, size = self._body, len(step.tears)
        body.line(f"/* linear block of {size + len(step.assignments)}, torn to {size} */")
        for row in step.residuals:
            self.note(row)
        matrix = [body.value(a) for line in step.matrix for a in line]
        right = [body.value(b) for b in step.right]
        names = [body.names.leaf(u) for u in step.tears]
        if size == 1:
            self._quotient(step, names[0], matrix[0])
        else:
            block = f"{names[0]}_block"
            body.line(f"double {block}_a[{size * size}] = {{{', '.join(matrix)}}};")
            body.line(f"double {block}_b[{2 * size}] = {{{', '.join(right)}}};")
            self._solve(block, step)
            for k, name in enumerate(names):
                body.line(f"const double {name} = {block}_b[{k}];")
        for u in step.tears:
            body.define(u)
        for a in step.assignments:
            self._assignment(a)

    def _quotient(self, step: LinearBlock, name: str, matrix: str) -> None:
        """One equation; 0 x = 0 leaves x open, see emit/functions/linear.py. A divisor that no state decides is
        inverted while the right side is computed: what waits for x would wait for the division too."""
        body, row, (right,) = self._body, step.residuals[0], step.right
        nominal, ahead = self._nominal(step.tears[0]), body.is_given(step.matrix[0][0])
        body.line(f"const double {name}_divisor = {matrix};")
        if ahead:
            body.line(f"const double {name}_inverse = 1.0 / {name}_divisor;")
        body.line(f"double {name} = {body.value(right)};")
        by = f"*= {name}_inverse" if ahead else f"/= {name}_divisor"
        body.line(f"if ({name}_divisor != 0.0) {name} {by};")
        body.line(f"else if ({name} != 0.0) {self._fail('SINGULAR', row)}")
        with body.scope("else", [nominal]):
            body.line(f"{name} = m->shift * {body.size(nominal, 7)};")
            body.line(f"m->undetermined = {1 + self._equation_index(row.source)};")

    def _nonlinear(self, step: NonlinearBlock) -> None:
        """A loop that evaluates the block wherever its solver (emit/functions/newton.py) looks."""
        body, size = self._body, len(step.tears)
        names = [body.names.leaf(u) for u in step.tears]
        block = f"{names[0]}_block"
        body.line(f"/* nonlinear block of {size + len(step.assignments)}, torn to {size} */")
        for u in step.tears:
            body.declare(u, self._start(u))
        for a in step.assignments:
            body.declare(a.unknown, "0.0")
        body.line(f"double {block}_x[{size}] = {{{', '.join(names)}}};")
        body.line(f"double {block}_work[{4 * size}] = {{{', '.join(names)}}};")
        nominal = ", ".join(body.size(self._nominal(u)) for u in step.tears)
        body.line(f"const double {block}_nominal[{size}] = {{{nominal}}};")
        fields = f".n = {size}, .x = {block}_x, .work = {block}_work, .nominal = {block}_nominal"
        bounded = size > 1 and has_exponentials(step)
        body.line(f"mdl_newton {block} = {{{fields}{', .limit = INFINITY' if bounded else ''}}};")
        if bounded:
            limit = var(f"limit of {names[0]}")
            body.declare(limit, "INFINITY")
            step = limited(step, limit)
        noted = any(map(body.doubts.inside, expressions_of(step)))
        if noted:  # at points that the iteration only looks at does not count
            body.line(f"const int {block}_unsettled = m->unsettled;")
        with body.scope("for (;;)", expressions_of(step)):
            if noted:
                body.line(f"m->unsettled = {block}_unsettled;")
            for k, name in enumerate(names):
                body.line(f"{name} = {block}_x[{k}];")
            if bounded:
                body.line(f"{body.names.leaf(limit)} = {block}.limit;")
            for a in step.assignments:
                self._assignment(a, declare=False)
            if bounded:
                body.line(f"if ({block}.phase == MDL_SOLVED && mdl_newton_limit(&{block})) continue;")
            body.line(f"if ({block}.phase == MDL_SOLVED) break;")
            self._look(step, block, f" && !mdl_newton_limit(&{block})" if bounded else "")
        body.line(f"mdl_newton_tell(m, &{block}, {self._equation_index(step.residuals[0].source)});")
        for a in (*step.tears, *(a.unknown for a in step.assignments)):
            body.define(a)

    def _look(self, step: NonlinearBlock, block: str, unless: str) -> None:
        body, size = self._body, len(step.tears)
        for row in step.residuals:
            self.note(row)
        residuals = ", ".join(body.value(r.residual) for r in step.residuals)
        body.line(f"double {block}_r[{2 * size}] = {{{residuals}}};")
        body.line(f"const int {block}_looked = mdl_newton_look(&{block}, {block}_r);")
        equation = self._equation_of(step.residuals, f"{block}.singular")
        with body.scope(f"if ({block}.phase == MDL_FAILED{unless})", []):
            body.line(f"mdl_newton_tell(m, &{block}, {self._equation_index(step.residuals[0].source)});")
            body.line(f"return mdl_fail(m, MDL_FAILURE_NEWTON, {equation}, 0.0);")
        body.line(f"if ({block}_looked) continue;")
        matrix = ", ".join(body.value(j) for line in step.jacobian for j in line)
        body.line(f"double {block}_a[{size * size}] = {{{matrix}}};")
        if size > 1:
            body.line(f"mdl_newton_weigh(&{block}, {block}_a, {block}_r);")
        body.line(f"const int {block}_singular = {solved(size, f'{block}_a', f'{block}_r')};")
        body.line(f"if (!{block}_singular) mdl_newton_orient(&{block}, {block}_a);")
        body.line(f"mdl_newton_step(&{block}, {block}_r, {block}_singular);")
