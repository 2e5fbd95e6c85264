"""What the head of a column says: a name and a unit, in the ways people write them.

    n (rpm)    Time [s]    I_A/mA    u {V}    p, bar    t_s

The last is only believed where the rest of the name is one that can stand alone and the end is a unit.
"""

from __future__ import annotations

from dataclasses import dataclass
import re

from lacuna.recorded_units import UnitError, to_si

# How loggers write units that the language writes otherwise.
_SPELLINGS = {
    "°C": "degC", "℃": "degC", "C°": "degC", "grad C": "degC", "°": "deg", "Ω": "Ohm", "1/min": "rpm", "min-1": "rpm",
    "min^-1": "rpm", "U/min": "rpm", "r/min": "rpm", "rev/min": "rpm", "RPM": "rpm", "sec": "s", "secs": "s",
    "seconds": "s", "msec": "ms", "-": "1", "": "1", "Volt": "V", "Amp": "A", "Amps": "A", "lpm": "l/min",
    "ltr/min": "l/min", "hours": "h", "minutes": "min",
}  # fmt: skip
_SIGNS = str.maketrans("µμ⁰¹²³⁴⁵⁶⁷⁸⁹⁻·⋅∙×−", "uu0123456789-....-")
_TORQUE = re.compile(r"Nm(?![a-ln-z])")  # with any prefix, but for Nms, which could be read in two ways
_BRACKETS = re.compile(
    r"^(?P<name>.*?\S)\s*(?:\[(?P<a>[^\]]*)\]|\((?P<b>[^)]*(?:\([^)]*\)[^)]*)?)\)|\{(?P<c>[^}]*)\}|<(?P<d>[^>]*)>)$"
)
_ELEMENT = re.compile(r"\w\[\d+(,\s*\d+)*\]$")  # of an array, such as phase[2]: no unit, though 1 is one
_TIME = re.compile(
    r"^(time|t|zeit|temps|tiempo|tempo|timestamp|time[ _]?stamp|elapsed([ _]time)?|seconds|sec)$", re.IGNORECASE
)


@dataclass(frozen=True)
class Head:
    """`unit` is None where the head says none; `sure` is False where it was only inferred; `unread` is what the file
    says is the unit, and is none that is known."""

    text: str
    name: str
    unit: str | None
    sure: bool = True
    unread: str = ""

    @property
    def is_time(self) -> bool:
        return _TIME.match(self.name) is not None


def known_unit(text: str) -> str | None:
    """`text` as the language writes it, or None where it is no unit."""
    spelt = text.strip().translate(_SIGNS)
    spelt = _TORQUE.sub("N.m", _SPELLINGS.get(spelt, spelt))
    try:
        to_si(spelt)
    except UnitError:
        return None
    return spelt


def read_head(text: str, unit_row: str = "") -> Head:
    """The name and the unit of a column from its head, and from the cell of the row of units where there is one."""
    text = text.strip()
    if unit_row.strip():
        unit = known_unit(unit_row)
        return Head(text, text, unit, unit is not None, "" if unit else unit_row.strip())
    match = _BRACKETS.match(text)
    if match and not _ELEMENT.search(text):
        said = next(g for g in (match["a"], match["b"], match["c"], match["d"]) if g is not None)
        if (unit := known_unit(said)) is not None:
            return Head(text, match["name"].strip(), unit)
    for separator in (" in ", "/", ","):  # I_A/mA, but not a/b of two names: what follows must be a unit
        name, found, said = text.partition(separator)
        unit = known_unit(said) if found and said.strip() else None
        if unit is not None and name.strip():
            return Head(text, name.strip(), unit)
    name, found, said = text.rpartition("_")
    if found and len(name) > 0 and said not in ("1", "") and (unit := known_unit(said)) is not None:
        return Head(text, name, unit, sure=False)
    return Head(text, text, None, sure=False)
