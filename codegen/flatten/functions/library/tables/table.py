"""A table: its data, and its columns over the abscissa as piecewise polynomials."""

from __future__ import annotations

from dataclasses import dataclass, field
import itertools

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.functions.library.tables import polynomials as pp
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import Expr

ALWAYS, AT_JUMPS, NO_EVENTS = range(1, 4)  # Modelica.Blocks.Types.TimeEvents
Piece = tuple[float, float | Expr, float | Expr, float | Expr, float | Expr]  # as polynomials.Row


def _plus(c: float | Expr, factor: float, value: Expr) -> float | Expr:
    if not factor:
        return c
    return ex.add(c if isinstance(c, Expr) else ex.const(c), ex.mul(ex.const(factor), value))


@dataclass(frozen=True, eq=False)
class Table:
    rows: list[list[float | Expr]]  # expressions in parameters, none of which is in the first column
    columns: list[int]  # from 1
    smoothness: int
    extrapolation: int
    start: float = 0.0
    shift: float = 0.0
    events: int = NO_EVENTS
    pieces: dict[int, list[Piece]] = field(default_factory=dict)

    @property
    def abscissa(self) -> list[float]:
        return [row[0] for row in self.rows]

    def column(self, number: int, span: Span) -> list[Piece]:
        """Output `number`, from 1, as a piecewise polynomial."""
        if number not in self.pieces:
            if not 1 <= number <= len(self.columns):
                message = f"column {number} of a table with {len(self.columns)} columns"
                raise Diagnostic("F043", message, span, "the columns to look up are chosen by `columns`")
            y = [row[self.columns[number - 1] - 1] for row in self.rows]
            try:
                self.pieces[number] = self._pieces(y)
            except pp.TableError as reason:
                raise Diagnostic("F043", str(reason), span, "the first column of a table ascends") from None
        return self.pieces[number]

    def _pieces(self, y: list[float | Expr]) -> list[Piece]:
        """Of values with expressions among them as a sum: each times the pieces of a table that is one there."""
        known = [0.0 if isinstance(v, Expr) else v for v in y]
        result: list[Piece] = list(pp.piecewise(self.abscissa, known, self.smoothness, self.extrapolation))
        for k in (k for k, v in enumerate(y) if isinstance(v, Expr)):
            one = [float(i == k) for i in range(len(y))]
            parts = pp.piecewise(self.abscissa, one, self.smoothness, self.extrapolation)
            result = [(x, *(_plus(c, f, y[k]) for c, f in zip(own, part, strict=True)))
                      for (x, *own), (_, *part) in zip(result, parts, strict=True)]  # fmt: skip
        return result

    @property
    def period(self) -> float:
        x = self.abscissa
        return x[-1] - x[0] if self.extrapolation == pp.PERIODIC and len(x) > 1 else 0.0

    def instants(self) -> list[float]:
        """Times of events in the time of the table: of jumps, of every point, or none."""
        x = self.abscissa
        found = sorted(set(x)) if self.events == ALWAYS else []
        if self.events == AT_JUMPS:
            found = [a for a, b in itertools.pairwise(x) if a == b]
        if self.period and self.events != NO_EVENTS:
            found = sorted({t for t in found if t < x[-1]} | {x[0]})
        return found
