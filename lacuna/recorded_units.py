"""Units of recorded columns: the factor to SI and the SI unit it leads to."""

from __future__ import annotations

from dataclasses import replace
import math
import re

from lacuna.units import format_unit, parse_unit

ZERO_CELSIUS = 273.15  # K

# Symbols whose SI unit keeps the radian or the degree Celsius, which exponents do not show.
_ATOMS: dict[str, tuple[float, str]] = {
    "deg": (math.pi / 180, "rad"), "rev": (2 * math.pi, "rad"), "rpm": (math.pi / 30, "rad/s"),
    "%": (0.01, "1"), "degC": (1.0, "degC"), "ohm": (1.0, "ohm"),
}  # fmt: skip
_FACTOR = re.compile(r"^(?P<symbol>[A-Za-z%]+|1)(?P<power>-?\d+)?$")


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
    numerator, *denominators = text.replace("(", "").replace(")", "").split("/")
    if len(denominators) > 1:
        raise UnitError(f'unit "{unit}" has more than one "/"')
    factor, parts = 1.0, []
    for sign, side in ((1, numerator), (-1, denominators[0] if denominators else "")):
        symbols = []
        for piece in filter(None, side.split(".")):
            match = _FACTOR.match(piece)
            if not match:
                raise UnitError(f'unit "{unit}" is not understood at "{piece}"')
            power = int(match["power"] or 1)
            scale, si = _atom(match["symbol"])
            factor *= scale ** (sign * power)
            symbols.append(si if power == 1 else f"{si}{power}")
        parts.append(".".join(symbols))
    below = f"({parts[1]})" if "." in parts[1] else parts[1]
    return factor, (parts[0] or "1") + (f"/{below}" if below else "")


def same_unit(model: str, column: str) -> bool:
    """Whether an SI unit of a column is that of a variable: one dimension, and of temperatures one zero."""
    if not model:
        return True
    if ("degC" in model) != ("degC" in column):
        return False  # the scales differ by more than a factor, which is all that a column is converted by
    return parse_unit(model.replace("ohm", "Ohm")).same(parse_unit(column.replace("ohm", "Ohm")))
