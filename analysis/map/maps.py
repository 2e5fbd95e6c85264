"""Operating maps: a plant simulated and analysed at every severity, written as tables, figures and a report."""

from __future__ import annotations

import csv
from dataclasses import dataclass
import hashlib
from importlib.metadata import version
import io
import json
import os
from pathlib import Path
from string import ascii_lowercase
from time import perf_counter
from typing import Any

from lacuna.analysis.map.plant import Plant
from lacuna.analysis.map.rows import Row, RowStore
from lacuna.analysis.map.summary import summarise
from lacuna.analysis.map.sweep import Progress, sweep
from lacuna.analysis.settings import Settings
from lacuna.written import whole_files


@dataclass(frozen=True)
class Map:
    """A finished map. `summary` is what summary.json holds; `seconds` the split of the time it took."""

    folder: Path
    rows: list[Row]
    summary: dict[str, Any]
    seconds: dict[str, float]


def build_map(
    plant: Plant,
    settings: Settings,
    out: Path | str,
    *,
    jobs: int | None = None,
    progress: Progress | None = None,
    resume: bool = True,
    figures: bool = True,
) -> Map:
    """Draw the map of `plant` into folder `out`: map.csv, summary.json, and with `figures` also SVG, PNG, report.html.

    Severities run in parallel over `jobs` threads (default: one a core); `progress(done, total)` follows them. Rows are
    kept in out/rows as they finish, so that an interrupted map goes on where it stopped; `resume=False` computes them
    all again. The folder's files are replaced together at the end, and left alone where nothing changed. Raises
    AnalysisError where a run or its analysis fails; then the folder keeps the map that it had.
    """
    out = Path(out)
    severities = settings.fault.severities
    store = RowStore(out / "rows", plant, settings)
    begin = perf_counter()
    rows = sweep(plant, settings, severities, store, jobs=jobs, progress=progress, resume=resume)
    seconds = {
        "sweep": perf_counter() - begin,
        "simulate_cpu": sum(row.seconds["simulate"] for row in rows),
        "analyse_cpu": sum(row.seconds["analyse"] for row in rows),
    }
    summary = summarise(settings, rows) | {
        "model": {"name": plant.name, "hash": plant.hash},
        "solver": settings.raw["solver"] | {"name": plant.solver},
        "jobs": jobs or os.cpu_count(),
        "seconds": {"passes": plant.passes} | seconds,
        "drawn": drawn_key(store) if figures else None,
    }
    if resume and _is_drawn(out, summary):
        return Map(out, rows, summary, seconds)
    with whole_files(out) as scratch:
        (scratch / "map.csv").write_text(map_csv(settings, rows), encoding="utf-8")
        (scratch / "settings.toml").write_text(settings.text, encoding="utf-8")
        (scratch / "summary.json").write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")
        if figures:
            seconds["figures"] = _illustrate(plant, settings, rows, summary, scratch)
    store.prune(severities)
    return Map(out, rows, summary, seconds)


def first_look(
    plant: Plant,
    settings: Settings,
    out: Path | str,
    every: int,
    *,
    jobs: int | None = None,
    progress: Progress | None = None,
) -> Map:
    """The map at each `every`-th severity and the last. Only its rows are written; `build_map` goes on from them."""
    out, severities = Path(out), settings.fault.severities
    some = [*severities[:-1:every], severities[-1]]
    rows = sweep(plant, settings, some, RowStore(out / "rows", plant, settings), jobs=jobs, progress=progress)
    return Map(out, rows, summarise(settings, rows) | {"model": {"name": plant.name, "hash": plant.hash}}, {})


def drawn_key(store: RowStore) -> str:
    """Of what decides the figures and the report: the rows' own key, the code that draws, and its library."""
    digest = hashlib.sha256(store.key.encode() + version("matplotlib").encode())
    report = Path(__file__).parents[1] / "report"
    for path in sorted([*report.glob("map*"), *report.glob("page.*"), *(report / "figures").glob("*.py")]):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _is_drawn(folder: Path, summary: dict[str, Any]) -> bool:
    """The folder has the figures and the report of this very map."""
    if not summary["drawn"] or not all((folder / name).exists() for name in ("map.csv", "report.html")):
        return False
    try:
        return json.loads((folder / "summary.json").read_text(encoding="utf-8")).get("drawn") == summary["drawn"]
    except (OSError, ValueError):
        return False


def _illustrate(plant: Plant, settings: Settings, rows: list[Row], summary: dict, folder: Path) -> float:
    begin = perf_counter()
    from lacuna.analysis.report.figures import draw_all  # Matplotlib takes a third of a second to import
    from lacuna.analysis.report.map import report_html

    draw_all(settings, rows, folder)
    (folder / "report.html").write_text(report_html(plant, settings, rows, summary, folder), encoding="utf-8")
    return perf_counter() - begin


def map_csv(settings: Settings, rows: list[Row]) -> str:
    """One line a severity, SI units: severity, RMS of each channel and their mean, first peaks, mean speed, counters.

    Numbers read back exactly; a feature that does not exist (no peak, no whole turn) is an empty field.
    """
    letters = ascii_lowercase[: len(settings.currents)]
    counters = list(rows[0].counters)
    header = [settings.fault.symbol, *(f"rms_{c}" for c in letters), "rms_mean"]
    header += [f"peak_{c}_{what}" for c in letters for what in ("hz", "bin")] + ["speed_mean", *counters]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    for row in rows:
        peaks = [value for pair in zip(row.peak_hz, row.peak_bin, strict=True) for value in pair]
        counts = [row.counters[name] for name in counters]
        writer.writerow([row.severity, *row.rms, row.rms_mean, *peaks, row.speed_mean, *counts])
    return text.getvalue()
