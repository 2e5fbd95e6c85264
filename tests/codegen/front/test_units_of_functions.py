"""Units of functions: of their inputs, of what their bodies assign, of their results."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.symbolic.expr import walk
from tests.codegen.front.helpers import flatten_text
from tests.codegen.front.test_units import DECLARED


def test_arguments_and_results_of_functions(tmp_path: Path) -> None:
    function = """
    function drop input Real r(unit = "Ohm"); input Real a(unit = "A"); output Real v(unit = "V");
    algorithm v := r*a; end drop;
    """
    flatten_text(tmp_path, function + DECLARED.format("u = drop(R, i);"))
    for wrong, words in (("u = drop(R, u);", "input a of drop"), ("tau = drop(R, i);", "left and right")):
        with pytest.raises(Diagnostic, match=words):
            flatten_text(tmp_path, function + DECLARED.format(wrong))


@pytest.mark.parametrize("call", ["drag(0.5, v)", "drag(c=0.5, v=v)", "drag(v=v)"])
@pytest.mark.parametrize(("unit", "code"), [("N.s2/m2", None), ("N.s/m", "U001")])
def test_a_number_for_an_input_has_the_unit_of_the_input(
    tmp_path: Path, call: str, unit: str, code: str | None
) -> None:
    text = f"""model M
  function drag input Real c(unit = "{unit}") = 3; input Real v(unit = "m/s"); output Real F;
  algorithm F := c*v^2; end drag;
  Real v(unit = "m/s", start = 1); parameter Real m(unit = "kg") = 2;
equation
  m*der(v) = -{call};
end M;"""
    if code is not None:
        with pytest.raises(Diagnostic, match="units differ") as refused:
            flatten_text(tmp_path, text)
        assert refused.value.code == code
        return
    model = flatten_text(tmp_path, text)
    assert model.warnings == []
    assert all(n.op != "annotated" for e in model.equations for side in (e.lhs, e.rhs) for n in walk(side))


WEIGHT = """function weight
  input Real m(unit = "kg"); output Real f(unit = "N");
protected
  constant Real g(unit = "m/s2") = 9.81;
algorithm
  f := m*g;
end weight;
"""


def test_a_constant_of_a_function_keeps_its_unit(tmp_path: Path) -> None:
    """Inlined, the body is checked as equations are: g as a mere number would leave kilograms."""
    text = WEIGHT + 'model M parameter Real m(unit = "{}") = 2; Real f(unit = "N") = weight(m); end M;'
    model = flatten_text(tmp_path, text.format("kg"))
    assert (model.variables["weight.g"].unit, model.variables["weight.g"].variability) == ("m/s2", "constant")
    with pytest.raises(Diagnostic, match="input m of weight"):
        flatten_text(tmp_path, text.format("A"))


def test_a_constant_of_a_function_is_a_number_where_all_is_known(tmp_path: Path) -> None:
    text = WEIGHT + 'model M parameter Real f(unit = "N") = weight(3); end M;'
    model = flatten_text(tmp_path, text)
    assert model.variables["f"].binding.value == pytest.approx(29.43)
    assert "weight.g" not in model.variables


FILM = """model M
  function film "an empirical formula, whose numbers have units of their own"
    input Real v(unit = "m/s"); input Real T(unit = "K"); output Real h(unit = "W/(m2.K)");
  algorithm
    h := 5.7 + 3.8*v^0.8 + 0.01*(T - 273)^1.25;
  end film;
  parameter Real A(unit = "m2") = 1, C(unit = "J/K") = 100, v(unit = "m/s") = 2;
  Real T(unit = "K", start = 300), h(unit = "{}"), q(unit = "W");
equation
  h = film(v, T);
  q = film(2*v, T)*A*(T - 280);
  C*der(T) = -q;
end M;"""


def test_a_body_is_checked_once_and_its_result_has_the_declared_unit(tmp_path: Path) -> None:
    (warning,) = flatten_text(tmp_path, FILM.format("W/(m2.K)")).warnings
    assert (warning.code, warning.span.line) == ("U002", 5)
    assert "3.8 * v ^ 0.8" in warning.message
    with pytest.raises(Diagnostic) as refused:
        flatten_text(tmp_path, FILM.format("W/m2"))
    assert (refused.value.code, refused.value.span.line) == ("U001", 10)
    assert "is in W/(m2.K)" in refused.value.message
    assert [o.severity for o in refused.value.others] == []


@pytest.mark.parametrize(
    ("body", "line"),
    [
        ("z := x;\n y := x;", 4),
        ("while y < 3*x loop\n z := z + x;\n y := y + x;\n end while;", 5),
        ('assert(x > 0, "no");\n y := z;', 5),
        ("if x > 0 then\n y := x;\n return;\n end if;\n y := x + z;", 8),
        ("y := twice(z);", 4),
    ],
)
def test_every_assignment_of_a_body_is_checked(tmp_path: Path, body: str, line: int) -> None:
    text = f"""model M
  function f input Real x(unit = "V"); output Real y(unit = "V") = 0; protected Real z(unit = "A") = 0;
  algorithm
 {body}
  end f;
  function twice input Real x(unit = "V"); output Real y(unit = "V"); algorithm y := 2*x; end twice;
  Real u(unit = "V", start = 1), y(unit = "V") = f(u);
  parameter Real T(unit = "s") = 1;
equation
  der(u) = -u/T;
end M;"""
    with pytest.raises(Diagnostic) as refused:
        flatten_text(tmp_path, text)
    assert (refused.value.code[:2], refused.value.span.line, refused.value.others) == ("U0", line, [])


@pytest.mark.parametrize(
    ("uses", "code"),
    [
        ('Real f(unit = "N") = weight(2); parameter Real p(unit = "N", start = weight(1)) = weight(3);', None),
        ('Real f(unit = "m") = weight(2);', "U001"),
        ('parameter Real p(unit = "m") = weight(2); Real y = p*time;', "U001"),
        ('Real l(unit = "m") = 3; Real y = l + weight(2);', "U002"),
        ('Real f(unit = "N") = weight(weight(2));', "U003"),
        ('Real f[2](each unit = "m") = {weight(k) for k in 1:2};', "U001"),
    ],
)
def test_the_result_of_numbers_has_the_unit_that_is_declared(tmp_path: Path, uses: str, code: str | None) -> None:
    text = WEIGHT + f"model M {uses} end M;"
    if code is None:
        model = flatten_text(tmp_path, text)
        assert model.warnings == []
        left = (model.equations[0].rhs, model.variables["p"].binding, model.variables["p"].start)
        assert [type(e.value) for e in left] == [float] * 3  # nothing is left of it
        return
    with pytest.raises(Diagnostic) as refused:
        flatten_text(tmp_path, text)
    assert refused.value.code == code, str(refused.value)
