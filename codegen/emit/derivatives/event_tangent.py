"""The derivative of an event: its statements once more, each Real assignment after its own tangent.

A when clause is imperative: a value may change several times. So the tangents of the discrete variables are kept in
their rows of the bundle, and each is written just before its variable is.
"""

from __future__ import annotations

from lacuna.codegen import flat
from lacuna.codegen.dae.discrete.events import DiscreteEquation, targets
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.emit.callbacks.discrete import Discrete
from lacuna.codegen.emit.callbacks.equations import EquationTable
from lacuna.codegen.emit.derivatives.lanes import Lanes, rows_of
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.symbolic.expr import REAL, Expr, pre, var, walk
from lacuna.codegen.symbolic.gradient import Gradients, Terms
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import expressions

EVENT = (
    "static int mdl_event_tangent(mdl_data *m, double t, double *x, const double *xdot, const double *v,\n"
    "                             mdl_tangent *tangent)"
)


FLOOR = "$floor"  # names of what hybrid.py keeps for a floor that moves at located events
STEPWISE = ("floor", "ceil", "integer", "div", "mod", "rem")


def _values(step: DiscreteEquation | flat.When | flat.Algorithm) -> list[Expr]:
    """What a step of an event assigns to Real variables, and to those that they are computed from."""
    if isinstance(step, DiscreteEquation):
        return [] if step.target.startswith(FLOOR) else [step.value]
    return list(expressions([step] if isinstance(step, flat.When) else step.statements))


class EventTangent(Discrete):
    """Writes event() with its derivative."""

    signature = EVENT

    def __init__(
        self,
        prepared: Prepared,
        names: Names,
        rows: dict[str, int],
        equations: EquationTable,
        gradients: Gradients,
    ):
        super().__init__(prepared, names, rows, equations)
        self._gradients = gradients

    def _equation(self, step: DiscreteEquation) -> None:
        if self._type(step.target) == REAL:
            self._tangent(self._row(step.target), self._gradients(step.value))
        super()._equation(step)

    def _declare(self, step: flat.When | flat.Algorithm, span: flat.Span) -> None:
        super()._declare(step, span)
        for name in targets(step):
            if self._type(name) == REAL:
                self._tangent(self._row(name), self._gradients(pre(var(name))))

    def _statement(self, s: flat.Statement) -> None:
        if isinstance(s, flat.Assign) and self._type(s.target) == REAL:
            self._tangent(self._row(s.target), self._gradients(s.value))
        elif isinstance(s, flat.Reinit) and (slot := self._storage.slot(s.target)):
            self._tangent(f"x_after[{slot.index}]", self._gradients(s.value))
        super()._statement(s)

    def rounds(self) -> bool:
        """Whether events round values that move, as a converter does: its derivative is that between two steps."""
        return any(
            n.op == "call" and n.value in STEPWISE and any(self._moves(leaf) for leaf in leaves(n))
            for step in self._p.events
            for e in _values(step)
            for n in walk(e)
        )

    def _moves(self, leaf: Expr) -> bool:
        if leaf.op != "var" or leaf.type != REAL:
            return leaf.op == "der"
        slot = self._storage.slot(str(leaf.value))
        return slot is not None and slot.array in "xv"

    def _row(self, name: str) -> str:
        return f"d[{self._storage.slot(name).index}]"

    def _tangent(self, place: str, terms: Terms) -> None:
        """One loop in a scope of its own: coefficients are those of the values as they are here."""
        body = self._body
        with body.scope("", ()):
            lanes = Lanes(body, self._gradients, rows_of(self._storage), self._equations.index)
            lanes.write(place, terms)
            lanes.finish()
