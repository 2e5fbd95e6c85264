"""What a map says, beside what was published: bands, first-peak frequencies, ordering, speed."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise
from string import ascii_lowercase
from typing import Any

import numpy as np

from lacuna.analysis.map.rows import Row
from lacuna.analysis.settings import Band, Settings


def summarise(settings: Settings, rows: list[Row]) -> dict[str, Any]:
    """The part of summary.json that is decided by the rows and the settings (SI units)."""
    severity = np.array([row.severity for row in rows])
    mean = np.array([row.rms_mean for row in rows])
    bands = [_band(band, severity, mean) for band in settings.bands]
    peaks = _peaks(rows)
    ordering = _ordering(rows)
    return {
        "title": settings.title,
        "fault": {"parameter": settings.fault.parameter, "name": settings.fault.name},
        "bands": bands,
        "peaks": peaks,
        "hz1": peaks[0]["hz"] if peaks else None,
        "hz2": peaks[1]["hz"] if len(peaks) > 1 else None,
        "switch_severity": peaks[1]["first"] if len(peaks) > 1 else None,
        "ordering": ordering,
        "speed_mean": {"first": rows[0].speed_mean, "last": rows[-1].speed_mean},
        "speed_falls": _falls([row.speed_mean for row in rows]),
        "comparison": _comparison(settings, bands, peaks, ordering, rows),
        "counters": dict(sum((Counter(row.counters) for row in rows), Counter())),
    }


def _band(band: Band, severity: np.ndarray, mean: np.ndarray) -> dict[str, Any]:
    first, last = np.interp([band.first, band.last], severity, mean)
    return {
        "name": band.name,
        "mode": band.mode,
        "first": band.first,
        "last": band.last,
        "rms_first": float(first),
        "rms_last": float(last),
        "rise": float(last - first),
        "published_rise": band.published_rise,
    }


def _peaks(rows: list[Row]) -> list[dict[str, Any]]:
    """Runs of severities over which every channel has its first peak on one and the same line."""
    runs: list[dict[str, Any]] = []
    for row in rows:
        shared = row.peak_bin[0] if len(set(row.peak_bin)) == 1 else None
        if runs and runs[-1]["bin"] == shared:
            runs[-1]["last"] = row.severity
        else:
            hz = row.peak_hz[0] if shared is not None else None
            runs.append({"bin": shared, "hz": hz, "first": row.severity, "last": row.severity})
    return runs


def _ordering(rows: list[Row]) -> str | None:
    """Channels by rising RMS, such as "A < C < B", where it is the same at every severity."""
    found = {tuple(int(k) for k in np.argsort(row.rms)) for row in rows}
    return " < ".join(ascii_lowercase[k].upper() for k in found.pop()) if len(found) == 1 else None


def _falls(values: list[float | None]) -> bool:
    return all(b is not None and a is not None and b < a for a, b in pairwise(values))


def _comparison(settings: Settings, bands: list, peaks: list, ordering: str | None, rows: list[Row]) -> list[dict]:
    """Rows of the table published/reproduced; `unit` says in which unit both are given."""
    table, fault = [], settings.fault
    for band in bands:
        if band["published_rise"] is not None:
            interval = f"{fault.shown(band['first']):.4g}-{fault.text(band['last'])}"
            name = f"rise of mean RMS, {band['name']} {interval}"
            table.append(_entry(name, "mA", 1e3 * band["published_rise"], 1e3 * band["rise"]))
    if not settings.published:
        return table
    published = settings.published
    for k, when in enumerate(("before", "after")):
        found = peaks[k] if k < len(peaks) else {"bin": None, "hz": None}
        name = f"first peak {when} the switch"
        table.append(_entry(name, "line", published["first_peak_bin"][k], found["bin"]))
        table.append(_entry(name, "Hz", published["first_peak_hz"][k], found["hz"]))
    switch = fault.shown(peaks[1]["first"]) if len(peaks) == 2 else None
    falls = "falls" if _falls([row.speed_mean for row in rows]) else "does not always fall"
    return [
        *table,
        _entry("first severity after the switch", fault.unit, fault.shown(published["switch"]), switch),
        _entry("order of the phase RMS", "", published["ordering"], ordering),
        _entry("mean speed with rising severity", "", "falls", falls),
    ]


def _entry(quantity: str, unit: str, published: Any, reproduced: Any) -> dict[str, Any]:
    return {"quantity": quantity, "unit": unit, "published": published, "reproduced": reproduced}
