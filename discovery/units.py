"""Units of recorded columns: the factor to SI and the SI unit it leads to."""

from __future__ import annotations

import math
import re

_PREFIX = {"": 1.0, "n": 1e-9, "u": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6}

# symbol -> (factor, SI unit); prefixes apply to those in _PREFIXABLE only
_ATOMS: dict[str, tuple[float, str]] = {
    "1": (1.0, "1"), "rad": (1.0, "rad"), "deg": (math.pi / 180, "rad"), "rev": (2 * math.pi, "rad"),
    "rpm": (math.pi / 30, "rad/s"), "%": (0.01, "1"), "min": (60.0, "s"), "degC": (1.0, "degC"),
    "V": (1.0, "V"), "A": (1.0, "A"), "N": (1.0, "N"), "m": (1.0, "m"), "s": (1.0, "s"), "W": (1.0, "W"),
    "g": (1e-3, "kg"), "K": (1.0, "K"), "Hz": (1.0, "Hz"), "Pa": (1.0, "Pa"), "H": (1.0, "H"),
    "ohm": (1.0, "ohm"), "J": (1.0, "J"), "C": (1.0, "C"), "F": (1.0, "F"), "T": (1.0, "T"), "Wb": (1.0, "Wb"),
}  # fmt: skip
_PREFIXABLE = {"V", "A", "N", "m", "s", "W", "g", "Hz", "Pa", "H", "ohm", "J", "rad", "F", "T", "Wb", "C"}
_FACTOR = re.compile(r"^(?P<symbol>[A-Za-z%]+|1)(?P<power>-?\d+)?$")


class UnitError(ValueError):
    """A unit that is not understood."""

    user_error = True


def _atom(symbol: str) -> tuple[float, str]:
    if symbol in _ATOMS:
        return _ATOMS[symbol]
    prefix, rest = symbol[:1], symbol[1:]
    if prefix in _PREFIX and rest in _PREFIXABLE:
        factor, si = _ATOMS[rest]
        return _PREFIX[prefix] * factor, si
    raise UnitError(f'unit "{symbol}" is not known')


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
    return factor, parts[0] + (f"/{parts[1]}" if parts[1] else "")


def same_unit(model: str, column: str) -> bool:
    """Whether two SI units agree as text, up to order and the names of one."""

    def parts(unit: str) -> tuple[list[str], list[str]]:
        top, _, bottom = unit.replace("Ohm", "ohm").replace("(", "").replace(")", "").partition("/")
        return sorted(t for t in top.split(".") if t not in ("", "1")), sorted(b for b in bottom.split(".") if b)

    return not model or parts(model) == parts(column)
