"""Unit strings, and the check of equations against them."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from tests.codegen.front.helpers import flatten_text

DECLARED = """model M
  parameter Real R(unit = "Ohm") = 2, L(unit = "H") = 1e-3, k(unit = "V.s/rad") = 0.1;
  parameter Real J(unit = "kg.m2") = 1e-5, d(unit = "N.m.s/rad") = 1e-6, c(unit = "N.m/rad") = 1;
  parameter Integer pairs = 2;
  constant Real pi = 3.14159;
  Real i(unit = "A"), u(unit = "V"), w(unit = "rad/s"), phi(unit = "rad"), tau(unit = "N.m"), x;
equation
  {}
end M;"""


@pytest.mark.parametrize(
    "equation",
    [
        "L*der(i) = u - R*i - k*w",
        "J*der(w) = tau - d*w - c*phi",
        "tau = k*i",
        "x = sin(pairs*phi - pi/6)",
        "x = 0.5*J*w^2 + tau*phi",
        "w = 2*pi/time",
        "u = if w > 0 and i < 3 then 12 else R*i",
        "tau = max(0, min(c*phi, 5))",
        "phi = atan2(u, R*i)",
        "x = sqrt(w^2 + 1e-6)*time",
        "x = sin(2*pi*50*time)",
        "x = exp(0.1 - time/0.02)",
        "w = w*exp(-phi) + der(phi)",
        "tau = noEvent(abs(tau))*sign(w)",
        "phi = mod(phi + pi, 2*pi)",
        "u = smooth(0, if i > 0 then R*i else 0)",
        "x = integer(phi/0.1)",
    ],
)
def test_sound_equations_pass(tmp_path: Path, equation: str) -> None:
    flatten_text(tmp_path, DECLARED.format(equation + ";"))


@pytest.mark.parametrize(
    ("equation", "code", "words"),
    [
        ("L*der(i) = u - R*i - k", "U002", "k is in V.s/rad"),
        ("tau = k*u", "U001", "tau is in N.m"),
        ("J*w = tau", "U001", "J * w is in N.m.s"),
        ("x = sin(w)", "U003", "w is in rad/s"),
        ("x = sin(-w*1)", "U003", "is in rad/s"),
        ("x = i + w", "U002", "i is in A, w is in rad/s"),
        ("x = if u > i then 1 else 2", "U002", "compared"),
        ("x = 2^tau", "U003", "exponent"),
        ("x = w^pairs", "U003", "varies"),
        ("tau = max(u, i)", "U002", "compared by max"),
        ("phi = mod(phi, tau)", "U002", "arguments of mod"),
    ],
)
def test_unsound_equations_show_both_sides(tmp_path: Path, equation: str, code: str, words: str) -> None:
    with pytest.raises(Diagnostic) as refused:
        flatten_text(tmp_path, DECLARED.format(equation + ";"))
    assert refused.value.code == code
    assert words in str(refused.value)
    assert refused.value.span.line == 8


@pytest.mark.parametrize(
    "equation",
    [
        "u = 10*sin(314*time)",
        "tau = 0.3*u",
        "u = R*i + 0.5*w",
        "u = -(2*time)",
        "u = smooth(0, if i > 0 then 3*i else 0)",
        "u = R*sqrt(abs(i)/35)",
        "tau = k*(i/3)^2",
    ],
)
def test_a_written_factor_may_have_a_unit(tmp_path: Path, equation: str) -> None:
    (found,) = flatten_text(tmp_path, DECLARED.format(equation + ";")).warnings
    assert (found.code[:3], found.severity) == ("U00", "warning")
    assert "make it a parameter with that unit" in found.hint


def test_units_that_are_not_declared_are_inferred(tmp_path: Path) -> None:
    """e gets volts from its own equation, so that its use as a torque is refused."""
    text = DECLARED.format("e = k*w; loss = e*i; tau = e;").replace(" x;", " x, e, loss;")
    with pytest.raises(Diagnostic) as refused:
        flatten_text(tmp_path, text)
    assert refused.value.code == "U001"
    assert refused.value.others == []


def test_the_check_can_warn_or_rest(tmp_path: Path) -> None:
    text = DECLARED.format("tau = k*u;")
    (warning,) = flatten_text(tmp_path, text, units="warn").warnings
    assert (warning.code, warning.severity) == ("U001", "warning")
    assert "warning[U001]" in str(warning)
    assert flatten_text(tmp_path, text, units="off").warnings == []


def test_bindings_starts_and_events_are_checked(tmp_path: Path) -> None:
    text = """model M
      parameter Real v0(unit = "m/s") = 1, s0(unit = "m") = 2;
      parameter Real twice(unit = "m") = v0;
      Real s(unit = "m", start = v0);
      Real v(unit = "m/s");
    equation
      v = der(s);
      der(v) = -9.81;
      when s < v then
        reinit(v, -s);
      end when;
    end M;"""
    with pytest.raises(Diagnostic) as refused:
        flatten_text(tmp_path, text)
    lines = [refused.value.span.line, *(other.span.line for other in refused.value.others)]
    assert sorted(lines) == [3, 4, 9, 10]


FOREIGN = """package Shop
  model Mass
    parameter Real m(unit="kg") = 2;
    Real F(unit="N"), v(unit="m/s", start=0, fixed=true);
  equation
    F = m*v;
    der(v) = 1;
  end Mass;
end Shop;
"""


def test_findings_inside_a_library_are_one_warning_and_own_ones_stay_errors(tmp_path: Path) -> None:
    shelf = tmp_path / "shelf"
    shelf.mkdir()
    (shelf / "Shop.mo").write_text(FOREIGN)
    own = tmp_path / "Own.mo"
    own.write_text("model Own\n  Shop.Mass mass;\nend Own;\n")
    warnings = flatten(Library([shelf]), str(own)).warnings
    assert [w.code for w in warnings] == ["W007"]
    assert "1 places of the library Shop" in warnings[0].message
    with pytest.raises(Diagnostic) as refused:
        flatten(Library([shelf]), str(own), units="all")
    assert (refused.value.code, Path(refused.value.span.file).name, refused.value.span.line) == ("U001", "Shop.mo", 6)
    own.write_text('model Own\n  Shop.Mass mass;\n  Real x(unit="m") = mass.F;\nend Own;\n')
    with pytest.raises(Diagnostic) as refused:
        flatten(Library([shelf]), str(own))
    assert (refused.value.code, refused.value.span.line, refused.value.others) == ("U001", 3, [])


def test_a_number_for_an_input_may_stand_in_bindings_and_sizes(tmp_path: Path) -> None:
    model = flatten_text(
        tmp_path,
        """model M
  function from_rpm input Real n(unit = "rev/min"); input Real k = 1; output Real w(unit = "rad/s");
  algorithm w := k*n*3.14159/30; end from_rpm;
  parameter Real k = 2; parameter Real w0(unit = "rad/s") = from_rpm(30, k);
  parameter Integer n = if from_rpm(30, k) > 1 then 2 else 3;
  Real w[n](each unit = "rad/s", each start = from_rpm(60, k));
equation
  der(w) = fill(0, n); assert(w[1] < from_rpm(1000, k), "too fast");
end M;""",
    )
    assert model.warnings == []
    assert [n for n in model.variables if n.startswith("w")] == ["w0", "w[1]", "w[2]"]


@pytest.mark.parametrize(
    ("text", "codes"),
    [
        ("Real P; Real T(unit=\"K\", start=293, fixed=true); parameter Real C(unit=\"J/K\") = 10;"
         " equation P = 20*(1 + 0.004*(T - 298)); C*der(T) = P;", ["U001"]),
        ("Real P; Real T(unit=\"K\", start=293, fixed=true); parameter Real C(unit=\"J/K\") = 10;"
         " equation C*der(T) = P; P = 20*(1 + 0.004*(T - 298));", ["U001"]),
        ("parameter Real a(unit=\"degC\") = 5; Real cop = 5.6 - 0.08*a; Real Q(unit=\"kW\") = cop*p;"
         " parameter Real p(unit=\"kW\") = 1;", ["U001"]),
        ("Real d = 3*exp(-time/5); Real F(unit=\"N\") = 10 - d;", ["U001"]),
        ("Real T(unit=\"degC\", start=20, fixed=true); Real u = 4*(60 - T); Real cut = min(100, max(0, u));"
         " Real P(unit=\"W\") = 2000*cut/100; parameter Real C(unit=\"J/K\") = 1; equation C*der(T) = P;", ["U001"]),
        ("Real N(unit=\"1/s\") = 7; parameter Real a = 0.7; parameter Real k(unit=\"1/s\") = 1;"
         " Real kLa(unit=\"1/s\") = k*(N/7.5)^a;", ["U003"]),
        ("Real u = 10*sin(time); Real i(unit=\"A\") = 10 + time;", ["U003", "U001"]),
        ("constant Real g = 9.81; Real F(unit=\"N\") = 0.5*m*g; parameter Real m(unit=\"kg\") = 1;", ["U001"]),
        ("constant Real g = 9.81; parameter Real m(unit=\"kg\") = 1; Real a(unit=\"m/s2\");"
         " Real F(unit=\"N\") = 7; equation m*a = F - m*g;", ["U002"]),
        ("Real c(unit=\"EUR/kWh\") = 0.3; Real k(unit=\"A\") = 2*c;", ["W015"]),
    ],
)  # fmt: skip
def test_a_number_that_may_have_a_unit_is_no_error_further_on(tmp_path: Path, text: str, codes: list[str]) -> None:
    """A unit that is inferred beside such a number is no claim that others could be held to."""
    model = flatten_text(tmp_path, f"model M\n  {text}\nend M;")
    assert [f.code for f in model.warnings] == codes


def test_a_unit_that_is_inferred_without_numbers_is_a_claim(tmp_path: Path) -> None:
    text = """model M
  parameter Real R(unit="Ohm") = 1; Real i(unit="A") = 2; Real v(unit="V"); Real p;
equation
  v = R*i; p = v*i; v = p;
end M;"""
    with pytest.raises(Diagnostic, match="v is in V, p is in W"):
        flatten_text(tmp_path, text)


def test_what_hides_in_a_number_is_told_of_its_side(tmp_path: Path) -> None:
    text = """model M
  Real w(unit="W", start=0, fixed=true); Real u(unit="W") = 1;
equation
  8*der(w) = u - w;
end M;"""
    (found,) = flatten_text(tmp_path, text).warnings
    assert "a number there is in s," in found.hint


@pytest.mark.parametrize(
    ("unit", "value"),
    [("deg", "atan2(b, a)"), ("deg", "asin(b/a)"), ("mm", "cos(b/a)*a"), ("%", "exp(-b/a)"), ("mm", "sign(b)*a")],
)
def test_a_function_is_no_change_of_scale(tmp_path: Path, unit: str, value: str) -> None:
    text = f'model M parameter Real a(unit = "m") = 2, b(unit = "m") = 1; Real y(unit = "{unit}") = {value}; end M;'
    with pytest.raises(Diagnostic) as refused:
        flatten_text(tmp_path, text)
    assert refused.value.code == "U004"
