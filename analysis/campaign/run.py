"""Run a campaign on Dask: embedded workers by default, or those of a scheduler elsewhere; the same tasks unchanged."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
import os
from pathlib import Path

from distributed import Client, Future, LocalCluster

from lacuna.analysis.campaign.parts import Parts
from lacuna.analysis.campaign.points import Points, chunks
from lacuna.analysis.campaign.tasks import finished
from lacuna.analysis.campaign.work import Work, run_chunk
from lacuna.analysis.errors import AnalysisError
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
        with _client(scheduler) as client:
            submit = partial(_submitted, client, work, pieces)
            for k, table in finished(client, submit, todo):
                parts.write(k, table)
                done += 1
                if progress:
                    progress(done, len(pieces))
    results = folder / "results.parquet"
    parts.combine(results)
    return results


@contextmanager
def _client(scheduler: str | None) -> Iterator[Client]:
    if scheduler is None:
        cluster = LocalCluster(
            n_workers=1, threads_per_worker=os.cpu_count(), processes=False, dashboard_address=None, silence_logs=40
        )
        with cluster, Client(cluster) as client:
            yield client
        return
    try:
        client = Client(scheduler, timeout=10)
    except (OSError, ValueError) as error:
        raise AnalysisError(f"no Dask scheduler answers at {scheduler}: {error}") from None
    with client:
        yield client


def _submitted(client: Client, work: Work, pieces: list[Points], k: int) -> Future:
    return client.submit(run_chunk, work, pieces[k], pure=False, retries=3)
