"""What a settings file may hold: its tables, their entries, and what each entry can be."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
import re
import sys
from typing import Any

from lacuna.analysis.errors import AnalysisError
from lacuna.runtime import ADAPTIVE
from lacuna.suggest import did_you_mean


@dataclass(frozen=True)
class Rule:
    """`what` an entry is, in words, and whether a value `holds` to it."""

    what: str
    holds: Callable[[Any], bool]


_SYMBOL = re.compile(r"(?!rms_|peak_|speed_mean$)\w[\w.-]*")  # part of a folder's name, and a head beside features


def _number(what: str, holds: Callable[[float], bool]) -> Rule:
    def finite(value: Any) -> bool:
        number = isinstance(value, int | float) and not isinstance(value, bool)
        return number and abs(value) <= sys.float_info.max  # as any size of a whole number can be compared

    return Rule(f"a number{what}", lambda value: finite(value) and holds(value))


def _several(rule: Rule) -> Rule:
    return Rule(f"a list, each entry {rule.what}", lambda v: isinstance(v, list) and all(map(rule.holds, v)))


TEXT = Rule("a text", lambda value: isinstance(value, str))
NAME = Rule("the name of something, a text", lambda value: isinstance(value, str) and bool(value.strip()))
SYMBOL = Rule(
    "a name of letters, digits, _ . and - other than those of features",
    lambda value: isinstance(value, str) and bool(_SYMBOL.fullmatch(value)),
)
NUMBER = _number("", lambda value: True)
POSITIVE = _number(" above zero", lambda value: value > 0)
NOT_NEGATIVE = _number(" of zero or more", lambda value: value >= 0)
COUNT = _number(", whole and above zero", lambda value: value > 0 and float(value).is_integer())
TOLERANCE = _number(" above 0 and below 1", lambda value: 0 < value < 1)
SHARE = _number(" above 0 and at most 1", lambda value: 0 < value <= 1)
PART = _number(" of at least 0 and below 1", lambda value: 0 <= value < 1)
SOLVER = Rule(f"a solver that chooses its steps ({', '.join(ADAPTIVE)})", lambda value: value in ADAPTIVE)
PADDING = Rule("one of none, section, record", lambda value: value in ("none", "section", "record"))
NAMES, NUMBERS = _several(NAME), _several(NUMBER)
PAIR = Rule("two numbers, before and after the switch", lambda value: NUMBERS.holds(value) and len(value) == 2)

_FAULT = {
    "parameter": NAME, "symbol": SYMBOL, "name": TEXT, "unit": TEXT, "scale": POSITIVE, "first": NUMBER, "last": NUMBER,
    "step": POSITIVE, "healthy?": NUMBER, "limits?": NUMBERS,
}  # fmt: skip
TABLES: dict[str, dict[str, Rule]] = {  # an entry that ends with ? may be left out
    "actuator": {
        "model": NAME, "test?": TEXT, "parameters?": NAMES, "values?": NUMBERS, "pole_pairs?": COUNT,
        "strongest_angle?": NUMBER,
    },
    "fault": _FAULT,
    "recording": {"sampling_rate": POSITIVE, "duration": POSITIVE},
    "signals": {"currents": NAMES, "speed": NAME, "angle": NAME},
    "spectrum": {"section": SHARE, "overlap": PART, "padding": PADDING},
    "first_peak": {"above": NOT_NEGATIVE, "threshold": PART},
    "speed": {"after": NOT_NEGATIVE},
    "solver": {"name": SOLVER, "relative_tolerance": TOLERANCE, "absolute_tolerance": TOLERANCE},
}  # fmt: skip
OPTIONAL: dict[str, dict[str, Rule]] = {  # tables that not every use needs
    "published": {"first_peak_hz": PAIR, "first_peak_bin": PAIR, "switch": NUMBER, "ordering": TEXT},
    "filter": {"corner": POSITIVE, "sections": COUNT},
    "assessment": {
        "model?": NAME, "solver?": SOLVER, "conditions?": COUNT, "every?": COUNT, "sensor_gain?": NOT_NEGATIVE,
        "sensor_offset?": NOT_NEGATIVE, "sensor_noise?": NOT_NEGATIVE, "converter_step?": NOT_NEGATIVE,
        "floor?": NOT_NEGATIVE, "frequency_floor?": NOT_NEGATIVE, "maintenance?": NUMBER, "improbable?": PART,
        "doubtful?": PART,
    },
}  # fmt: skip
LISTS: dict[str, dict[str, Rule]] = {  # tables of which there may be several
    "bands": {"name": NAME, "mode": TEXT, "first": NUMBER, "last": NUMBER, "action?": TEXT, "published_rise?": NUMBER},
    "nuisances": {"name": TEXT, "parameters": NAMES, "spread?": NUMBERS, "shift?": NUMBERS},
    "combined": _FAULT,
    "strangers": {"name": TEXT, "parameters": NAMES, "factor?": NUMBERS, "value?": NUMBERS},
}
CHANGES = {"actuator": ("values",), "nuisances": ("spread", "shift"), "strangers": ("factor", "value")}


def check(raw: dict[str, Any], path: Path) -> None:
    """Raises AnalysisError naming `path` and the first entry that is missing, unknown, or not what it can be."""
    known = {"title": TEXT}, TABLES, OPTIONAL, LISTS
    for name in raw:
        if not any(name in names for names in known):
            _unknown(f"{path}: there is no table [{name}]", name, [n for names in known for n in names])
    _entries(f"{path}: ", {k: v for k, v in raw.items() if k == "title"}, {"title": TEXT})
    for name, rules in (TABLES | OPTIONAL).items():
        if name in raw or name in TABLES:
            _entries(f"{path}: {name}.", _table(path, raw, name), rules)
    for name, rules in LISTS.items():
        tables = raw.get(name, [])
        if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
            raise AnalysisError(f"{path}: {name} are tables: each begins with [[{name}]]")
        for number, table in enumerate(tables, start=1):
            _entries(f"{path}: {name}[{number}].", table, rules)
            _changes(f"{path}: {name}[{number}]", table, CHANGES.get(name, ()))
    if raw["actuator"].get("parameters") or raw["actuator"].get("values"):
        _changes(f"{path}: actuator", raw["actuator"], CHANGES["actuator"])


def _table(path: Path, raw: dict[str, Any], name: str) -> dict[str, Any]:
    if name not in raw:
        raise AnalysisError(f"{path}: table [{name}] is missing")
    if not isinstance(raw[name], dict):
        raise AnalysisError(f"{path}: {name} is a table: it begins with [{name}]")
    return raw[name]


def _entries(place: str, table: dict[str, Any], rules: dict[str, Rule]) -> None:
    known = {name.rstrip("?"): rule for name, rule in rules.items()}
    for name, value in table.items():
        if name not in known:
            _unknown(f"{place}{name} is not known", name, list(known))
        if not known[name].holds(value):
            raise AnalysisError(f"{place}{name} is {value!r}, not {known[name].what}")
    for name in rules:
        if name not in table and not name.endswith("?"):
            raise AnalysisError(f"{place}{name} is missing")


def _unknown(message: str, name: str, known: list[str]) -> None:
    raise AnalysisError(f"{message}; {did_you_mean(name, known, 'there is ' + ', '.join(known))}")


def _changes(place: str, table: dict[str, Any], ways: tuple[str, ...]) -> None:
    """Parameters, each once, and in one of the `ways` what becomes of each."""
    if not ways:
        return
    parameters, given = table.get("parameters", []), [name for name in ways if name in table]
    if len(given) > 1:
        raise AnalysisError(f"{place}: has {' and '.join(given)}, and parameters change in one of these ways")
    name = given[0] if given else " or ".join(ways)
    count = len(table[name]) if given else 0
    if count != len(parameters) or not given:
        raise AnalysisError(f"{place}: {len(parameters)} parameters, but {count} of {name}")
    for k, parameter in enumerate(parameters):
        if parameter in parameters[:k]:
            raise AnalysisError(f"{place}: names {parameter} twice")
