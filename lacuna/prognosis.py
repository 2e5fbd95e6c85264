"""`lacuna.forecast`: from a history of pre-flight tests to the use that remains."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from importlib.metadata import version
from pathlib import Path
from typing import Any

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis import diagnoses
from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.forecast import Forecast, Limits, Options, forecasts
from lacuna.analysis.prognosis.history import FILES, Assess, History, read_histories
from lacuna.analysis.prognosis.pages.telling import counted_verdicts, forecast_json, sentence, urgency
from lacuna.analysis.prognosis.tracks import tracks
from lacuna.analysis.settings import PAPER, Settings, load_settings
from lacuna.dated_cases import explained
from lacuna.degradation import degradation_laws
from lacuna.extras import names_missing_packages
from lacuna.progress import Progress, counted, spoken

OPTIONS = Options()
SHOWN = 20  # sentences that a notebook shows


class Prognosis:
    """What is said of every actuator of a history, most urgent first.

    `content` is that of forecast.json. `prognosis["A17"]` is one actuator's part of it.
    """

    def __init__(self, said: list[Forecast], risk: float) -> None:
        self.forecasts = sorted(said, key=urgency)
        self._risk = risk
        self.content: dict[str, Any] = forecast_json(self.forecasts, risk, version("lacuna"))

    def __getitem__(self, actuator: str) -> dict[str, Any]:
        known: dict[str, Any] = self.content["actuators"]
        if actuator not in known:
            raise KeyError(f"there is no actuator {actuator}; there are {', '.join(list(known)[:10])}")
        return dict(known[actuator])

    def __len__(self) -> int:
        return len(self.forecasts)

    @property
    def sentences(self) -> list[str]:
        return [sentence(f, self._risk) for f in self.forecasts]

    @property
    def warnings(self) -> list[str]:
        return [f"{f.history.actuator}: {text}" for f in self.forecasts for text in f.warnings]

    def __repr__(self) -> str:
        return f"<Prognosis of {len(self)} histories: {counted_verdicts(self.forecasts)}>"

    def _repr_html_(self) -> str:
        return "".join(f"<p>{escape(text)}</p>" for text in self.sentences[:SHOWN])


@names_missing_packages
def forecast(
    history: Path | str | Sequence[History],
    map: Path | str | None = None,
    out: Path | str | None = None,
    *,
    laws: Sequence[Path | str] = (),
    risk: float = OPTIONS.risk,
    horizon: float | None = None,
    unit: str | None = None,
    columns: Sequence[str] | None = None,
    unfiltered: bool = False,
    limits: Mapping[str, float] | None = None,
    progress: Progress | None = None,
) -> Prognosis:
    """When each actuator of `history` reaches the bands of `map`, how sure that is, and its last advisable test.

    `history` is a folder with history.csv (or .parquet), such a file, a history store (URL, or .db file), or what
    `read_histories` gave. `map` is the folder of the actuator's map, which gives the bands and assesses recordings that
    have no severity yet; without it the paper's bands are taken. `laws` are further folders or files of degradation
    laws; `risk` the greatest probability of the last limit at an advised test; `horizon` how far ahead is looked, in
    the history's unit; `unit` "cycles" or "hours", where the table has both. `columns` and `unfiltered` as in `assess`.
    `limits` {quantity: value} belong to a history of diagnoses by `explain` (column diagnosis): parameters of the
    model, or effect@location.parameter; a case that has no diagnosis yet is explained first, and its diagnosis kept in
    out/diagnoses. With `out`, also forecast.json, report.html and figures there.

    Raises AnalysisError where history, map or laws cannot be used, with file, row and reason.
    """
    settings = map_settings(map)
    options = Options(risk, horizon)
    spoken(progress)("reading the history")
    kept = Path(out) / "diagnoses" if out is not None else Path("out/explain")
    inputs = []
    if isinstance(history, Path | str):
        inputs = files_of(history)
        read = diagnoses.Reader(limits or {}, explained(kept, progress))
        history = _read(history, assessor(map, columns, unfiltered), unit, read)
    history = tracks(history, () if limits else own_names(settings))
    bank = Bank(degradation_laws(laws))
    faults = {h.fault for h in history}
    if limits and not faults <= set(limits):
        raise AnalysisError("a history is of severities or of diagnoses, not of both; `limits` are for diagnoses")
    own = {fault: diagnoses.SHARES if limits else limits_of(settings, fault) for fault in faults}
    said = forecasts(history, bank, lambda h: own[h.fault], options, progress=counted("forecasting", progress))
    if out is not None:
        from lacuna.analysis.prognosis.pages.publish import publish

        publish(said, bank, Path(out), risk, version("lacuna"), inputs)
    return Prognosis(said, risk)


def files_of(history: Path | str) -> list[Path]:
    """The file that a history is read from; none of a store."""
    path = Path(history)
    return [file for file in (path, *(path / name for name in FILES)) if file.is_file()][:1]


def _read(source: Path | str, assess: Assess | None, unit: str | None, diagnosed: diagnoses.Reader) -> list[History]:
    """Of a table or a store. Raises AnalysisError where there are diagnoses and no limit: it tells what drifts."""
    if "://" in str(source) or Path(source).suffix in (".db", ".sqlite"):
        from lacuna.analysis.prognosis.store import opened

        return list(opened(source).histories(unit))
    histories: list[History] = read_histories(source, assess, unit, diagnosed)
    if diagnosed.healthy and not diagnosed.limits:
        raise AnalysisError(f"{source}: which quantity has what limit? There are {diagnosed.drifts(histories)}")
    return histories


def map_settings(map: Path | str | None) -> Settings:
    """Of a map's folder; the paper's, where there is none."""
    if map is None:
        return load_settings(PAPER)
    file = Path(map) / "settings.toml"
    if not file.exists():
        raise AnalysisError(f"{map}: no map there (settings.toml is missing); make one by `lacuna maps --prepare`")
    return load_settings(file)


def own_names(settings: Settings) -> tuple[str, str]:
    """What the fault of the settings may be called in a history, where it is not left empty."""
    return settings.fault.symbol, settings.fault.parameter


def limits_of(settings: Settings, fault: str = "") -> Limits:
    """Where the bands after the first begin; for another fault of the settings, by its symbol, its own limits."""
    own = settings.fault
    bands = settings.bands[1:]
    names = tuple(band.name for band in bands)
    if fault in ("", *own_names(settings)):
        begins = tuple(band.first for band in bands)
        return Limits(names, begins, own.first, own.last, own.healthy, own.unit, own.scale)
    others = {entry["symbol"]: entry for entry in settings.raw.get("combined", [])}
    entry = others.get(fault)
    if entry is None:
        raise AnalysisError(f"{settings.path}: no fault {fault!r}; known: {', '.join([own.symbol, *others])}")
    if len(entry.get("limits", ())) != len(bands):
        raise AnalysisError(f"{settings.path}: fault {fault} needs as many `limits` as there are bands after the first")
    return Limits(
        names,
        tuple(floats(entry["limits"])),
        float(entry["first"]),
        float(entry["last"]),
        float(entry.get("healthy", 0.0)),
        str(entry["unit"]),
        float(entry["scale"]),
    )


def floats(values: Sequence[float]) -> list[float]:
    return [float(v) for v in values]


def assessor(folder: Path | str | None, columns: Sequence[str] | None, unfiltered: bool) -> Assess | None:
    """Severities of a recording by the map in `folder`: of one fault, or of two where the map has two."""
    if folder is None:
        return None
    from lacuna.analysis.severity.assessment import assess
    from lacuna.analysis.severity.combined.assessment import assess_both
    from lacuna.analysis.severity.combined.grid import GRID_FILE, load_grid

    if (Path(folder) / GRID_FILE).exists():
        second = load_grid(Path(folder)).other.symbol

        def both(recording: Path) -> list[tuple[str, float, float, float]]:
            found = assess_both(recording, folder, columns=columns, unfiltered=unfiltered).estimate
            readings = [("", found.first), (second, found.second)]
            return [(fault, e.severity, e.low, e.high) for fault, e in readings]

        return both

    def one(recording: Path) -> list[tuple[str, float, float, float]]:
        found = assess(recording, folder, columns=columns, unfiltered=unfiltered).estimate
        return [("", found.severity, found.low, found.high)]

    return one
