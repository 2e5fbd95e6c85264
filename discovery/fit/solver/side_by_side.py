"""Work on several things at once, in threads: simulations, filters and passes over long arrays let others run."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
import os
from typing import TypeVar

WORKERS = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
_pool = ThreadPoolExecutor(max_workers=WORKERS)

Task = TypeVar("Task")
Result = TypeVar("Result")


def side_by_side(function: Callable[[Task], Result], tasks: Iterable[Task]) -> list[Result]:
    """What a function gives for each task, in their order. No task may itself call this: all threads might wait."""
    return list(_pool.map(function, tasks))


def in_threads(function: Callable[[Task], Result], tasks: Iterable[Task]) -> list[Result]:
    """The same in threads of its own, for tasks that are made of others: whole fits, models to be compiled."""
    with ThreadPoolExecutor(WORKERS) as pool:
        return list(pool.map(function, tasks))
