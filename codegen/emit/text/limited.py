"""Exponentials inside of nonlinear blocks, continued by their tangents.

A diode that is thrown from one side to the other has, at the start values, a current that no number holds: there is no
residual to begin from. Beyond a limit L the exponential goes on as a straight line,

    exp(u)  ~  exp(min(u, L)) (1 + max(u - L, 0)),   d/du  exp(min(u, L)),

of which Newton's method comes down in one step. The block's solver raises L from solution to solution up to infinity,
where both are exp(u) to the last bit (emit/functions/newton.py).
"""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen.structure.causal import NonlinearBlock
from lacuna.codegen.structure.system import Row
from lacuna.codegen.symbolic.expr import ONE, ZERO, Expr, add, call, maximum, minimum, mul, sub, transform, walk
from lacuna.codegen.symbolic.leaves import leaves


def has_exponentials(step: NonlinearBlock) -> bool:
    """Of what the block solves for."""
    own = {*step.tears, *(a.unknown for a in step.assignments)}
    computed = [*(a.value for a in step.assignments), *(r.residual for r in step.residuals)]
    return any(n.op == "call" and n.value == "exp" and leaves(n) & own for e in computed for n in walk(e))


def limited(step: NonlinearBlock, limit: Expr) -> NonlinearBlock:
    """The block with its exponentials up to `limit`."""
    values: dict[Expr, Expr] = {}
    slopes: dict[Expr, Expr] = {}

    def slope(n: Expr) -> Expr | None:
        if n.op != "call" or n.value != "exp":
            return None
        return call("exp", minimum(transform(n.args[0], value, values), limit))

    def value(n: Expr) -> Expr | None:
        if n.op != "call" or n.value != "exp":
            return None
        u = transform(n.args[0], value, values)
        return mul(call("exp", minimum(u, limit)), add(ONE, maximum(sub(u, limit), ZERO)))

    def row(r: Row) -> Row:
        return Row(transform(r.lhs, value, values), transform(r.rhs, value, values), r.source, r.integral)

    return NonlinearBlock(
        step.tears,
        [replace(a, value=transform(a.value, value, values)) for a in step.assignments],
        [row(r) for r in step.residuals],
        [[transform(j, slope, slopes) for j in line] for line in step.jacobian],
    )
