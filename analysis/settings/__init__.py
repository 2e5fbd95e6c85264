"""The settings of a map: what is simulated, how it is sampled and analysed, and what was published.

settings/paper.toml says what each entry means.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.settings.schema import check
from lacuna.given import LARGEST, parsed_toml, text_of

PAPER = Path(__file__).with_name("paper.toml")
MOST_TESTS = 100_000  # of a map: each is simulated and leaves a file


@dataclass(frozen=True)
class Band:
    """An operating interval: severities from `first` to `last`, both included."""

    name: str
    mode: str
    first: float
    last: float
    action: str = ""  # what to do, a sentence
    published_rise: float | None = None  # A, of the mean RMS


MISSED = 1e-6  # of a step, by which the last severity may lie beside a whole number of them: what its digits round


@dataclass(frozen=True)
class Fault:
    """The axis of a map: a parameter of the model and its values."""

    parameter: str  # of the model
    symbol: str  # heads the first column of map.csv
    name: str
    unit: str  # in which people read it
    scale: float  # how many of that unit a value of 1 is
    first: float
    last: float
    step: float
    healthy: float = 0.0  # of a new part
    limits: tuple[float, ...] = ()  # of a fault beside the map's: where each band after the first begins

    def shown(self, severity):
        """A severity, or an array of them, in the unit that people read."""
        return self.scale * severity

    def text(self, severity: float) -> str:
        return f"{self.shown(severity):.4g} {self.unit}"

    @property
    def severities(self) -> list[float]:
        """Rising values, rounded to what their decimal text says."""
        count = round((self.last - self.first) / self.step)
        return [round(self.first + k * self.step, 12) for k in range(count + 1)]


@dataclass(frozen=True)
class Settings:
    """One settings file, and its `text`."""

    path: Path
    text: str
    title: str
    model: str
    fault: Fault
    sampling_rate: float  # Hz
    duration: float  # s
    currents: tuple[str, ...]
    speed: str
    angle: str
    section: float  # of the record
    overlap: float  # of a section
    padding: str  # none | section | record
    peak_above: float  # Hz
    peak_threshold: float  # of the largest line
    speed_after: float  # s
    solver: str
    relative_tolerance: float
    absolute_tolerance: float
    bands: tuple[Band, ...]
    published: dict[str, Any]
    raw: dict[str, Any]

    def table(self, name: str) -> dict[str, Any]:
        """A table that not every use of the settings needs. Raises AnalysisError where it, or an entry, is missing."""
        if name not in self.raw:
            raise AnalysisError(f"{self.path}: table [{name}] is missing")
        return _Table(f"{self.path}: {name}", self.raw[name])

    @property
    def quick_solver(self) -> str:
        """Of tests that are solved by the hundred, or while somebody waits: the assessment's, where it names one."""
        return self.raw.get("assessment", {}).get("solver", self.solver)

    @property
    def own_parameters(self) -> dict[str, float]:
        """Parameters of the model that every test has, other than declared."""
        actuator = self.raw["actuator"]
        return dict(zip(actuator.get("parameters", []), actuator.get("values", []), strict=True))

    @property
    def nuisances(self) -> list[dict[str, Any]]:
        """What disturbs the parameters of a test. Raises AnalysisError where one moves the fault's own."""
        found: list[dict[str, Any]] = self.raw.get("nuisances", [])
        for nuisance in found:
            if self.fault.parameter in nuisance["parameters"]:
                moves = f"[[nuisances]] `{nuisance['name']}` moves {self.fault.parameter}"
                raise AnalysisError(f"{self.path}: {moves}, which is the fault: take it out")
        return found

    def band_of(self, severity: float) -> Band:
        """In a gap between bands, the nearer one."""
        return min(self.bands, key=lambda band: max(band.first - severity, severity - band.last))

    @property
    def disturbed_model(self) -> str:
        """The model of tests under nuisances: [assessment] may name one that has more of them than the map's."""
        return self.raw.get("assessment", {}).get("model", self.model)

    @property
    def samples(self) -> int:
        return round(self.sampling_rate * self.duration)


class _Table(dict):
    def __init__(self, place: str, entries: dict[str, Any]):
        super().__init__(entries)
        self._place = place

    def __missing__(self, key: str) -> None:
        raise AnalysisError(f"{self._place}.{key} is missing")


def load_settings(path: Path | str = PAPER) -> Settings:
    """Read a settings file. Raises AnalysisError naming the file and the entry that is missing or impossible."""
    path = Path(path)
    return settings_of(text_of(path, AnalysisError), path)


def settings_of(text: str, path: Path) -> Settings:
    """The settings that `text` says; `path` is named in errors. Raises AnalysisError."""
    raw = parsed_toml(text, path, AnalysisError)
    check(raw, path)
    settings = _settings(path, text, raw)
    _check_sizes(settings)
    _check_bands(settings)
    _check_parameters(settings)
    return settings


def _check_sizes(settings: Settings) -> None:
    """A map of a number of tests, and recordings of a size, that can be made and read again."""
    path, others = settings.path, settings.raw.get("combined", [])
    _check_axis(f"{path}: [fault]", settings.raw["fault"])
    for k, other in enumerate(others):
        _check_axis(f"{path}: [[combined]] {other['symbol']}", other)
        if other["symbol"] in [before["symbol"] for before in others[:k]]:
            raise AnalysisError(f"{path}: two [[combined]] have the symbol {other['symbol']}: rename one")
    if len(set(settings.currents)) < len(settings.currents):
        raise AnalysisError(f"{path}: [signals] names a current twice")
    if settings.sampling_rate * settings.duration * 8 * (len(settings.currents) + 2) > LARGEST:
        raise AnalysisError(f"{path}: [recording] makes more than {LARGEST >> 20} MB a test")
    if not settings.speed_after < settings.duration:
        raise AnalysisError(f"{path}: speed.after is {settings.speed_after:g} s of a test of {settings.duration:g} s")


def _check_axis(place: str, entry: dict[str, Any]) -> None:
    """Severities in whole steps; what is healthy, and the limits, among them."""
    first, last, step = entry["first"], entry["last"], entry["step"]
    if last < first:
        raise AnalysisError(f"{place} needs first <= last")
    if (last - first) / step > MOST_TESTS:
        raise AnalysisError(f"{place} makes more than {MOST_TESTS} tests of a map")
    steps = (last - first) / step
    if abs(steps - round(steps)) > MISSED:
        raise AnalysisError(f"{place} goes from {first:g} to {last:g}, no whole steps of {step:g}")
    if not first <= entry.get("healthy", first) <= last:
        raise AnalysisError(f"{place}: healthy is {entry['healthy']:g}, outside of {first:g} to {last:g}")
    rising = [first, *entry.get("limits", [])]
    if not all(below < above <= last for below, above in pairwise(rising)):
        raise AnalysisError(f"{place}: limits must rise from above {first:g} to at most {last:g}: {rising[1:]}")


def _check_bands(settings: Settings) -> None:
    """In rising order, not overlapping. Gaps between them are allowed, the paper has some."""
    if not settings.bands:
        raise AnalysisError(f"{settings.path}: at least one severity band is needed")
    for band in settings.bands:
        if not band.first <= band.last:
            raise AnalysisError(f"{settings.path}: band {band.name}: first is above last")
    for other in settings.raw.get("combined", []):
        if "limits" in other and len(other["limits"]) != len(settings.bands) - 1:
            place, wanted = f"{settings.path}: [[combined]] {other['symbol']}", len(settings.bands) - 1
            raise AnalysisError(f"{place}: limits are where the bands after the first begin: {wanted} are needed")
    for before, band in pairwise(settings.bands):
        if not before.last < band.first:
            raise AnalysisError(f"{settings.path}: band {band.name} does not begin above the end of {before.name}")


def _check_parameters(settings: Settings) -> None:
    """Each has one value in a test: what two entries give would be that of the later one."""
    path, fault = settings.path, settings.fault.parameter
    if fault in settings.own_parameters:
        raise AnalysisError(f"{path}: actuator.parameters names {fault}, which the fault sets: take it out")
    refused, warned = (settings.raw.get("assessment", {}).get(name) for name in ("improbable", "doubtful"))
    if refused is not None and warned is not None and warned < refused:
        raise AnalysisError(f"{path}: assessment.doubtful, {warned:g}, is below assessment.improbable, {refused:g}")
    mover: dict[str, str] = {}
    for nuisance in settings.raw.get("nuisances", []):
        for parameter in nuisance["parameters"]:
            if parameter in mover:
                names = f"`{mover[parameter]}` and `{nuisance['name']}`"
                raise AnalysisError(f"{path}: [[nuisances]] {names} both move {parameter}: leave one")
            mover[parameter] = nuisance["name"]


def _settings(path: Path, text: str, raw: dict[str, Any]) -> Settings:
    signals, recording, solver = raw["signals"], raw["recording"], raw["solver"]
    spectrum, peak = raw["spectrum"], raw["first_peak"]
    return Settings(
        path=path,
        text=text,
        title=raw["title"],
        model=raw["actuator"]["model"],
        fault=Fault(**raw["fault"]),
        sampling_rate=float(recording["sampling_rate"]),
        duration=float(recording["duration"]),
        currents=tuple(signals["currents"]),
        speed=signals["speed"],
        angle=signals["angle"],
        section=float(spectrum["section"]),
        overlap=float(spectrum["overlap"]),
        padding=spectrum["padding"],
        peak_above=float(peak["above"]),
        peak_threshold=float(peak["threshold"]),
        speed_after=float(raw["speed"]["after"]),
        solver=solver["name"],
        relative_tolerance=float(solver["relative_tolerance"]),
        absolute_tolerance=float(solver["absolute_tolerance"]),
        bands=tuple(Band(**band) for band in raw["bands"]),
        published=raw.get("published", {}),
        raw=raw,
    )
