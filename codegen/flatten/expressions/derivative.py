"""der(e) of an expression, by the chain rule, in terms of der of variables.

The derivative of a derivative is that of a variable of its own, derivative(x).
"""

from __future__ import annotations

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import variability
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.differentiate import Differentiator
from lacuna.codegen.symbolic.expr import Expr


class _Named(dict[Expr, Span]):
    """Derivatives that are differentiated again, and where."""


def time_derivative(e: Expr, scope: Scope, span: Span) -> Expr:
    """d e/dt. Raises R054 for the derivative of a discrete variable."""
    if scope.in_function:
        raise Diagnostic("R054", "der in a function", span, "give the derivative as an argument")

    def seed(leaf: Expr) -> Expr:
        if leaf.op == "time":
            return ex.ONE
        if leaf.op == "der":
            scope.context.table(_Named).setdefault(leaf, span)
            return ex.der(ex.var(_name(leaf)))
        if leaf.op != "var":
            hint = "give the expression a variable of its own"
            raise Diagnostic("R054", f"the derivative of {ex.to_text(leaf)}", span, hint)
        kind = variability(leaf, scope.context)
        if kind == "discrete":
            hint = "it is constant between events"
            raise Diagnostic("R054", f"the derivative of the discrete {leaf.value}", span, hint)
        return ex.der(leaf) if kind == "continuous" else ex.ZERO

    if e.type != ex.REAL and e.op != "const":
        raise Diagnostic("R054", f"the derivative of the {e.type} {ex.to_text(e)}", span, "only Reals have derivatives")
    return Differentiator(seed, rules=scope.context.derivatives)(e)


def _name(derivative: Expr) -> str:
    return f"derivative({derivative.args[0].value})"


def derivative_variables(model: flat.FlatModel, context: Context) -> None:
    """Add the variables that stand for derivatives that are differentiated again, each with its equation."""
    for derivative, span in context.table(_Named).items():
        name = _name(derivative)
        model.variables[name] = flat.Variable(name, span, ex.REAL, flat.CONTINUOUS)
        model.equations.append(flat.Equation(ex.var(name), derivative, span, "", f"{name} = {ex.to_text(derivative)}"))
