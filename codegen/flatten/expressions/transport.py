"""(out0, out1) = spatialDistribution(in0, in1, x, positiveVelocity, initialPoints, initialValues) (3.7.4.2)."""

from __future__ import annotations

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.expressions.constants import is_parameter
from lacuna.codegen.flatten.expressions.lower import lower, lower_scalar
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import Array, Value, shape_of
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, REAL, Expr
from lacuna.codegen.syntax import ast

OPERATOR = "spatialDistribution"
_INPUTS = ("in0", "in1", "x", "positiveVelocity", "initialPoints", "initialValues")


def spatial_distribution(e: ast.Call, scope: Scope) -> list[Value]:
    """out0 and out1; of arrays in0 and in1 element by element, initialValues having a row for each."""
    if scope.in_function:
        raise Diagnostic("R054", f"{OPERATOR} in a function", e.span, "a model knows what has passed")
    written = dict(zip(_INPUTS, e.args, strict=False)) | e.named
    if len(e.args) + len(e.named) != len(written) or not set(_INPUTS[:4]) <= written.keys() <= set(_INPUTS):
        raise Diagnostic("R050", f"{OPERATOR} takes {', '.join(_INPUTS)}", e.span, f"{OPERATOR}({', '.join(_INPUTS)})")
    ends = [lower(written[name], scope) for name in _INPUTS[:2]]
    if shape_of(ends[0]) != shape_of(ends[1]) or len(shape_of(ends[0])) > 1:
        raise Diagnostic("R042", "in0 and in1 differ in size, or are matrices", e.span, "both need the same size")
    moved = [lower_scalar(written["x"], scope, REAL), lower_scalar(written["positiveVelocity"], scope, BOOLEAN)]
    points = _given("initialPoints", (ex.ZERO, ex.ONE), written, scope)
    _require_rising(points, e)
    values = _given("initialValues", (ex.ZERO, ex.ZERO), written, scope)
    if not isinstance(ends[0], Array):
        return _results([*ends, *moved], points, values, e)
    rows = values.rows() if len(values.shape) == 2 else [values] * ends[0].shape[0]
    if len(rows) != ends[0].shape[0]:
        raise Diagnostic("R042", "initialValues has not a row for each input", e.span, "give one row for each")
    columns = [
        _results([a, b, *moved], points, row, e) for a, b, row in zip(ends[0].items, ends[1].items, rows, strict=True)
    ]
    return [Array(ends[0].shape, tuple(column[k] for column in columns)) for k in range(2)]


def _results(moved: list[Value], points: Array, values: Array, e: ast.Call) -> list[Value]:
    if shape_of(values) != points.shape:
        message = "initialPoints and initialValues differ in size"
        raise Diagnostic("R042", message, e.span, "give a value for each point")
    arguments = (*moved, *points.items, *values.items)
    return [ex.special(OPERATOR, ex.const(which), *arguments, type=REAL) for which in range(2)]


def _given(name: str, default: tuple[Expr, ...], written: dict[str, ast.Expression], scope: Scope) -> Array:
    if name not in written:
        return Array((len(default),), default)
    value = lower(written[name], scope)
    items = value.items if isinstance(value, Array) else ()
    if not items or not all(isinstance(i, Expr) and is_parameter(i, scope.context) for i in items):
        raise Diagnostic(
            "R055", f"{name} is no array of parameters", written[name].span, "use parameters and constants"
        )
    return value


def _require_rising(points: Array, e: ast.Call) -> None:
    known = [float(p.value) for p in points.items if p.op == "const"]
    whole = len(known) == len(points.items) and len(points.shape) == 1
    if whole and (known != sorted(known) or known[0] != 0 or known[-1] != 1 or len(known) < 2):
        message = "initialPoints do not rise from 0 to 1"
        raise Diagnostic("R064", message, e.span, "such as {0, 0.5, 1}")
