"""Units of recorded columns: the factor to SI and the SI unit it leads to."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
import math

from lacuna.units import factors_of, format_unit, of_factors, parse_unit

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
    if symbol.endswith("Hz"):
        return float(unit.factor or 1.0), "Hz"  # kHz: the base units do not show that cycles are counted
    return (
        (1.0, symbol)
        if unit.factor == 1.0
        else (float(unit.factor or 1.0), format_unit(replace(unit, factor=1.0, text="")))
    )


def to_si(unit: str) -> tuple[float, str]:
    """(factor, SI unit) of a unit written as Modelica writes it: "N.m", "rad/s", "kg.m2", "mA", "deg", "rpm"."""
    text = unit.strip()
    if not text:
        raise UnitError('unit "" is empty; write "1" for a quantity without unit')
    try:
        symbols = factors_of(text)
    except ValueError as error:
        raise UnitError(str(error)) from None
    if [(symbol, power) for symbol, power in symbols if symbol != "1"] == [("min", -1)]:
        return 1 / 60, "Hz"  # in a head it is rpm, which it is as often as not: no angle by itself
    factor = 1.0
    powers: dict[str, int | Fraction] = {}
    for symbol, power in symbols:
        scale, si = _atom(symbol)
        factor *= scale**power
        for base, inner in factors_of(si):
            powers[base] = powers.get(base, 0) + inner * power
    return factor, of_factors(powers.items())


def factor_into(declared: str, si: str) -> float:
    """By what a value in the SI unit `si` of a column is multiplied to be one in the unit that a variable declares; 1
    where it declares none. Raises UnitError where the two are of other quantities, of temperatures with other zeros, or
    one counts cycles and the other angle."""
    if not declared:
        return 1.0
    unit = parse_unit(declared)
    if _zeros_differ(declared, si) or not same_dimension(declared, si):
        raise UnitError(f"{si} is no {declared}")
    if cycles_for_angle(declared, si):
        raise UnitError(f"2 pi lie between them (turns a second are rev/s): {si} is no {declared}")
    return 1.0 / (unit.factor or 1.0)


def same_dimension(one: str, other: str) -> bool:
    """Whether two units, as models declare or columns are brought to, are of one quantity; degC counts as K. Raises
    ValueError for what is no unit."""
    first, second = (parse_unit(unit.replace("ohm", "Ohm")) for unit in (one, other))
    return first.exponents == second.exponents


def same_unit(model: str, column: str) -> bool:
    """Whether an SI unit of a column is that of a variable: one dimension, of temperatures one zero, and of cycles and
    angles the same."""
    if not model:
        return True
    if _zeros_differ(model, column) or cycles_for_angle(model, column):
        return False  # degC and K differ by more than a factor, which is all that a column is converted by
    return parse_unit(model.replace("ohm", "Ohm")).same(parse_unit(column.replace("ohm", "Ohm")))


def alike(one: str, other: str) -> bool:
    """Whether two units of a column mean the same: values need no conversion."""
    (factor, si), (scale, unit) = to_si(one), to_si(other)
    return math.isclose(factor, scale, rel_tol=1e-9) and same_unit(si, unit)


def _zeros_differ(one: str, other: str) -> bool:
    return ("degC" in one) != ("degC" in other)


def cycles_for_angle(one: str, other: str) -> bool:
    """Hz and rad/s are both 1/s, and 2 pi lies between them; 1/s itself may be either."""
    return sorted((_counted(one), _counted(other))) == ["angle", "cycles"]


def _counted(unit: str) -> str:
    symbols = {symbol for symbol, _ in factors_of(to_si(unit)[1])}
    return "angle" if "rad" in symbols else "cycles" if "Hz" in symbols else ""
