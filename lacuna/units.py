"""Units of measure: strings such as "N.m.s/rad" to SI exponents with a factor, and back.

Grammar and symbols are those of the Modelica language specification (unit expressions), and notations and units that
practice has besides (factors: NIST SP 811, appendix B). Angles are dimensionless: rad and 1 are the same, deg has the
factor pi/180. A temperature in degC counts as K.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache
import math
import re

_BASE = ("m", "kg", "s", "A", "K", "mol", "cd")
Exponents = tuple[int | Fraction, ...]  # a Fraction only where it is no whole number: those are a tenth as fast
_NONE: Exponents = (0,) * len(_BASE)


class UnknownSymbol(ValueError):
    """A unit that is well written, of a symbol that is not known."""


@dataclass(frozen=True)
class Unit:
    """Exponents of m, kg, s, A, K, mol, cd; `factor` to SI, or None where literals have made it unknown.

    `text` is how it was written, where it was; `soft` where it was inferred beside a number that may have a unit.
    """

    exponents: Exponents
    factor: float | None = 1.0
    text: str = field(default="", compare=False)
    soft: bool = field(default=False, compare=False)

    def __mul__(self, other: Unit) -> Unit:
        pairs = zip(self.exponents, other.exponents, strict=True)
        exponents, factor = tuple(_whole(a + b) for a, b in pairs), _product(self.factor, other.factor)
        return Unit(exponents, factor, soft=self.soft or other.soft)

    def __truediv__(self, other: Unit) -> Unit:
        return self * other**-1

    def __pow__(self, power: int | Fraction) -> Unit:
        factor = None if self.factor is None else self.factor ** float(power)
        return Unit(tuple(_whole(a * power) for a in self.exponents), factor, soft=self.soft)

    @property
    def dimensionless(self) -> bool:
        return self.exponents == _NONE

    def same(self, other: Unit) -> bool:
        """Equal dimension, and equal factor where both are known."""
        return self.exponents == other.exponents and not self.scaled(other)

    def scaled(self, other: Unit) -> bool:
        """Do the factors, where both are known, differ?"""
        if self.factor is None or other.factor is None:
            return False
        return not math.isclose(self.factor, other.factor, rel_tol=1e-9)

    def __str__(self) -> str:
        return self.text or format_unit(self)


def _product(a: float | None, b: float | None) -> float | None:
    return None if a is None or b is None else a * b


def _whole(a: int | Fraction) -> int | Fraction:
    return a.numerator if a.denominator == 1 else a


DIMENSIONLESS = Unit(_NONE)


def _unit(factor: float = 1.0, **powers: int) -> Unit:
    return Unit(tuple(powers.get(b, 0) for b in _BASE), factor)


_SYMBOLS: dict[str, Unit] = {
    "1": DIMENSIONLESS, "rad": DIMENSIONLESS, "sr": DIMENSIONLESS, "%": _unit(0.01), "deg": _unit(math.pi / 180),
    "rev": _unit(2 * math.pi), "ppm": _unit(1e-6), "dB": DIMENSIONLESS, "Np": DIMENSIONLESS, "bit": DIMENSIONLESS,
    "m": _unit(m=1), "g": _unit(1e-3, kg=1), "s": _unit(s=1), "A": _unit(A=1), "K": _unit(K=1),
    "mol": _unit(mol=1), "cd": _unit(cd=1), "degC": _unit(K=1), "Hz": _unit(s=-1), "N": _unit(m=1, kg=1, s=-2),
    "Pa": _unit(m=-1, kg=1, s=-2), "J": _unit(m=2, kg=1, s=-2), "W": _unit(m=2, kg=1, s=-3), "C": _unit(s=1, A=1),
    "V": _unit(m=2, kg=1, s=-3, A=-1), "Ohm": _unit(m=2, kg=1, s=-3, A=-2), "S": _unit(m=-2, kg=-1, s=3, A=2),
    "F": _unit(m=-2, kg=-1, s=4, A=2), "H": _unit(m=2, kg=1, s=-2, A=-2), "Wb": _unit(m=2, kg=1, s=-2, A=-1),
    "T": _unit(kg=1, s=-2, A=-1), "lm": _unit(cd=1), "lx": _unit(m=-2, cd=1), "Bq": _unit(s=-1),
    "Gy": _unit(m=2, s=-2), "Sv": _unit(m=2, s=-2), "kat": _unit(mol=1, s=-1),
    "eV": _unit(1.602176634e-19, m=2, kg=1, s=-2),
    "min": _unit(60.0, s=1), "h": _unit(3600.0, s=1), "d": _unit(86400.0, s=1), "l": _unit(1e-3, m=3),
    "L": _unit(1e-3, m=3), "t": _unit(1e3, kg=1), "bar": _unit(1e5, m=-1, kg=1, s=-2), "rpm": _unit(math.pi / 30, s=-1),
    "var": _unit(m=2, kg=1, s=-3), "VA": _unit(m=2, kg=1, s=-3), "ohm": _unit(m=2, kg=1, s=-3, A=-2),
    "Wh": _unit(3600.0, m=2, kg=1, s=-2), "Ah": _unit(3600.0, s=1, A=1), "ppb": _unit(1e-9), "percent": _unit(0.01),
    "pu": DIMENSIONLESS, "count": DIMENSIONLESS, "counts": DIMENSIONLESS, "pulse": DIMENSIONLESS,
    "pulses": DIMENSIONLESS, "in": _unit(0.0254, m=1), "ft": _unit(0.3048, m=1), "mi": _unit(1609.344, m=1),
    "kph": _unit(1 / 3.6, m=1, s=-1), "mph": _unit(0.44704, m=1, s=-1), "kn": _unit(1852 / 3600, m=1, s=-1),
    "lb": _unit(0.45359237, kg=1), "kgf": _unit(9.80665, m=1, kg=1, s=-2),
    "lbf": _unit(4.4482216152605, m=1, kg=1, s=-2), "psi": _unit(6894.757293168361, m=-1, kg=1, s=-2),
    "atm": _unit(101325.0, m=-1, kg=1, s=-2), "Torr": _unit(101325 / 760, m=-1, kg=1, s=-2),
    "mmHg": _unit(133.322387415, m=-1, kg=1, s=-2), "P": _unit(0.1, m=-1, kg=1, s=-1), "St": _unit(1e-4, m=2, s=-1),
}  # fmt: skip

_PREFIXES = {
    "da": 1e1, "Y": 1e24, "Z": 1e21, "E": 1e18, "P": 1e15, "T": 1e12, "G": 1e9, "M": 1e6, "k": 1e3, "h": 1e2,
    "d": 1e-1, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9, "p": 1e-12, "f": 1e-15, "a": 1e-18, "z": 1e-21, "y": 1e-24,
}  # fmt: skip

_UNPREFIXED = (
    "1", "%", "kg", "min", "h", "d", "deg", "degC", "rev", "rpm", "ppm", "ppb", "pu", "percent", "rad", "sr",
    "count", "counts", "pulse", "pulses", "in", "ft", "mi", "mph", "kph", "kn", "lb", "lbf", "kgf", "psi", "atm",
    "mmHg",
)  # fmt: skip
LONGEST = 100  # characters of a unit: a line of text; parentheses are read by recursion
_TOKEN = re.compile(r"\s*([A-Za-z%]+|1(?![0-9.])|[/()]|\.(?![0-9])|\^?[+-]?[0-9]+(?:\.[0-9]+)?|\^\([^()]+\))")
_POWER = re.compile(r"\^?\(?([+-]?[0-9]+(?:\.[0-9]+|/[1-9][0-9]*)?)\)?")
_OTHERWISE = str.maketrans({
    "*": ".", "\u00b7": ".", "\u22c5": ".", "\u00b5": "u", "\u03bc": "u", "\u03a9": "Ohm", "\u2126": "Ohm",
    "\u00b0": "deg", "\u00b2": "2", "\u00b3": "3",
})  # fmt: skip
_PRODUCT = r"[A-Za-z%]+(?:[+-]?[0-9.]*[0-9])?(?:\.[A-Za-z%]+(?:[+-]?[0-9.]*[0-9])?)*"
_STANDARD = re.compile(rf"(?:1|{_PRODUCT}|\({_PRODUCT}\))(?:/(?:[A-Za-z%]+(?:[+-]?[0-9.]*[0-9])?|\({_PRODUCT}\)))?")


def symbols() -> list[str]:
    """Every unit that has a symbol of its own, without prefixes."""
    return sorted(set(_SYMBOLS) - {"1"})


@lru_cache(maxsize=1024)
def parse_unit(text: str) -> Unit:
    """The unit that `text` means. Raises ValueError with a sentence for what cannot be read, UnknownSymbol where it can
    and is not known."""
    result = DIMENSIONLESS
    try:
        for symbol, power in factors_of(text):
            result = result * _symbol(symbol, text) ** power
    except OverflowError:
        raise ValueError(f"{text!r} has a scale beyond all numbers") from None
    if not 0 < (result.factor or 0.0) < math.inf:
        raise ValueError(f"{text!r} has a scale beyond all numbers")
    return replace(result, text=text)


def factors_of(text: str) -> list[tuple[str, int | Fraction]]:
    """The symbols of a unit with their powers, those below a stroke negative. Read are, besides what the language has
    (19.1), the notations of practice: several strokes from left to right, all after one below it, `^` before a power,
    `*`, a raised dot or a space for a product, parentheses anywhere, raised 2 and 3, and a dash for 1. Raises
    ValueError as parse_unit does, but for symbols that are not known."""
    tokens, rest = [], text.translate(_OTHERWISE).strip()
    if len(rest) > LONGEST:
        raise ValueError(f"a unit of {len(rest)} characters")
    rest = "1" if rest == "-" else rest
    while rest:
        if (found := _TOKEN.match(rest)) is None:
            raise _no_unit(text)
        tokens.append(found[1])
        rest = rest[found.end() :]
    factors = _expression(tokens, text)
    if tokens:
        raise _no_unit(text)
    return factors


def is_standard(text: str) -> bool:
    """Whether a unit is written as the language has it (19.1), powers that are decimals aside."""
    return _STANDARD.fullmatch(text) is not None


def of_factors(factors: Iterable[tuple[str, int | Fraction]]) -> str:
    """A unit of these symbols and powers as the language writes it."""

    def group(sign: int) -> list[str]:
        powers = [(symbol, sign * power) for symbol, power in factors if symbol != "1" and sign * power > 0]
        return [symbol if power == 1 else f"{symbol}{written(power)}" for symbol, power in powers]

    factors = list(factors)
    above, below = ".".join(group(1)) or "1", ".".join(group(-1))
    if not below:
        return above
    return f"{above}/({below})" if "." in below else f"{above}/{below}"


def per_second(text: str) -> str:
    """The unit of a rate of what has this one; none of none. With a prefix as it is: mg/l a second is mg/(l.s)."""
    powers: dict[str, int | Fraction] = {}
    for symbol, power in [*factors_of(text), ("s", -1)] if text else ():
        powers[symbol] = powers.get(symbol, 0) + power
    return of_factors(powers.items()) if powers else ""


def _no_unit(text: str) -> ValueError:
    return ValueError(f"{text!r} is no unit: write products as N.m, quotients as rad/s, powers as m2")


def _expression(tokens: list[str], whole: str) -> list[tuple[str, int | Fraction]]:
    """What is taken off the front of the tokens, up to a closing parenthesis."""
    factors, sign = _power_of(tokens, whole), 1
    while tokens and tokens[0] != ")":
        if tokens[0] in "./":
            sign = -1 if tokens.pop(0) == "/" else sign
        factors += [(symbol, sign * power) for symbol, power in _power_of(tokens, whole)]
    return factors


def _power_of(tokens: list[str], whole: str) -> list[tuple[str, int | Fraction]]:
    """A symbol or a parenthesis, with its power."""
    token = tokens.pop(0) if tokens else ""
    if token == "(":
        factors = _expression(tokens, whole)
        if not tokens or tokens.pop(0) != ")":
            raise _no_unit(whole)
    elif re.fullmatch(r"[A-Za-z%]+|1", token):
        factors = [(token, 1)]
    else:
        raise _no_unit(whole)
    power = _POWER.fullmatch(tokens[0]) if tokens else None
    if power is None:
        return factors
    tokens.pop(0)
    return [(symbol, _whole(own * Fraction(power[1]))) for symbol, own in factors]


def _symbol(symbol: str, whole: str) -> Unit:
    if symbol in _SYMBOLS:
        return _SYMBOLS[symbol]
    for prefix, factor in _PREFIXES.items():
        rest = symbol.removeprefix(prefix)
        if rest != symbol and rest in _SYMBOLS and rest not in _UNPREFIXED:
            return Unit(_NONE, factor) * _SYMBOLS[rest]
    raise UnknownSymbol(f"there is no unit {symbol!r}" + (f", as in {whole!r}" if symbol != whole else ""))


_NAMED = (
    "N", "W", "V", "Ohm", "H", "F", "Wb", "T", "Pa", "C", "N.m", "V.s", "N.m.s", "N.s/m", "N/m", "kg.m2", "kg", "m/s",
    "m/s2", "V/m", "W/K", "J/K", "N.m/A", "A/s", "V/s", "W/A2",
)  # fmt: skip


@lru_cache(maxsize=1)
def _names() -> dict[Exponents, str]:
    return {parse_unit(text).exponents: text for text in reversed(_NAMED)}


def format_unit(unit: Unit) -> str:
    """A readable name: a common one where there is, else base units; another factor is shown before it."""
    exponents = unit.exponents
    text = "1" if unit.dimensionless else _names().get(exponents) or of_factors(zip(_BASE, exponents, strict=True))
    if unit.factor is not None and not math.isclose(unit.factor, 1.0, rel_tol=1e-9):
        text = f"{unit.factor:.6g} {text}"
    return text


def written(power: int | Fraction) -> str:
    """A power as a unit has it: a decimal where it is one."""
    decimal = f"{float(power):.6g}"
    return decimal if Fraction(decimal) == power else f"({power})"
