"""A history: the pre-flight tests of one actuator in order of use, read from a table and checked.

`history.csv` (or Parquet) has the columns `actuator` and `cycles` or `hours`, then `severity, low, high` (fractions,
95 %) or
`recording` (a file beside it), and `event`: empty or `replaced` (the part was replaced before this row's test). A
column `fault` tells several faults of one actuator apart; a column `diagnosis` names what `lacuna explain` wrote of
the test.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import cached_property
from itertools import zip_longest
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.doubts import UNITS, doubts_of
from lacuna.given import GREATEST, require_file, text_of
from lacuna.rows import rows_of
from lacuna.suggest import nearest, question
from lacuna.texts import decimal

if TYPE_CHECKING:
    import pyarrow as pa

EVENTS = ("", "replaced")
SEPARATORS = {";": "semicolon", "\t": "tab"}  # that other programs write
COLUMNS = (
    "actuator", *UNITS, "severity", "low", "high", "event", "recording", "fault", "diagnosis",
)  # fmt: skip
FILES = ("history.csv", "history.parquet")
TWO_SIDED_95 = 1.959964

Row = dict[str, str | float | None]
Assess = Callable[[Path], "list[tuple[str, float, float, float]]"]  # (fault, severity, low, high) of a recording


@dataclass(frozen=True)
class History:
    """Arrays of one length, NaN where a test has no severity. `use` rises strictly."""

    actuator: str
    unit: str  # of `use`
    use: np.ndarray
    severity: np.ndarray
    low: np.ndarray
    high: np.ndarray
    replaced: np.ndarray  # bool: a new part from this row on
    fault: str = ""
    warnings: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()  # why no number may be trusted, where the table contradicts itself

    @cached_property
    def lives(self) -> list[slice]:
        """Rows of each part in turn; the last one is in service."""
        starts = [0, *(k for k in np.flatnonzero(self.replaced).tolist() if k)]
        return [slice(a, b) for a, b in zip(starts, [*starts[1:], len(self.use)], strict=True)]


def read_histories(
    path: Path | str, assess: Assess | None = None, unit: str | None = None, diagnosed: Assess | None = None
) -> list[History]:
    """Histories of a folder with history.csv or .parquet, or of such a file, in order of actuator.

    `assess` reads the severities of a recording where the table has none; it raises AnalysisError where the recording
    is refused, which is a missing test with a warning. `diagnosed` reads those of a diagnosis. `unit`: the column to
    count by, where there are both. Raises AnalysisError with file, row and reason for what cannot be a history.
    """
    file = _file(Path(path))
    rows = _table(file)
    if not rows:
        raise AnalysisError(f"{file}: the history has no rows")
    refuse_slips(file, rows[0][1])
    counted = _unit(file, rows, unit)
    groups: dict[tuple[str, str], _Group] = {}
    for number, row in rows:
        reader = _Reader(file, number, row)
        actuator = reader.text("actuator")
        if not actuator:
            raise reader.error("actuator is empty")
        for fault, *reading in reader.readings(assess, diagnosed):
            group = groups.setdefault((actuator, fault), _Group())
            group.add(reader, counted, reading)
    return [group.history(file, *key, counted) for key, group in sorted(groups.items())]


def _file(path: Path) -> Path:
    if not path.is_dir():
        if path.suffix.lower() not in (".csv", ".parquet"):
            raise AnalysisError(f"{path}: a history is a .csv or .parquet file, or a folder with history.csv")
        return path
    for name in FILES:
        if (path / name).exists():
            return path / name
    raise AnalysisError(f"{path}: no {' or '.join(FILES)} there")


def refuse_slips(file: Path | str, names: Iterable[str]) -> None:
    """A column of a table may be called as it likes, but not nearly as one that is missing: that would be lost."""
    missing = [name for name in COLUMNS if name not in names]
    for name in names:
        if name not in COLUMNS and (meant := nearest(str(name), missing)):
            raise AnalysisError(f"{file}: column {name} is not known; {question(meant)} (else call it another way)")


def parquet_table(file: Path) -> pa.Table:
    """Raises AnalysisError where there is none, or no row in it."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    require_file(file, AnalysisError)
    try:
        table = pq.read_table(file)
    except (pa.ArrowException, OSError) as error:
        raise AnalysisError(f"{file}: not a Parquet table: {error}") from None
    if not len(table):
        raise AnalysisError(f"{file}: the history has no rows")
    return table


def _table(file: Path) -> list[tuple[int, Row]]:
    """(line or row number, cells) with text cells stripped; empty cells are ''."""
    if file.suffix.lower() == ".parquet":
        rows = parquet_table(file).to_pylist()
        return [(k + 1, {n: "" if v is None else v for n, v in row.items()}) for k, row in enumerate(rows)]
    try:
        found = list(rows_of(text_of(file, AnalysisError, "utf-8-sig")))
    except ValueError as error:
        raise AnalysisError(f"{file}: not a table: {error}") from None
    names, rows = (found[0][1], found[1:]) if found else ([], [])
    if len(set(names)) != len(names):
        raise AnalysisError(f"{file}: a column occurs twice")
    for line, row in rows:
        if len(row) > len(names) > 1:
            raise AnalysisError(f"{file}:{line}: more cells than columns")
    return [(line, dict(zip_longest(names, row[: len(names)], fillvalue=""))) for line, row in rows]


def _unit(file: Path, rows: list[tuple[int, Row]], wanted: str | None) -> str:
    """What use is counted in: the column that every row has."""
    if wanted is not None and wanted not in UNITS:
        raise AnalysisError(f"use is counted in {' or '.join(UNITS)}, not {wanted!r}")
    columns = set(rows[0][1])
    if "actuator" not in columns:
        known = " ".join(map(str, columns))
        other = [name for mark, name in SEPARATORS.items() if mark in known]
        raise AnalysisError(
            f"{file}: columns are separated by {other[0]}s; a history has commas, and points in its numbers"
            if other and len(columns) == 1
            else f"{file}: column actuator is missing; there are {', '.join(sorted(map(str, columns)))}"
        )
    present = [unit for unit in UNITS if unit in columns]
    if not present:
        raise AnalysisError(f"{file}: column cycles (or hours) is missing")
    complete = [unit for unit in present if all(str(row[unit]) != "" for _, row in rows)]
    if wanted and wanted not in complete:
        raise AnalysisError(f"{file}: column {wanted} is missing or not complete")
    if not complete:
        line, unit = next((n, u) for n, row in rows for u in present if str(row[u]) == "")
        raise AnalysisError(
            f"{file}:{line}: {unit} is empty: cycles and hours are mixed, or a test has no count of use"
        )
    return wanted or complete[0]


@dataclass(frozen=True)
class _Reader:
    """One row: cells as text and numbers, refusals with their place."""

    file: Path
    number: int
    row: Row

    def error(self, reason: str) -> AnalysisError:
        return AnalysisError(f"{self.file}:{self.number}: {reason}")

    def text(self, name: str) -> str:
        return str(self.row.get(name, "")).strip()

    def value(self, name: str) -> float:
        """NaN where the cell is empty."""
        text = self.text(name)
        if text == "" or text.lower() == "nan":
            return math.nan
        try:
            return decimal(text)
        except ValueError:
            point = "; a decimal point is wanted" if "," in text else ""
            raise self.error(f"{name} is {text!r}, not a finite number{point}") from None

    def event(self) -> bool:
        event = self.text("event")
        if event not in EVENTS:
            raise self.error(f"event is {event!r}; known is 'replaced', or nothing")
        return event == "replaced"

    def readings(self, assess: Assess | None, diagnosed: Assess | None = None) -> list[tuple]:
        """(fault, severity, low, high, warning) of this test: given, or assessed, or none."""
        fault, severity = self.text("fault"), self.value("severity")
        if not math.isnan(severity):
            low, high = self.value("low"), self.value("high")
            if math.isnan(low) or math.isnan(high):
                raise self.error("severity without low and high, its 95 % interval")
            if not low <= severity <= high:
                raise self.error(f"severity {severity:g} lies outside its own interval {low:g} to {high:g}")
            return [(fault, severity, low, high, "")]
        if not (math.isnan(self.value("low")) and math.isnan(self.value("high"))):
            raise self.error("low and high without their severity; a row without a test leaves all three empty")
        if diagnosis := self.text("diagnosis"):
            if diagnosed is None:
                raise self.error(f"{diagnosis} cannot be read here: `lacuna forecast` reads diagnoses, with --limit")
            return [(*found, "") for found in diagnosed(self.file.parent / diagnosis)]
        name = self.text("recording")
        if not name:
            return [(fault, math.nan, math.nan, math.nan, "")]
        if assess is None:
            raise self.error(f"{name} has to be assessed, which `lacuna forecast` does by the actuator's map (--map)")
        path = self.file.parent / name
        if not path.exists():
            raise self.error(f"recording {name} is missing")
        try:
            return [(*found, "") for found in assess(path)]
        except AnalysisError as refusal:
            return [(fault, math.nan, math.nan, math.nan, f"{name} is not used: {refusal}")]


@dataclass
class _Group:
    """Rows of one actuator (and fault) as they come."""

    rows: list[tuple[int, float, float, bool, float, float, float]] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)

    def add(self, reader: _Reader, unit: str, reading: Iterable) -> None:
        severity, low, high, warning = reading
        use, other = (reader.value(u) for u in (unit, UNITS[1 - UNITS.index(unit)]))
        if not use >= 0:
            raise reader.error(f"{unit} is {use:g}, {'no number' if math.isnan(use) else 'below zero'}")
        if not use <= GREATEST:
            raise reader.error(
                f"{unit} is {use:g}, beyond {GREATEST:g}: forecasts look further ahead, and weigh squares"
            )
        replaced = reader.event()
        if self.rows and self.rows[-1][1] >= use:
            raise reader.error(
                f"{unit} do not increase: {use:g} after {self.rows[-1][1]:g} of actuator {reader.text('actuator')}; "
                "is this another actuator's test, or another unit?"
            )
        self.rows.append((reader.number, use, other, replaced, severity, low, high))
        if warning:
            self.warnings.append(warning)

    def history(self, file: Path, actuator: str, fault: str, unit: str) -> History:
        _, use, other, replaced, severity, low, high = (np.array(c) for c in zip(*self.rows, strict=True))
        doubts = doubts_of(file, [row[0] for row in self.rows], use, other, unit)
        replaced = replaced.astype(bool)
        if math.isnan(severity[-1]):
            last = f"{file}:{self.rows[-1][0]}: the last test of {actuator} has no severity"
            self.warnings.append(f"{last}; what is forecast begins there, at {use[-1]:g} {unit}")
        return History(actuator, unit, use, severity, low, high, replaced, fault, tuple(self.warnings), doubts)
