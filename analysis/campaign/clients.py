"""Who computes the tasks: workers of this machine, started for it, or those of a Dask scheduler elsewhere."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import logging
from typing import Any

from distributed import Client, LocalCluster

from lacuna.analysis.errors import AnalysisError

_PAGES = "127.0.0.1:0"  # which Dask serves in any case: at a free port, and to this machine alone


@contextmanager
def client_of(scheduler: str | None, **local: Any) -> Iterator[Client]:
    """A client of `scheduler`, or of a cluster of one's own, which takes `local`. Raises AnalysisError where the
    scheduler does not answer, OSError where workers find no place on the disk."""
    if not scheduler:
        with _cluster(**local) as cluster, Client(cluster) as client:
            yield client
        return
    try:
        client = Client(scheduler, timeout=10)
    except (OSError, ValueError) as error:
        raise AnalysisError(f"no Dask scheduler answers at {scheduler}: {error}") from None
    with client:
        yield client


def _cluster(**local: Any) -> LocalCluster:
    """Its log is silent: what goes wrong is raised."""
    try:
        return LocalCluster(
            dashboard_address=_PAGES, worker_dashboard_address=_PAGES, silence_logs=logging.CRITICAL, **local
        )
    except RuntimeError as error:
        raise error.__cause__ if isinstance(error.__cause__, OSError) else error from None
