"""Expressions of the source mean what the language says: precedence, arrays, reductions, ranges."""

from __future__ import annotations

import math
from pathlib import Path

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
import pytest

from lacuna.codegen.symbolic.expr import to_text
from tests.codegen.front.helpers import flatten_text

VALUES = [
    ("2 + 3*4", 14),
    ("-2^2", -4),
    ("(-2)^2", 4),
    ("2^3*2", 16),
    ("7 - 2 - 1", 4),
    ("12/3/2", 2),
    ("-3 + 5", 2),
    ("mod(-7, 3)", 2),
    ("rem(-7, 3)", -1),
    ("div(-7, 3)", -2),
    ("floor(-2.5)", -3),
    ("ceil(-2.5)", -2),
    ("integer(-2.5)", -3),
    ("sign(-4)", -1),
    ("abs(-4.5)", 4.5),
    ("atan2(1, -1)", 3 * math.pi / 4),
    ("if 1 < 2 and not 3 < 2 then 5 elseif true then 6 else 7", 5),
    ("sum({1, 2, 3})", 6),
    ("product(2:4)", 24),
    ("max({3, 9, 2})", 9),
    ("min(4, 2.5)", 2.5),
    ("sum(i^2 for i in 1:3)", 14),
    ("sum({i*j for i in 1:3, j in 1:2})", 18),
    ("size({{1, 2, 3}, {4, 5, 6}}, 2)", 3),
    ("sum(linspace(0, 1, 5))", 2.5),
    ("sum(1:2:7)", 16),
    ("sum(3:-1:1)", 6),
    ("sum(1:0)", 0),
    ("{1, 2, 3}*{4, 5, 6}", 32),
    ("sum([1, 2; 3, 4]*{1, 10})", 64),
    ("sum({1, 2}*[1, 2; 3, 4])", 17),
    ("max([1, 2; 3, 4]*[0, 1; 1, 0])", 4),
    ("sum({1, 2, 3} .* {4, 5, 6})", 32),
    ("sum({1, 2, 3} .+ 1)", 9),
    ("sum(2 .^ {1, 2, 3})", 14),
    ("sum(transpose([1, 2; 3, 4])*{1, 0})", 3),
    ("sum(cat(1, {1, 2}, {3}))", 6),
    ("sum(cat(2, [1; 2], [3; 4])*{1, 10})", 73),
    ("sum(identity(3)*{1, 2, 3})", 6),
    ("sum(diagonal({1, 2})*{1, 1})", 3),
    ("sum(fill(2, 2, 3))", 12),
    ("cross({1, 0, 0}, {0, 1, 0})*{0, 0, 5}", 5),
    ("scalar({7})", 7),
    ("ndims(zeros(2, 3))", 2),
]


def value(folder: Path, expression: str) -> float:
    model = flatten_text(
        folder, f"model M\n  final parameter Real p = {expression};\n  Real x[integer(1 + 0*p)];\nend M;\n"
    )
    binding = model.variables["p"].binding
    assert binding is not None
    assert binding.op == "const"
    return binding.value


@pytest.mark.parametrize(("expression", "expected"), VALUES, ids=[e for e, _ in VALUES])
def test_constant_expression(tmp_path: Path, expression: str, expected: float) -> None:
    assert value(tmp_path, expression) == pytest.approx(expected, rel=1e-15)


def arithmetic() -> st.SearchStrategy[str]:
    """Random arithmetic that is text of Modelica and of Python alike."""
    leaf = st.integers(1, 9).map(str)

    def grow(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
        two = st.tuples(inner, st.sampled_from("+-*"), inner)
        return st.one_of(two.map(" ".join), inner.map("({})".format), inner.map("(-{})".format))

    return st.recursive(leaf, grow, max_leaves=12)


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(arithmetic())
def test_precedence_is_that_of_arithmetic(tmp_path: Path, term: str) -> None:
    assert value(tmp_path, term) == pytest.approx(float(eval(term)), rel=1e-12)


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("A[2, 3]", "A[2,3]"),
        ("sum(A[2, :])", "A[2,1] + A[2,2] + A[2,3]"),
        ("sum(A[:, 1])", "A[1,1] + A[2,1]"),
        ("A[end, end]", "A[2,3]"),
        ("sum(A[1, {1, 3}])", "A[1,1] + A[1,3]"),
        ("sum(A[1, 2:end])", "A[1,2] + A[1,3]"),
        ("A[k, 1]", "if k == 1 then A[1,1] else if k == 2 then A[2,1] else nan"),
        ("v*v", "v[1] * v[1] + v[2] * v[2] + v[3] * v[3]"),
        ("(A*v)*{1, 0}", "A[1,1] * v[1] + A[1,2] * v[2] + A[1,3] * v[3]"),
        ("max(v)", "max(max(v[1], v[2]), v[3])"),
        ("der(v)*{0, 1, 0}", "der(v[2])"),
        ("der(v[1]*v[2])", "der(v[1]) * v[2] + v[1] * der(v[2])"),
        ("sum(v[i]*i for i in 1:2)", "v[1] + v[2] * 2"),
        ("if p then v[1] else 0", "if p then v[1] else 0"),
    ],
)
def test_array_expression(tmp_path: Path, expression: str, expected: str) -> None:
    text = f"""model M
      Real A[2, 3], v[3];
      Integer k(start = 1);
      parameter Boolean p = true;
      Real result;
    equation
      result = {expression};
    end M;"""
    (equation,) = flatten_text(tmp_path, text).equations
    assert to_text(equation.rhs) == expected
