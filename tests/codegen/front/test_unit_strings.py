"""Units as they are written, in the language's notation and in those of practice."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from lacuna.units import format_unit, parse_unit, per_second
from tests.codegen.front.helpers import flatten_text


@pytest.mark.parametrize(
    ("text", "same_as", "factor"),
    [
        ("N.m", "kg.m2/s2", 1),
        ("V.s/rad", "Wb", 1),
        ("N.m.s/rad", "J.s", 1),
        ("1/s", "Hz", 1),
        ("W/(m2.K)", "kg/(s3.K)", 1),
        ("m/s2", "m.s-2", 1),
        ("kN", "N", 1e3),
        ("mA", "A", 1e-3),
        ("uF", "F", 1e-6),
        ("deg", "rad", math.pi / 180),
        ("%", "1", 0.01),
        ("rev/min", "rad/s", 2 * math.pi / 60),
        ("g.cm2", "kg.m2", 1e-7),
        ("mOhm", "V/A", 1e-3),
        ("kW.h", "J", 3.6e6),
        ("min", "s", 60),
        ("Pa", "N/m2", 1),
        ("m3/s/m0.5", "m2.5/s", 1),
        ("W/m2/K", "W/(m2.K)", 1),
        ("V/Hz0.5", "V.s0.5", 1),
        ("l/(min.bar^0.5)", "m3/(s.Pa0.5)", 1e-3 / 60 / math.sqrt(1e5)),
        ("kg*m^2/s^2", "J", 1),
        ("N m", "N.m", 1),
        ("(kg/s)/Pa", "kg/(s.Pa)", 1),
        ("m/(s/s)", "m", 1),
        ("Pa^(-1/2)", "Pa-0.5", 1),
        ("(m.s-1)2", "m2/s2", 1),
        ("W/(m\u00b2\u00b7\u00b0C)", "W/(m2.K)", 1),
        ("\u00b5m", "m", 1e-6),
        ("kWh", "J", 3.6e6),
        ("mAh", "C", 3.6),
        ("psi", "Pa", 0.45359237 * 9.80665 / 0.0254**2),
        ("lbf.ft", "N.m", 0.45359237 * 9.80665 * 0.3048),
        ("cP", "Pa.s", 1e-3),
        ("cSt", "m2/s", 1e-6),
    ],
)
def test_unit_strings(text: str, same_as: str, factor: float) -> None:
    unit, reference = parse_unit(text), parse_unit(same_as)
    assert unit.exponents == reference.exponents
    assert unit.factor == pytest.approx(factor * reference.factor, rel=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        "furlong",
        "m//s",
        "m/",
        "(m",
        "m)",
        "2m",
        "m^",
        "m^s",
        "m^(1/0)",
        "N..m",
        "kkg",
        "degF",
        "",
        "(" * 60 + "m" + ")" * 60,
        "kN9999",
    ],
)
def test_what_is_no_unit(text: str) -> None:
    with pytest.raises(ValueError, match=r".+"):
        parse_unit(text)


def test_names_of_units() -> None:
    assert [format_unit(parse_unit(t)) for t in ("kg.m2/(s3.A)", "kg.m2/s2", "s-1", "m2", "mm")] == [
        "V", "N.m", "1/s", "m2", "0.001 m",
    ]  # fmt: skip


@pytest.mark.parametrize(("text", "meant"), [("W/m2/K", "W/(m2.K)"), ("m^2", "m2"), ("N m", "N.m"), ("1/(s/m)", "m/s")])
def test_a_unit_in_another_notation_is_read_and_said(tmp_path: Path, text: str, meant: str) -> None:
    model = flatten_text(tmp_path, f'model M\n  parameter Real h(unit = "{text}") = 5;\nend M;')
    assert [(f.code, f.severity, f.hint) for f in model.warnings] == [("W014", "warning", f'unit="{meant}"')]


@pytest.mark.parametrize("text", ["N.m", "W/(m2.K)", "1/s", "s-1", "m0.5", "1", "kg.m2/(s3.A)", "%", "(N.m)/rad"])
def test_a_unit_of_the_language_is_not_remarked_on(tmp_path: Path, text: str) -> None:
    assert flatten_text(tmp_path, f'model M\n  parameter Real h(unit = "{text}") = 5;\nend M;').warnings == []


@pytest.mark.parametrize(
    ("unit", "rate"),
    [("", ""), ("1", "1/s"), ("m", "m/s"), ("m/s", "m/s2"), ("g/m3", "g/(m3.s)"), ("mm", "mm/s"), ("W.s", "W")],
)
def test_the_unit_of_a_rate_is_a_unit_with_its_prefixes(unit: str, rate: str) -> None:
    """That of g/m3 was 0.001 kg/(m3.s), which is none."""
    assert per_second(unit) == rate
    assert not unit or parse_unit(rate).factor == parse_unit(unit).factor
