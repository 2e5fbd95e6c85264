"""der(e) of an expression, by the chain rule, in terms of der of variables."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import variability
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.differentiate import Differentiator
from lacuna.codegen.symbolic.expr import Expr


def time_derivative(e: Expr, scope: Scope, span: Span) -> Expr:
    """d e/dt. Raises R054 for the derivative of a discrete variable or of a derivative."""
    if scope.in_function:
        raise Diagnostic("R054", "der in a function", span, "give the derivative as an argument")

    def seed(leaf: Expr) -> Expr:
        if leaf.op == "time":
            return ex.ONE
        if leaf.op != "var":
            hint = "give the first derivative a name: v = der(x); a = der(v)"
            raise Diagnostic("R054", f"the derivative of {ex.to_text(leaf)}", span, hint)
        kind = variability(leaf, scope.context)
        if kind == "discrete":
            hint = "it is constant between events"
            raise Diagnostic("R054", f"the derivative of the discrete {leaf.value}", span, hint)
        return ex.der(leaf) if kind == "continuous" else ex.ZERO

    if e.op == "var" and e.type != ex.REAL:
        raise Diagnostic("R054", f"the derivative of the {e.type} {e.value}", span, "only Reals have derivatives")
    return Differentiator(seed)(e)
