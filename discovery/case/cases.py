"""A recording case: one folder with `case.toml` and its CSV recordings, read into the units of the model: SI where its
variables declare no others."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
import math
from pathlib import Path
import re

import numpy as np

from lacuna.analysis.recording.channel import RecordingError, on_one_time
from lacuna.analysis.recording.formats import read_recorded
from lacuna.codegen.flatten.model import flatten
from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.case_keys import KeyProblem, check, with_dots
from lacuna.discovery.case.case_model import UNITS, CaseModel, case_model, written_values
from lacuna.discovery.case.noise import Noise
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.case.signals import Signal, of_variable, signal_of
from lacuna.given import GREATEST, toml_of
from lacuna.runtime import RecordedInput

DEFAULT_UNCERTAINTY = 0.05  # believed relative 1-sigma of a parameter that case.toml does not mention


@dataclass
class Recording:
    """A file, or a part of one between gaps: `time` (n,) in s and each signal's samples (n,), NaN where missing.

    `file` and `piece` stay where a first share of it is taken (whose name says which). Of what comes `after_gap` no
    state is known at the first sample. `drives` has the times and samples (m,) of inputs by which a run is driven,
    where they are others than those of their columns.
    """

    name: str
    time: np.ndarray
    columns: dict[str, np.ndarray]
    file: str = ""
    piece: str = ""
    after_gap: bool = False
    drives: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.file, self.piece = self.file or self.name, self.piece or self.name

    def drive(self, column: str) -> tuple[np.ndarray, np.ndarray]:
        """Times (m,), in s, and samples (m,) of an input by which a run is driven."""
        return self.drives.get(column, (self.time, self.columns[column]))

    def played(self, signal: Signal) -> RecordedInput:
        """An input as a run is driven by it."""
        time, values = self.drive(signal.column)
        good = np.isfinite(values)
        if not good.all():  # else the samples themselves: every model of a case shares them
            time, values = time[good], values[good]
        return RecordedInput(time, values, signal.interpolation)

    def redriven(self, name: str, changes: Mapping[str, Callable[[np.ndarray], np.ndarray]]) -> Recording:
        """The recording with other samples of some inputs, under a name of its own, by which machines
        keep what they run it with."""
        columns = self.columns | {c: change(self.columns[c]) for c, change in changes.items()}
        drives = {c: (t, changes[c](v) if c in changes else v) for c, (t, v) in self.drives.items()}
        return replace(self, name=f"{self.name}/{name}", columns=columns, drives=drives)

    @property
    def interval(self) -> float:
        """Median time between samples, s."""
        return float(np.median(np.diff(self.time)))

    def index(self, time: float) -> int:
        return int(np.searchsorted(self.time, time))


@dataclass(frozen=True)
class Own:
    """What holds in one recording only: believed values, their relative sigmas, states at the first sample."""

    parameters: dict[str, float] = field(default_factory=dict)
    uncertainty: dict[str, float] = field(default_factory=dict)
    initial: dict[str, float | str] = field(default_factory=dict)


@dataclass(frozen=True)
class Limit:
    """How far an input may go in a further experiment, SI, and how fast per second; None: as recorded."""

    min: float | None = None
    max: float | None = None
    rate: float | None = None


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
    found: CaseModel | None = None  # where the class `model` is
    own: dict[str, Own] = field(default_factory=dict)  # what holds in one recording only, by its file
    limits: dict[str, Limit] = field(default_factory=dict)  # of inputs, for a proposed experiment
    noise: dict[str, Noise] = field(default_factory=dict)  # of outputs, where it is known from more than the recordings
    files: tuple[Path, ...] = ()  # what was read: case.toml, the user's model, the recordings

    @property
    def base(self) -> str:
        """Full name of the believed class."""
        return self.found.name if self.found else self.model

    @property
    def search_path(self) -> list[str] | None:
        """Where the classes are looked up; None: in this package's library alone."""
        return list(self.found.search_path) if self.found else None

    def library(self) -> Library:
        return self.found.library() if self.found else Library()

    def is_uncertain(self, parameter: str) -> bool:
        """Whether a parameter has a belief: the model's own, those whose numbers it writes, what case.toml names."""
        plain = re.sub(r"\[[^]]*\]", "", parameter)
        own = parameter == plain and "." not in plain
        return own or parameter in self.parameters or parameter in self.uncertainty or plain in self._written

    @cached_property
    def _written(self) -> set[str]:
        return written_values(self.library().find(self.base))

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


def load(folder: str | Path, libraries: Sequence[str | Path] = ()) -> Case:
    """Read `folder/case.toml` and its recordings. Raises CaseError, Diagnostic for the model; never reads truth.toml.

    `libraries` are looked up besides the ones that case.toml names.
    """
    folder = Path(folder)
    path = folder / "case.toml"
    raw = _read(path)
    signals = {column: signal_of(path, column, table) for column, table in raw["signals"].items()}
    if not any(s.role == "output" for s in signals.values()):
        raise CaseError(f'{path}: no signal has role = "output", so there is nothing to compare with')
    names = {key: raw["recordings"][key] for key in ("fit", "validate")}
    _distinct(path, [*names["fit"], *names["validate"]])
    case = Case(
        folder=folder,
        title=raw.get("title", folder.name),
        model=raw["model"],
        source=raw.get("source", ""),
        parameters=_floats(raw.get("parameters", {})),
        uncertainty=_floats(raw.get("uncertainty", {})),
        signals=signals,
        initial=dict(raw.get("initial", {})),
        found=case_model(folder, raw["model"], [*raw.get("libraries", []), *(Path(p).resolve() for p in libraries)]),
        own=_own(path, raw.get("recording", {}), [*names["fit"], *names["validate"]]),
        limits=_limits(path, raw.get("limits", {}), signals),
    )
    case.signals = signals = _as_modelled(case)
    own_model = (case.found.file,) if case.found and case.found.file else ()
    case.files = (path, *own_model, *(folder / name for name in (*names["fit"], *names["validate"])))
    case.fit = [read_recording(folder / name, signals) for name in names["fit"]]
    case.validate = [read_recording(folder / name, signals) for name in names["validate"]]
    return case


def _read(path: Path) -> dict:
    raw = with_dots(toml_of(path, CaseError))
    try:
        check(raw)
    except KeyProblem as error:
        raise CaseError(f"{path}: {error}") from error
    return raw


def _distinct(path: Path, files: list[str]) -> None:
    """Recordings are told apart by their names, also those of other folders; none counts twice, or judges what was
    fitted to it."""
    first: dict[str, str] = {}
    for file in files:
        other = first.setdefault(Path(file).name, "")
        if other == file:
            raise CaseError(f"{path}: {file} is named twice in [recordings]; none judges what was fitted to it")
        if other:
            raise CaseError(f"{path}: {other} and {file} have the same name; give one of the two another")
        first[Path(file).name] = file


def _floats(values: dict) -> dict[str, float]:
    return {name: float(value) for name, value in values.items()}


def _own(path: Path, tables: dict, files: list[str]) -> dict[str, Own]:
    for name in tables:
        if name not in files:
            raise CaseError(f'{path}: [recording."{name}"] is none of the recordings ({", ".join(files)})')
    return {
        Path(name).name: Own(
            _floats(t.get("parameters", {})), _floats(t.get("uncertainty", {})), dict(t.get("initial", {}))
        )
        for name, t in tables.items()
    }


def _limits(path: Path, tables: dict, signals: dict[str, Signal]) -> dict[str, Limit]:
    for column, table in tables.items():
        if column not in signals or signals[column].role != "input":
            raise CaseError(f"{path}: [limits.{column}] is none of the inputs")
        if table.get("min", -math.inf) >= table.get("max", math.inf):
            raise CaseError(f"{path}: [limits.{column}] min = {table['min']} is not below max = {table['max']}")
    return {column: Limit(**_floats(table)) for column, table in tables.items()}


def _as_modelled(case: Case) -> dict[str, Signal]:
    """The signals in the units, and of the types, of the variables that they record. Raises CaseError for an output
    of a Boolean or an Integer: its error is no number with a spread."""
    variables = flatten(case.library(), case.base, units=UNITS).variables
    known = {c: variables[s.variable] for c, s in case.signals.items() if s.variable in variables}
    for column, variable in known.items():
        if variable.type != "Real" and case.signals[column].role == "output":
            where = f"{case.folder / 'case.toml'}: [signals.{column}]"
            raise CaseError(f"{where} {variable.name} is {variable.type}: only Reals are compared; leave it out")
    return {c: of_variable(s, known[c].unit, known[c].type) if c in known else s for c, s in case.signals.items()}


def read_recording(path: Path, signals: dict[str, Signal]) -> Recording:
    """Read one file: `time` in s and a column for each signal; an empty field is a missing sample. Raises CaseError."""
    try:
        recorded = read_recorded(path)
    except RecordingError as error:
        raise CaseError(str(error)) from error
    if recorded.time not in ("time", "time [s]"):  # as `lacuna convert` writes it
        raise CaseError(f"{path}: column `time` is missing; is it `{recorded.time}`? Its unit is the second")
    missing = [column for column in signals if not any(column in (c.head.text, c.name) for c in recorded.channels)]
    if missing or not recorded.channels:
        has = ", ".join(c.head.text for c in recorded.channels)
        raise CaseError(f"{path}: column `{(missing or list(signals))[0]}` is missing (beside time there are {has})")
    for column, signal in signals.items():
        if (channel := recorded[column]).contradicts(signal.unit):
            said = f"is in {channel.unit} by its head, and in {signal.unit} by case.toml: make the two alike"
            raise CaseError(f"{path}: column `{channel.head.text}` {said}")
    time, columns = on_one_time([recorded[column] for column in signals])
    scaled = {
        name: values * signal.scale + signal.offset
        for (name, signal), values in zip(signals.items(), columns, strict=True)
    }
    for name, values in scaled.items():
        if np.any(np.abs(values) > GREATEST):
            raise CaseError(f"{path}: column `{name}` has a value beyond {GREATEST:g}: no quantity is so large")
    return Recording(path.name, time.copy(), scaled)
