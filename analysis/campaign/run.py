"""Run a campaign on Dask: embedded workers by default, or those of a scheduler elsewhere; the same tasks unchanged."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import os
from pathlib import Path

from distributed import Client, LocalCluster, as_completed

from lacuna.analysis.campaign.parts import Parts
from lacuna.analysis.campaign.points import Points, chunks
from lacuna.analysis.campaign.work import Work, run_chunk
from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.map.sweep import Progress

IN_FLIGHT = 4  # chunks a worker thread: enough to keep it busy, few enough to bound the scheduler's memory


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
    does not answer.
    """
    pieces = chunks(points, chunk)
    parts = Parts(folder, work, pieces)
    todo = parts.missing()
    done = len(pieces) - len(todo)
    if progress:
        progress(done, len(pieces))
    if todo:
        with _client(scheduler) as client:
            for k, table in _results(client, work, pieces, todo):
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


def _results(client: Client, work: Work, pieces: list[Points], todo: list[int]) -> Iterator[tuple[int, object]]:
    """(chunk, table) as they are finished; never more than IN_FLIGHT chunks a thread are with the scheduler."""
    threads = sum(client.nthreads().values()) or 1
    waiting = iter(todo)
    number = {}

    def submit():
        k = next(waiting, None)
        if k is None:
            return None
        future = client.submit(run_chunk, work, pieces[k], pure=False, retries=3)
        number[future.key] = k
        return future

    first = [future for _ in range(IN_FLIGHT * threads) if (future := submit()) is not None]
    pending = as_completed(first, with_results=True)
    for future, table in pending:
        yield number.pop(future.key), table
        following = submit()
        if following is not None:
            pending.add(following)
