"""Chunks of work with a Dask scheduler, as they are finished; what is lost with it is said in a sentence."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
import sys
from typing import TYPE_CHECKING

from lacuna.analysis.errors import AnalysisError

if TYPE_CHECKING:
    from distributed import Client, Future
    import pyarrow as pa

IN_FLIGHT = 4  # chunks a worker thread: enough to keep it busy, few enough to bound the scheduler's memory


@contextmanager
def callers_script_left_out() -> Iterator[None]:
    """Processes that are started meanwhile do not run the caller's script again.

    A spawned process imports the main module, by its `__spec__` or `__file__`, so that what is defined there can be
    unpickled: a script without `if __name__ == "__main__"` would start workers in every worker. Ours need this package
    alone.
    """
    main = sys.modules["__main__"]
    kept = {name: getattr(main, name) for name in ("__spec__", "__file__") if hasattr(main, name)}
    try:
        main.__spec__ = None
        main.__dict__.pop("__file__", None)
        yield
    finally:
        main.__dict__.update(kept)


def finished(client: Client, submit: Callable[[int], Future], todo: Iterable[int]) -> Iterator[tuple[int, pa.Table]]:
    """(chunk, its rows); never more than IN_FLIGHT chunks a thread are with the scheduler. `submit` hands one over.

    Raises AnalysisError where the scheduler is lost, or a chunk was lost with one worker after another.
    """
    from distributed import KilledWorker

    try:
        yield from _as_finished(client, submit, iter(todo))
    except (CancelledError, KilledWorker, OSError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise AnalysisError(
            f"the Dask scheduler or its workers were lost ({reason}); what was finished is kept: give the command again"
        ) from None


def _as_finished(
    client: Client, submit: Callable[[int], Future], waiting: Iterator[int]
) -> Iterator[tuple[int, pa.Table]]:
    from distributed import as_completed

    number: dict[str, int] = {}

    def following() -> list[Future]:
        k = next(waiting, None)
        if k is None:
            return []
        future = submit(k)
        number[future.key] = k
        return [future]

    threads = sum(client.nthreads().values()) or 1
    pending = as_completed([f for _ in range(IN_FLIGHT * threads) for f in following()], with_results=True)
    for future, rows in pending:
        if isinstance(rows, BaseException):  # of a future that was cancelled, since its scheduler is gone
            raise rows
        yield number.pop(future.key), rows
        pending.update(following())
