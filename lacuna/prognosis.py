"""`lacuna.forecast`: from a history of pre-flight tests to the use that remains."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.bank import Bank
from lacuna.analysis.prognosis.forecast import Forecast, Limits, Options, forecasts
from lacuna.analysis.prognosis.history import Assess, History, read_histories
from lacuna.analysis.settings import PAPER, Settings, load_settings
from lacuna.degradation import degradation_laws

OPTIONS = Options()


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
) -> list[Forecast]:
    """When each actuator of `history` reaches the bands of `map`: one Forecast for each actuator and fault.

    `history` is a folder with history.csv (or .parquet), or such a file, or what `read_histories` gave. `map` is the
    folder of the actuator's map, which gives the bands and assesses recordings that have no severity yet; without it
    the
    paper's bands are taken. `laws` are further folders or files of degradation laws; `risk` the greatest probability
    of the last limit at an advised test; `horizon` how far ahead is looked, in the history's unit; `unit` "cycles" or
    "hours", where
    the table has both. `columns` and `unfiltered` as in `assess`. With `out`, also forecast.json, report.html and
    figures there.

    Raises AnalysisError where history, map or laws cannot be used, with file, row and reason.
    """
    settings = map_settings(map)
    options = Options(risk, horizon)
    if isinstance(history, Path | str):
        history = read_histories(history, assessor(map, columns, unfiltered), unit)
    bank = Bank(degradation_laws(laws))
    limits = {fault: limits_of(settings, fault) for fault in {h.fault for h in history}}
    said = forecasts(history, bank, lambda h: limits[h.fault], options)
    if out is not None:
        from lacuna import __version__
        from lacuna.analysis.prognosis.publish import publish

        publish(said, bank, Path(out), risk, __version__)
    return said


def map_settings(map: Path | str | None) -> Settings:
    """Of a map's folder; the paper's, where there is none."""
    if map is None:
        return load_settings(PAPER)
    file = Path(map) / "settings.toml"
    if not file.exists():
        raise AnalysisError(f"{map}: no map there (settings.toml is missing); make one by `lacuna maps --prepare`")
    return load_settings(file)


def limits_of(settings: Settings, fault: str = "") -> Limits:
    """Where the bands after the first begin; for another fault of the settings, by its symbol, its own limits."""
    own = settings.fault
    bands = settings.bands[1:]
    names = tuple(band.name for band in bands)
    if fault in ("", own.symbol, own.parameter):
        return Limits(names, tuple(band.first for band in bands), own.first, own.last)
    others = {entry["symbol"]: entry for entry in settings.raw.get("combined", [])}
    entry = others.get(fault)
    if entry is None:
        raise AnalysisError(f"{settings.path}: no fault {fault!r}; known: {', '.join([own.symbol, *others])}")
    if len(entry.get("limits", ())) != len(bands):
        raise AnalysisError(f"{settings.path}: fault {fault} needs as many `limits` as there are bands after the first")
    return Limits(names, tuple(map_float(entry["limits"])), float(entry["first"]), float(entry["last"]))


def map_float(values: Sequence[float]) -> list[float]:
    return np.asarray(values, dtype=float).tolist()


def assessor(folder: Path | str | None, columns, unfiltered: bool) -> Assess | None:
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
