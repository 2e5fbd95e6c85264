"""Expressions as C, their derivatives and their linear parts, against direct evaluation."""

from __future__ import annotations

import ctypes
import gc
import math
from pathlib import Path
import weakref

from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st

from lacuna.codegen.cache import compile_c
from lacuna.codegen.compile import compile_model
from lacuna.codegen.emit.functions.prelude import helpers
from lacuna.codegen.emit.text.body import Body
from lacuna.codegen.emit.text.expression import number
from lacuna.codegen.emit.text.names import Names
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.affine import affine, isolate
from lacuna.codegen.symbolic.differentiate import Differentiator, partial
from lacuna.codegen.symbolic.evaluate import evaluate
from lacuna.codegen.symbolic.leaves import leaves
from tests.codegen.back.expressions import EXPRESSIONS, NAMES, POINTS, SMOOTH, VARIABLES
from tests.codegen.generated import write_model

BATCH = 60
STATE = "#define MDL_SOMEWHERE 1\ntypedef struct { int unsettled; } mdl_data;"  # what relations note is not looked at


def value_at(e: ex.Expr, point: tuple[float, ...]) -> float | None:
    return evaluate(e, lambda n: point[NAMES.index(str(n.value))])


def c_function(index: int, e: ex.Expr) -> str:
    body = Body(Names(NAMES), lambda n: f"p[{NAMES.index(str(n.value))}]")
    body.plan([e, e])
    text = body.value(e)
    parts = "mdl_data data, *m = &data;\n  (void)m;\n  (void)p;"
    return f"double f{index}(const double *p) {{\n  {parts}\n{body.text()}\n  return {text};\n}}"


def compiled(expressions: list[ex.Expr], folder: Path) -> ctypes.CDLL:
    functions = [c_function(k, e) for k, e in enumerate(expressions)]
    declarations = [f"double f{k}(const double *p);" for k in range(len(expressions))]
    source = folder / "expressions.c"
    code = "\n".join(functions)
    source.write_text("\n".join(["#include <math.h>", STATE, helpers(code), *declarations, code, ""]))
    compile_c(source, folder / "expressions.so")
    return ctypes.CDLL(str(folder / "expressions.so"))


@settings(max_examples=4, deadline=None, suppress_health_check=list(HealthCheck), phases=[Phase.generate])
@given(st.lists(EXPRESSIONS, min_size=BATCH, max_size=BATCH), st.lists(POINTS, min_size=3, max_size=3))
def test_printed_c_computes_the_expression(
    tmp_path_factory, expressions: list[ex.Expr], points: list[tuple[float, ...]]
) -> None:
    library = compiled(expressions, tmp_path_factory.mktemp("c"))
    for k, e in enumerate(expressions):
        function = getattr(library, f"f{k}")
        function.restype, function.argtypes = ctypes.c_double, [ctypes.POINTER(ctypes.c_double)]
        for point in points:
            expected = value_at(e, point)
            if expected is None or not math.isfinite(expected) or abs(expected) > 1e12:
                continue
            found = function((ctypes.c_double * 3)(*point))
            assert math.isclose(found, expected, rel_tol=1e-9, abs_tol=1e-9), (str(e), point)


def test_parentheses_of_nested_negation(tmp_path: Path) -> None:
    """-(a + b)*c has come out as -a + b*c elsewhere."""
    a, b, c = VARIABLES
    trees = {ex.mul(ex.node("neg", (ex.add(a, b),)), c): -25.0, ex.sub(a, ex.node("-", (b, c))): 4.0}
    library = compiled(list(trees), tmp_path)
    for k, expected in enumerate(trees.values()):
        function = getattr(library, f"f{k}")
        function.restype = ctypes.c_double
        assert function((ctypes.c_double * 3)(2, 3, 5)) == expected


def test_what_shared_arrays_hold_is_computed_once() -> None:
    """Two functions of one array, 20 times over each other: without temporaries a million calls."""
    pair = VARIABLES[:2]
    for _ in range(20):
        shared = ex.node("array", tuple(pair))
        pair = tuple(ex.node("call", (shared,), name) for name in ("first", "second"))
    total = ex.add(*pair)
    body = Body(Names(NAMES), lambda n: f"p[{NAMES.index(str(n.value))}]")
    body.plan([total])
    value = body.value(total)
    text = body.text() + value
    assert text.count("fn_first") == text.count("fn_second") == 20


@given(st.floats(allow_nan=False))
def test_numbers_read_back_exactly(value: float) -> None:
    text = number(value)
    assert float(text.replace("INFINITY", "inf")) == value


@given(SMOOTH, POINTS, st.integers(0, 2))
def test_partial_derivative_against_a_difference(e: ex.Expr, point: tuple[float, ...], k: int) -> None:
    """Central difference with step h: error h^2 f''' / 6 + eps |f| / h."""
    exact = value_at(partial(e, VARIABLES[k]), point)
    h = 1e-5
    moved = [value_at(e, tuple(v + s * h * (i == k) for i, v in enumerate(point))) for s in (1, -1, 2, -2)]
    assume(exact is not None and None not in moved and max(map(abs, (exact, *moved))) < 1e3)
    curvature = abs(moved[2] - 2 * moved[0] + 2 * moved[1] - moved[3]) / (2 * h)
    assert abs((moved[0] - moved[1]) / (2 * h) - exact) <= 1e-5 * (1 + abs(exact)) + curvature


@given(SMOOTH, POINTS)
def test_total_derivative_is_the_sum_of_partials(e: ex.Expr, point: tuple[float, ...]) -> None:
    speeds = {VARIABLES[0]: ex.const(2.0), VARIABLES[1]: ex.const(-1.0), VARIABLES[2]: ex.const(0.5)}
    total = value_at(Differentiator(lambda n: speeds[n])(e), point)
    parts = [value_at(ex.mul(partial(e, v), speed), point) for v, speed in speeds.items()]
    assume(total is not None and None not in parts and max(map(abs, (total, *parts))) < 1e6)
    assert math.isclose(total, sum(parts), rel_tol=1e-9, abs_tol=1e-9)


@given(SMOOTH, SMOOTH, POINTS)
def test_linear_parts_recombine(slope: ex.Expr, offset: ex.Expr, point: tuple[float, ...]) -> None:
    a, b, c = VARIABLES
    slope, offset = (ex.substitute(e, {a: b}) for e in (slope, offset))
    e = ex.if_else(ex.relation(">", c, b), ex.add(ex.mul(slope, a), offset), ex.neg(ex.sub(offset, a)))
    parts = affine(e, a)
    assert parts is not None
    values = [value_at(p, point) for p in (*parts, e)]
    assume(None not in values and max(map(abs, values)) < 1e9)
    assert math.isclose(values[0] * point[0] + values[1], values[2], rel_tol=1e-9, abs_tol=1e-6)


def test_products_of_an_unknown_are_not_linear() -> None:
    a, b, _ = VARIABLES
    assert affine(ex.mul(a, a), a) is None
    assert affine(ex.call("sin", a), a) is None
    assert affine(ex.if_else(ex.relation(">", a, b), a, b), a) is None
    assert isolate(ex.mul(b, a), ex.add(a, ex.ONE), a) == (ex.ONE, ex.sub(b, ex.ONE))


def test_nodes_of_a_translation_go_with_it(tmp_path: Path) -> None:
    inside, lasting = [], len(ex.table().nodes)
    with ex.own_table() as own:
        x = ex.var("only here")
        assert x is ex.var("only here")
        assert ex.const(2.0) is ex.const(2.0)
        inside.append(weakref.ref(x))
        assert leaves(ex.add(x, ex.ONE)) == {x}
        del own, x
    gc.collect()
    assert inside[0]() is None
    assert len(ex.table().nodes) == lasting
    model = write_model(tmp_path, "model Own Real x(start = 1, fixed = true); equation der(x) = -3.25*x; end Own;")
    compile_model(model, cache_directory=str(tmp_path))
    assert len(ex.table().nodes) == lasting
