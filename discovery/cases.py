"""A recording case: one folder with `case.toml` and its CSV recordings, read into SI units."""

from __future__ import annotations

import csv
from dataclasses import dataclass, field
import math
from pathlib import Path
import tomllib

import numpy as np

from lacuna.discovery.units import UnitError, to_si

DEFAULT_UNCERTAINTY = 0.05  # believed relative 1-sigma of a parameter that case.toml does not mention


class CaseError(Exception):
    """A case that cannot be read: the message names the file and, where there is one, the column and the line."""

    user_error = True


@dataclass(frozen=True)
class Signal:
    """One column: what it records and in which unit; `scale` turns the column into SI."""

    column: str
    role: str  # input | output
    variable: str
    unit: str
    si_unit: str
    scale: float
    interpolation: str = "linear"
    noise_std: float | None = None  # SI; None where case.toml does not give it


@dataclass
class Recording:
    """One file: `time` (n,) in s and each signal's samples (n,) in SI; missing samples are NaN."""

    name: str
    time: np.ndarray
    columns: dict[str, np.ndarray]

    @property
    def interval(self) -> float:
        """Median time between samples, s."""
        return float(np.median(np.diff(self.time)))

    def index(self, time: float) -> int:
        return int(np.searchsorted(self.time, time))


@dataclass
class Case:
    folder: Path
    title: str
    model: str
    source: str
    parameters: dict[str, float]
    uncertainty: dict[str, float]
    signals: dict[str, Signal]
    initial: dict[str, float | str] = field(default_factory=dict)
    fit: list[Recording] = field(default_factory=list)
    validate: list[Recording] = field(default_factory=list)

    @property
    def inputs(self) -> list[Signal]:
        return [s for s in self.signals.values() if s.role == "input"]

    @property
    def outputs(self) -> list[Signal]:
        return [s for s in self.signals.values() if s.role == "output"]

    @property
    def label(self) -> str:
        """The last two parts of the folder, as diagnosis.json names the case."""
        return "/".join(self.folder.resolve().parts[-2:])

    def sigma(self, name: str, value: float) -> float:
        """Believed absolute 1-sigma of a parameter around its believed `value`; 0 means exact."""
        return abs(value) * self.uncertainty.get(name, DEFAULT_UNCERTAINTY)


def load(folder: str | Path) -> Case:
    """Read `folder/case.toml` and its recordings. Raises CaseError; never reads truth.toml."""
    folder = Path(folder)
    path = folder / "case.toml"
    try:
        raw = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise CaseError(f"{path}: cannot be read ({error.strerror})") from error
    except tomllib.TOMLDecodeError as error:
        raise CaseError(f"{path}: {error}") from error
    for key in ("model", "signals", "recordings"):
        if key not in raw:
            raise CaseError(f"{path}: `{key}` is missing")
    signals = {column: _signal(path, column, table) for column, table in raw["signals"].items()}
    if not any(s.role == "output" for s in signals.values()):
        raise CaseError(f'{path}: no signal has role = "output", so there is nothing to compare with')
    case = Case(
        folder=folder,
        title=str(raw.get("title", folder.name)),
        model=str(raw["model"]),
        source=str(raw.get("source", "")),
        parameters=_numbers(path, "parameters", raw.get("parameters", {})),
        uncertainty=_numbers(path, "uncertainty", raw.get("uncertainty", {})),
        signals=signals,
        initial=dict(raw.get("initial", {})),
    )
    case.fit = [read_recording(folder / name, signals) for name in _names(path, raw["recordings"], "fit")]
    case.validate = [read_recording(folder / name, signals) for name in _names(path, raw["recordings"], "validate")]
    return case


def _numbers(path: Path, table: str, values: dict) -> dict[str, float]:
    for name, value in values.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise CaseError(f"{path}: [{table}] {name} = {value!r} is not a finite number")
    return {name: float(value) for name, value in values.items()}


def _names(path: Path, table: dict, key: str) -> list[str]:
    names = table.get(key)
    if not isinstance(names, list) or not names:
        raise CaseError(f"{path}: [recordings] {key} must list at least one file")
    return names


def _signal(path: Path, column: str, table: dict) -> Signal:
    where = f"{path}: [signals.{column}]"
    role = table.get("role")
    if role not in ("input", "output"):
        raise CaseError(f'{where} role = {role!r}; it must be "input" or "output"')
    if "unit" not in table:
        raise CaseError(f'{where} has no unit; give one, such as unit = "rad/s"')
    try:
        scale, si_unit = to_si(str(table["unit"]))
    except UnitError as error:
        raise CaseError(f"{where} {error}") from error
    interpolation = table.get("interpolation", "linear")
    if interpolation not in ("linear", "hold"):
        raise CaseError(f'{where} interpolation = {interpolation!r}; it must be "linear" or "hold"')
    noise = table.get("noise_std")
    if noise is not None and not (isinstance(noise, int | float) and math.isfinite(noise) and noise > 0):
        raise CaseError(f"{where} noise_std = {noise!r} is not a positive number")
    return Signal(
        column, role, str(table.get("variable", column)), str(table["unit"]), si_unit, scale, interpolation,
        None if noise is None else float(noise) * scale,
    )  # fmt: skip


def read_recording(path: Path, signals: dict[str, Signal]) -> Recording:
    """Read one CSV (header, then numbers; an empty field is a missing sample). Raises CaseError."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError) as error:
        raise CaseError(f"{path}: cannot be read ({error})") from error
    if not rows:
        raise CaseError(f"{path}: the file is empty")
    header = [name.strip() for name in rows[0]]
    for column in ("time", *signals):
        if column not in header:
            raise CaseError(f"{path}: column `{column}` is missing (the header has {', '.join(header)})")
    body = [row for row in rows[1:] if row]
    table = np.empty((len(body), len(header)))
    for i, row in enumerate(body):
        if len(row) != len(header):
            raise CaseError(f"{path}:{i + 2}: {len(row)} fields where the header has {len(header)}")
        try:
            table[i] = [float(text) if text.strip() else math.nan for text in row]
        except ValueError as error:
            raise CaseError(f"{path}:{i + 2}: {error}") from error
    columns = {name: table[:, header.index(name)] * signal.scale for name, signal in signals.items()}
    return Recording(path.name, table[:, header.index("time")].copy(), columns)
