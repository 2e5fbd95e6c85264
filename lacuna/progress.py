"""How long work tells what it is doing: one kind of callback everywhere."""

from __future__ import annotations

from collections.abc import Callable
import time

Progress = Callable[[str, float | None], None]
"""Called with what is being done, and which share of it is done (0 to 1; None where that is not known)."""


def silent(text: str, share: float | None) -> None:
    """Tells nobody."""


def counted(text: str, progress: Progress | None) -> Callable[[int, int], None]:
    """For stages that count: a function of (done, of how many)."""
    tell = progress or silent
    return lambda done, total: tell(text, done / total if total else None)


def watching(text: str, start: float, stop: float, progress: Progress | None) -> Callable[[float], None] | None:
    """For runs: a function of the time (s) that is reached. None where nobody wants to know."""
    return None if progress is None else lambda time: progress(text, (time - start) / (stop - start))


def spoken(progress: Progress | None, limit: float = 0.0) -> Callable[[str], None]:
    """For stages that say what they do. The share is that of `limit` (s), after which they end at the latest."""
    tell, begin = progress or silent, time.monotonic()
    return lambda text: tell(text, min((time.monotonic() - begin) / limit, 1.0) if limit > 0 else None)
