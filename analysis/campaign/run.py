"""Run a campaign on Dask: embedded workers by default, or those of a scheduler elsewhere; the same tasks unchanged."""

from __future__ import annotations

from functools import partial
import os
from pathlib import Path

from distributed import Client, Future

from lacuna.analysis.campaign.clients import client_of
from lacuna.analysis.campaign.parts import Parts
from lacuna.analysis.campaign.points import Points, chunks
from lacuna.analysis.campaign.tasks import finished
from lacuna.analysis.campaign.work import Work, run_chunk
from lacuna.analysis.map.sweep import Progress


def run_campaign(
    work: Work,
    points: Points,
    folder: Path,
    *,
    scheduler: str | None = None,
    chunk: int = 16,
    progress: Progress | None = None,
) -> Path:
    """Simulate and analyse every point; the path of results.parquet, one row a point in their order.

    Chunks done before are taken from `folder`; a worker that is lost loses nothing, since its chunks are given to
    another; so does an interruption of this process, when it is called again. Raises AnalysisError where the scheduler
    does not answer, or is lost.
    """
    pieces = chunks(points, chunk)
    parts = Parts(folder, work, pieces)
    todo = parts.missing()
    done = len(pieces) - len(todo)
    if progress:
        progress(done, len(pieces))
    if todo:
        threads = {"n_workers": 1, "threads_per_worker": os.cpu_count(), "processes": False}
        with client_of(scheduler, **threads) as client:
            submit = partial(_submitted, client, work, pieces)
            for k, table in finished(client, submit, todo):
                parts.write(k, table)
                done += 1
                if progress:
                    progress(done, len(pieces))
    results = folder / "results.parquet"
    parts.combine(results)
    return results


def _submitted(client: Client, work: Work, pieces: list[Points], k: int) -> Future:
    return client.submit(run_chunk, work, pieces[k], pure=False, retries=3)
