"""Rows at many severities, in parallel over the cores: simulation and analysis both release the GIL."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
import os

from lacuna.analysis.map.plant import Plant
from lacuna.analysis.map.rows import Row, RowStore, compute_row
from lacuna.analysis.settings import Settings
from lacuna.analysis.spectra.chain import Chain

Progress = Callable[[int, int], None]  # rows done, rows in all


def sweep(
    plant: Plant,
    settings: Settings,
    severities: Sequence[float],
    store: RowStore,
    *,
    jobs: int | None = None,
    progress: Progress | None = None,
    resume: bool = True,
) -> list[Row]:
    """One row for each severity, in their order; rows already in `store` are taken from there if `resume`.

    An exception in one row, or Ctrl-C, stops the sweep; rows finished until then stay in the store.
    """
    rows = {severity: row for severity in severities if resume and (row := store.load(severity)) is not None}
    todo = [severity for severity in severities if severity not in rows]
    if progress:
        progress(len(rows), len(severities))
    if todo:
        chain = Chain(settings)

        def work(severity: float) -> Row:
            row = compute_row(plant, chain, settings, severity)
            store.save(row)
            return row

        pool = ThreadPoolExecutor(max_workers=jobs or os.cpu_count())
        try:
            pending = {pool.submit(work, severity) for severity in todo}
            while pending:
                done, pending = wait(pending, return_when=FIRST_COMPLETED)
                rows.update((row.severity, row) for row in (future.result() for future in done))
                if progress:
                    progress(len(rows), len(severities))
        finally:
            pool.shutdown(cancel_futures=True)
    return [rows[severity] for severity in severities]
