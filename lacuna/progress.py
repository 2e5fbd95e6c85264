"""How long work tells what it is doing: one kind of callback everywhere."""

from __future__ import annotations

from collections.abc import Callable

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


def spoken(progress: Progress | None) -> Callable[[str], None]:
    """For stages that say what they do: nobody knows which share of it is done."""
    tell = progress or silent
    return lambda text: tell(text, None)
