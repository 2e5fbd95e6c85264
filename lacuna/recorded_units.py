"""Units of recorded columns: the factor to SI and the SI unit it leads to."""

from __future__ import annotations

from dataclasses import replace
import math

from lacuna.units import factors_of, format_unit, parse_unit

ZERO_CELSIUS = 273.15  # K

# Symbols whose SI unit keeps the radian or the degree Celsius, which exponents do not show.
_ATOMS: dict[str, tuple[float, str]] = {
    "deg": (math.pi / 180, "rad"), "rev": (2 * math.pi, "rad"), "rpm": (math.pi / 30, "rad/s"),
    "%": (0.01, "1"), "degC": (1.0, "degC"), "ohm": (1.0, "ohm"),
}  # fmt: skip


class UnitError(ValueError):
    """A unit that is not understood."""

    user_error = True


def _atom(symbol: str) -> tuple[float, str]:
    if symbol in _ATOMS:
        return _ATOMS[symbol]
    if symbol.endswith("rad") and len(symbol) == 4:  # mrad, urad: no prefix in the language, common in recordings
        return _atom(symbol[0] + "m")[0], "rad"
    if symbol.endswith("ohm"):
        return _atom(symbol[:-3] + "Ohm")[0], "ohm"
    try:
        unit = parse_unit(symbol)
    except ValueError as error:
        raise UnitError(f'unit "{symbol}" is not known') from error
    return (
        (1.0, symbol)
        if unit.factor == 1.0
        else (float(unit.factor or 1.0), format_unit(replace(unit, factor=1.0, text="")))
    )


def to_si(unit: str) -> tuple[float, str]:
    """(factor, SI unit) of a unit written as Modelica writes it: "N.m", "rad/s", "kg.m2", "mA", "deg", "rpm"."""
    text = unit.strip().replace("*", ".").replace("^", "")
    if not text:
        raise UnitError('unit "" is empty; write "1" for a quantity without unit')
    try:
        symbols = factors_of(text)
    except ValueError as error:
        raise UnitError(str(error)) from None
    factor = 1.0
    powers: dict[str, int] = {}
    for symbol, power in symbols:
        scale, si = _atom(symbol)
        factor *= scale**power
        for base, inner in factors_of(si):
            powers[base] = powers.get(base, 0) + inner * power
    return factor, _written(powers)


def _written(powers: dict[str, int]) -> str:
    above, below = (
        [base if abs(p) == 1 else f"{base}{abs(p)}" for base, p in powers.items() if sign * p > 0 and base != "1"]
        for sign in (1, -1)
    )
    quotient = ".".join(below)
    return (".".join(above) or "1") + (f"/({quotient})" if len(below) > 1 else f"/{quotient}" if below else "")


def factor_into(declared: str, si: str) -> float:
    """By what a value in the SI unit `si` of a column is multiplied to be one in the unit that a variable declares; 1
    where it declares none. Raises UnitError where the two are of other quantities, or of temperatures with other
    zeros."""
    if not declared:
        return 1.0
    unit = parse_unit(declared)
    if ("degC" in declared) != ("degC" in si) or unit.exponents != parse_unit(si.replace("ohm", "Ohm")).exponents:
        raise UnitError(f"{si} is no {declared}")
    return 1.0 / (unit.factor or 1.0)


def same_unit(model: str, column: str) -> bool:
    """Whether an SI unit of a column is that of a variable: one dimension, and of temperatures one zero."""
    if not model:
        return True
    if ("degC" in model) != ("degC" in column):
        return False  # the scales differ by more than a factor, which is all that a column is converted by
    return parse_unit(model.replace("ohm", "Ohm")).same(parse_unit(column.replace("ohm", "Ohm")))
