"""The steps of a causalised system as C: assignments, checked divisions, linear and nonlinear blocks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from lacuna.codegen import flat
from lacuna.codegen.emit.body import Body
from lacuna.codegen.emit.c_text import c_comment
from lacuna.codegen.errors import Span
from lacuna.codegen.structure.causal import Division, LinearBlock, NonlinearBlock, Step, expressions_of
from lacuna.codegen.structure.system import Row
from lacuna.codegen.structure.tearing import Assignment
from lacuna.codegen.symbolic.expr import Expr

NEWTON_ITERATIONS = 50


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
        text = comment(row.source, row.text)
        if text != self._last_comment:
            self._body.line(text)
        self._last_comment = text

    def _assignment(self, step: Assignment, declare: bool = True) -> None:
        self.note(step.row)
        self._body.let(step.unknown, step.value, declare)

    def _fail(self, kind: str, row: Row, value: str = "0.0") -> str:
        return f"return mdl_fail(m, MDL_FAILURE_{kind}, {self._equation_index(row.source)}, {value});"

    def _solve(self, matrix: str, right: str, rows: Sequence[Row]) -> None:
        """A singular matrix is told at the equation that comes with the unknown that it does not determine."""
        equations = ", ".join(str(self._equation_index(row.source)) for row in rows)
        self._body.line(f"const int {matrix}_singular = mdl_solve({len(rows)}, {matrix}, {right});")
        self._body.line(f"if ({matrix}_singular) return mdl_fail(m, MDL_FAILURE_SINGULAR, "
                        f"(const int[]){{{equations}}}[{matrix}_singular - 1], 0.0);")  # fmt: skip

    def _division(self, step: Division) -> None:
        body = self._body
        self.note(step.row)
        divisor = f"{body.names.leaf(step.unknown)}_divisor"
        body.line(f"const double {divisor} = {body.value(step.denominator)};")
        body.line(f"if ({divisor} == 0.0) {self._fail('SINGULAR', step.row)}")
        numerator = body.value(step.numerator, 7)
        name = body.names.leaf(step.unknown)
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
            divisor = f"{names[0]}_divisor"
            body.line(f"const double {divisor} = {matrix[0]};")
            body.line(f"if ({divisor} == 0.0) {self._fail('SINGULAR', step.residuals[0])}")
            body.line(f"const double {names[0]} = {body.value(step.right[0], 8)} / {divisor};")
        else:
            block = f"{names[0]}_block"
            body.line(f"double {block}_a[{size * size}] = {{{', '.join(matrix)}}};")
            body.line(f"double {block}_b[{size}] = {{{', '.join(right)}}};")
            self._solve(f"{block}_a", f"{block}_b", step.residuals)
            for k, name in enumerate(names):
                body.line(f"const double {name} = {block}_b[{k}];")
        for u in step.tears:
            body.define(u)
        for a in step.assignments:
            self._assignment(a)

    def _nonlinear(self, step: NonlinearBlock) -> None:
        """Newton's method, the step halved while it does not reduce the residual."""
        body, size = self._body, len(step.tears)
        block = f"{body.names.leaf(step.tears[0])}_block"
        body.line(f"/* nonlinear block of {size + len(step.assignments)}, torn to {size} */")
        for u in step.tears:
            body.declare(u, self._start(u))
        for a in step.assignments:
            body.declare(a.unknown, "0.0")
        residuals = [r.residual for r in step.residuals]
        body.line(f"mdl_newton {block} = {{0}};")
        body.line(f"double {block}_step[{size}] = {{0}};")
        with body.scope("for (;;)", expressions_of(step)):
            for a in step.assignments:
                self._assignment(a, declare=False)
            body.line(f"if ({block}.converged) break;")
            for row in step.residuals:
                self.note(row)
            body.line(f"double {block}_r[{size}] = {{{', '.join(body.value(r) for r in residuals)}}};")
            names = [body.names.leaf(u) for u in step.tears]
            self._damping(block, size, names)
            body.line(f"if ({block}.converged) break;")
            matrix = ", ".join(body.value(j) for line in step.jacobian for j in line)
            body.line(f"double {block}_a[{size * size}] = {{{matrix}}};")
            self._solve(f"{block}_a", f"{block}_r", step.residuals)
            body.line(f"if (++{block}.iterations > {NEWTON_ITERATIONS}) {self._fail('NEWTON', step.residuals[0])}")
            body.line(f"{block}.converged = 1;")
            for k, u in enumerate(step.tears):
                body.line(f"{block}_step[{k}] = {block}_r[{k}];")
                small = f"1e-9 * fabs({names[k]}) + 1e-12 * {body.value(self._nominal(u), 8)}"
                body.line(f"{block}.converged &= fabs({block}_r[{k}]) <= {small};")
                body.line(f"{names[k]} -= {block}_r[{k}];")
        for a in (*step.tears, *(a.unknown for a in step.assignments)):
            body.define(a)

    def _damping(self, block: str, size: int, names: list[str]) -> None:
        body = self._body
        body.line(f"if (mdl_newton_grows(&{block}, {size}, {block}_r)) {{")
        for k, name in enumerate(names):
            body.line(f"  {block}_step[{k}] *= 0.5;")
            body.line(f"  {name} += {block}_step[{k}];")
        body.line("  continue;")
        body.line("}")
