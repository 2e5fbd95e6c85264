"""The history store from Python: assessments are remembered, and forecast and fleet read them."""

from __future__ import annotations

from collections.abc import Sequence
import hashlib
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lacuna.analysis.errors import AnalysisError
from lacuna.extras import names_missing_packages
from lacuna.progress import Progress, counted, spoken

if TYPE_CHECKING:
    from lacuna.analysis.prognosis.store import Entry

TWO_SIDED_95 = 1.959964


@names_missing_packages
def remember(
    recording: str | Path,
    map: str | Path,
    store: str | Path,
    *,
    actuator: str,
    cycles: float | None = None,
    hours: float | None = None,
    replaced: bool = False,
    columns: Sequence[str] | None = None,
    unfiltered: bool = False,
    progress: Progress | None = None,
) -> int:
    """Assess a recording by the map in folder `map` and append what it shows to the history store; how many rows are
    new.

    `store` is a file (SQLite) or any URL of SQLAlchemy. A recording that the same map has read before is not stored
    again; a newer map's reading is, beside the older one. `replaced`: the part is new since the test before. Raises
    AnalysisError where the recording is refused or the store cannot be used. Needs the extras `maps` and `history`.
    """
    from lacuna.analysis.prognosis.store import Entry, Store, file_hash

    path = Path(recording).resolve()
    spoken(progress)(f"assessing {path.name}")
    readings, covariance, features = _readings(path, Path(map), columns, unfiltered)
    entries = [
        Entry(
            actuator=actuator, severity=severity, low=low, high=high, fault=fault, cycles=cycles, hours=hours,
            event="replaced" if replaced else "", recording=file_hash(path), path=str(path), map=map_hash(Path(map)),
            version=version("lacuna"), covariance=covariance, features=features,
        )
        for fault, severity, low, high in readings
    ]  # fmt: skip
    return Store(store).append(entries)


@names_missing_packages
def refresh(
    store: str | Path,
    map: str | Path,
    *,
    columns: Sequence[str] | None = None,
    unfiltered: bool = False,
    progress: Progress | None = None,
) -> int:
    """Read again, by the map in folder `map`, what another map has read and whose file is still there; rows that are
    new.

    What this map refuses keeps its reading: an AnalysisError names it, after all the others have been read.
    """
    from lacuna.analysis.prognosis.store import opened

    again = {entry.recording: entry for entry in opened(store).outdated(map_hash(Path(map)))}
    new, refused = 0, []
    count = counted("assessing again", progress)
    for number, entry in enumerate(again.values()):
        count(number, len(again))
        try:
            new += _again(entry, map, store, columns, unfiltered)
        except AnalysisError as refusal:
            refused.append(f"{entry.path}: {refusal}")
    if refused:
        kept = f"{len(refused)} of {len(again)} recordings keep their older reading"
        raise AnalysisError(f"{kept}: {'; '.join(refused)}")
    return new


def _again(entry: Entry, map: str | Path, store: str | Path, columns: Sequence[str] | None, unfiltered: bool) -> int:
    return remember(
        entry.path, map, store, actuator=entry.actuator, cycles=entry.cycles, hours=entry.hours,
        replaced=entry.event == "replaced", columns=columns, unfiltered=unfiltered,
    )  # fmt: skip


@names_missing_packages
def export_history(store: str | Path, path: str | Path) -> None:
    """Write the store as a history.csv or .parquet, which `forecast` reads. Needs the extra `history`."""
    from lacuna.analysis.prognosis.store import opened

    opened(store).export(Path(path))


def map_hash(folder: Path) -> str:
    """Of the files that decide an estimate: the severity table, or the map over two faults."""
    from lacuna.analysis.severity.combined.grid import GRID_FILE
    from lacuna.analysis.severity.preparation import TABLE_FILE

    digest = hashlib.sha256()
    for name in (GRID_FILE, TABLE_FILE):
        if (folder / name).exists():
            digest.update(name.encode() + (folder / name).read_bytes())
    return digest.hexdigest()


def _readings(
    path: Path, folder: Path, columns: Sequence[str] | None, unfiltered: bool
) -> tuple[list[tuple[str, float, float, float]], Any, Any]:
    """([(fault, severity, low, high)], covariance of the severities, features)."""
    from lacuna.analysis.severity.assessment import assess
    from lacuna.analysis.severity.combined.assessment import assess_both
    from lacuna.analysis.severity.combined.grid import GRID_FILE, load_grid

    if (folder / GRID_FILE).exists():
        both = assess_both(path, folder, columns=columns, unfiltered=unfiltered)
        found: list[tuple[str, Any]] = [
            ("", both.estimate.first),
            (load_grid(folder).other.symbol, both.estimate.second),
        ]
        features: Any = both.features
    else:
        one = assess(path, folder, columns=columns, unfiltered=unfiltered)
        found, features = [("", one.estimate)], one.features
    deviations = [(e.high - e.low) / 2 / TWO_SIDED_95 for _, e in found]
    correlation = both.estimate.correlation if len(found) == 2 else 0.0
    covariance = [
        [a * b * (1.0 if i == k else correlation) for k, b in enumerate(deviations)] for i, a in enumerate(deviations)
    ]
    return [(fault, e.severity, e.low, e.high) for fault, e in found], covariance, features
