"""A fleet from Python: forecasts of very many histories, sorted by risk."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lacuna.degradation import degradation_laws
from lacuna.extras import names_missing_packages
from lacuna.prognosis import OPTIONS, files_of, limits_of, map_settings, own_names
from lacuna.progress import Progress, silent
from lacuna.written import write_whole

if TYPE_CHECKING:
    import pyarrow as pa

LISTED = 40  # future tests whose risk is looked at: the advised last test lies among them or is not told


@names_missing_packages
def fleet(
    histories: Path | str,
    map: Path | str | None = None,
    out: Path | str = Path("out/fleet"),
    *,
    laws: Sequence[Path | str] = (),
    risk: float = OPTIONS.risk,
    horizon: float | None = None,
    scheduler: str | None = None,
    progress: Progress | None = None,
) -> pa.Table:
    """Forecast every actuator of a Parquet or CSV table, a folder with one, or a history store; one row an actuator.

    The rows, those at greatest risk first, are also in out/fleet.parquet, and the overview for the wall in
    out/fleet.html.
    Severities must be there already (`forecast` assesses recordings). Runs on Dask: workers of this machine, or those
    of `scheduler`; what is done is kept in out/parts, and a run that was killed goes on there. Needs the extra
    `distributed`. Raises AnalysisError as `forecast` does.
    """
    from lacuna.analysis.prognosis.filter.bank import Bank
    from lacuna.analysis.prognosis.fleet import FleetWork, run_fleet
    from lacuna.analysis.prognosis.forecast import Options
    from lacuna.analysis.prognosis.pages.overview import overview
    from lacuna.analysis.prognosis.tracks import tracks

    settings = map_settings(map)
    read = tracks(_histories(histories), own_names(settings))
    limits = {fault: limits_of(settings, fault).only_last() for fault in {h.fault for h in read}}
    work = FleetWork(Bank(degradation_laws(laws)), limits, Options(risk, horizon, LISTED))
    folder, tell = Path(out), progress or silent
    table = run_fleet(
        read, work, folder, scheduler=scheduler, progress=lambda done, count: tell("forecasts", done / count)
    )
    page = overview(table, limits, f"Fleet: {Path(histories).name}", files_of(histories), risk)
    write_whole(folder / "fleet.html", page)
    return table


def _histories(source: Path | str) -> list[Any]:
    from lacuna.analysis.prognosis.fleet import histories_of
    from lacuna.analysis.prognosis.history import FILES, parquet_table, read_histories

    if "://" in str(source) or Path(source).suffix in (".db", ".sqlite"):
        from lacuna.analysis.prognosis.store import Store

        return Store(source, read=True).histories()
    path = Path(source)
    path = next((path / name for name in reversed(FILES) if (path / name).exists()), path) if path.is_dir() else path
    if path.suffix == ".parquet":
        return histories_of(parquet_table(path), str(path))
    return read_histories(path)
