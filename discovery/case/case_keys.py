"""What may stand in case.toml: each table and key with its kind, its meaning and what holds where it is left out.

The one description of the file: the reader refuses what is not in it, and docs/guide/case-file.md is written from it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from lacuna.given import GREATEST
from lacuna.suggest import did_you_mean


class KeyProblem(Exception):
    """An entry that case.toml may not have: the message names it and says what was expected."""


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= GREATEST


def _is_names(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(v, str) and v for v in value)


@dataclass(frozen=True)
class Kind:
    """What a value must be: `text` completes "it must be ..."."""

    text: str
    accepts: Callable[[Any], bool]


TEXT = Kind("a text", lambda v: isinstance(v, str))
NUMBER = Kind("a finite number of at most 1e150", _is_number)
NOT_NEGATIVE = Kind("a finite number of at least 0 and at most 1e150", lambda v: _is_number(v) and v >= 0)
POSITIVE = Kind("a positive number from 1e-150 to 1e150", lambda v: _is_number(v) and v >= 1 / GREATEST)
NAMES = Kind("a list of texts", _is_names)
FILES = Kind("a list of at least one file", lambda v: _is_names(v) and bool(v))
_KNOWN = ("recorded", "unknown")
START = Kind('a finite number of at most 1e150, "recorded" or "unknown"', lambda v: _is_number(v) or v in _KNOWN)


def one_of(*choices: str) -> Kind:
    return Kind(" or ".join(f'"{c}"' for c in choices), lambda v: v in choices)


@dataclass(frozen=True)
class Key:
    kind: Kind
    meaning: str
    absent: str = ""  # what holds where it is left out; "" where it must not be left out
    needed: bool = False


@dataclass(frozen=True)
class Table:
    """`keys` of fixed names, or entries of any name (of a parameter, a column, a file): values or tables of `each`."""

    meaning: str
    keys: Mapping[str, Key | Table] = field(default_factory=dict)
    each: Key | Table | None = None
    entry: str = ""  # what the free names are names of
    needed: bool = False


_PARAMETERS = Table(
    "believed values, in the model's units; they replace its defaults",
    each=Key(NUMBER, "value", "the model's default"),
    entry="parameter",
)  # fmt: skip
_UNCERTAINTY = Table(
    "believed relative standard deviations of parameters; 0 is exact",
    each=Key(NOT_NEGATIVE, "relative standard deviation", "0.05, and 0 for what only a component's class says"),
    entry="parameter",
)  # fmt: skip
_INITIAL = Table(
    "states at the first sample", entry="state", each=Key(
        START, 'value in the unit of the state, "recorded" (the first sample, within its noise) or "unknown" (fitted)',
        "at rest at the model's start value"),
)  # fmt: skip

_ROLE = Key(one_of("input", "output"), "drives the simulation, or is compared with it", needed=True)

CASE = Table(
    "the case",
    {
        "title": Key(TEXT, "heads the report", "the folder's name"),
        "model": Key(
            TEXT, 'the believed model: a class of a library ("Benches.DcServo", "Plant.HotPlate"), a file beside '
            'case.toml ("HotPlate.mo": the class named like it, else its last), or a class in one '
            '("Plant.mo:Plant.HotPlate")', needed=True,
        ),
        "libraries": Key(NAMES, "package folders and .mo files that the model uses, relative to case.toml", "none"),
        "source": Key(TEXT, "where the recordings come from, and their licence", "nothing is said"),
        "parameters": _PARAMETERS,
        "uncertainty": _UNCERTAINTY,
        "signals": Table(
            "each column of the recordings but `time`",
            each=Table(
                "one column",
                {
                    "role": _ROLE,
                    "variable": Key(TEXT, "the model's variable that it records", "the column's name"),
                    "unit": Key(
                        TEXT, 'of the column: "rad/s", "mA", "deg", "1"; "degC" of a variable in K is read as K',
                        needed=True,
                    ),
                    "interpolation": Key(one_of("linear", "hold"), "of an input between its samples", "linear"),
                    "noise_std": Key(POSITIVE, "of its noise, in `unit`", "estimated from the recordings"),
                },
            ),
            entry="column", needed=True,
        ),
        "initial": _INITIAL,
        "recordings": Table(
            "the files",
            {
                "fit": Key(FILES, "may be fitted to", needed=True),
                "validate": Key(
                    FILES, "only judge: nothing is chosen or fitted on them but what one of them alone has",
                    needed=True,
                ),
            },
            needed=True,
        ),
        "recording": Table(
            "what holds in one recording only",
            each=Table(
                "one file",
                {"parameters": _PARAMETERS, "uncertainty": _UNCERTAINTY, "initial": _INITIAL},
            ),
            entry="file",
        ),
        "limits": Table(
            "of an input, for a proposed experiment",
            each=Table(
                "one input",
                {
                    "min": Key(NUMBER, "least value, in the unit of its variable", "what was recorded"),
                    "max": Key(NUMBER, "greatest value, in the unit of its variable", "what was recorded"),
                    "rate": Key(POSITIVE, "fastest change, per second", "what was recorded"),
                },
            ),
            entry="input",
        ),
    },
)  # fmt: skip


def with_dots(raw: Mapping[str, Any], table: Table = CASE) -> dict[str, Any]:
    """The case with names that have dots whole: TOML reads `motor.J = 1` as a table `motor` that has a J."""
    if isinstance(table.each, Key):
        return dict(_whole(raw))
    inner = {n: table.keys.get(n, table.each) for n in raw}
    return {
        n: with_dots(v, inner[n]) if isinstance(inner[n], Table) and isinstance(v, dict) else v for n, v in raw.items()
    }


def _whole(raw: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    for name, value in raw.items():
        if isinstance(value, dict) and value:
            yield from ((f"{name}.{inner}", v) for inner, v in _whole(value))
        else:
            yield name, value


def check(raw: Mapping[str, Any], table: Table = CASE, place: str = "") -> None:
    """Raise KeyProblem at the first entry that `table` does not have, that is of the wrong kind, or that is missing."""
    for name, item in table.keys.items():
        if item.needed and name not in raw:
            raise KeyProblem(f"{place}`{name}` is missing" if not place else f"{place}has no {name}")
    for name, value in raw.items():
        item = table.keys.get(name, table.each)
        if item is None:
            known = list(table.keys)
            hint = did_you_mean(name, known, f"there is {', '.join(known)}")
            what = "table" if isinstance(value, dict) else "key"
            raise KeyProblem(f"{place}there is no {what} `{name}`; {hint}")
        _check_item(name, value, item, place)


def _check_item(name: str, value: Any, item: Key | Table, place: str) -> None:
    if isinstance(item, Table):
        inner = f"{place[1:-2]}." if place else ""
        if not isinstance(value, dict):
            raise KeyProblem(f"{place}{name} = {value!r}; it must be a table, [{inner}{name}]")
        check(value, item, f"[{inner}{name}] ")
    elif not item.kind.accepts(value):
        raise KeyProblem(f"{place}{name} = {value!r}; it must be {item.kind.text}")


def reference() -> str:
    """The reference of case.toml in Markdown, from the description above."""
    lines = [
        "# case.toml",
        "",
        "Written by `python -m lacuna.discovery.case.case_keys`; a test holds it equal to what the reader accepts.",
        "",
    ]
    lines += ["Every key and table that a case may have; anything else is refused with the nearest right name.", ""]
    return "\n".join(lines + _described(CASE, "")) + "\n"


def _described(table: Table, path: str) -> list[str]:
    rows = [(n, k) for n, k in table.keys.items() if isinstance(k, Key)]
    lines = [
        f"## `[{path}]`" if path else "## Outside any table",
        "",
        f"{table.meaning[0].upper()}{table.meaning[1:]}.",
    ]
    if isinstance(table.each, Key):
        lines += [
            "",
            f"Each entry is `{table.entry} = {table.each.kind.text}`; where there is none: {table.each.absent}.",
        ]
    if rows:
        lines += ["", "| key | must be | meaning | left out |", "| --- | --- | --- | --- |"]
        lines += [f"| `{n}` | {k.kind.text} | {k.meaning} | {k.absent or 'refused'} |" for n, k in rows]
    lines.append("")
    for name, item in table.keys.items():
        if isinstance(item, Table):
            inner = f"{path}.{name}" if path else name
            free = isinstance(item.each, Table)
            lines += _described(item.each if free else item, f"{inner}.{item.entry.upper()}" if free else inner)
    return lines


if __name__ == "__main__":
    print(reference(), end="")
