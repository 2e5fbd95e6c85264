"""The best hypothesis that was fitted so far, told beside what is being done.

Every fit notes where it ends, be it of an effect, a law, or several at once; outside of `telling` nothing is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock
from typing import Any, Protocol, TypeVar

Progress = Callable[[str], None]


class Fitted(Protocol):
    """What is asked of a fit."""

    machine: Any

    @property
    def point(self) -> dict[str, float]: ...


Ended = TypeVar("Ended", bound=Fitted | None)


class SoFar:
    """Says each text with the best hypothesis behind it, and the last text again where a better one was fitted.

    Fits to other recordings, and those whose shafts are held, are not comparable: each such kind has a best one of its
    own, and that of the kind that was fitted last is told.
    """

    def __init__(self, progress: Progress, is_better: Callable[[Any, Any], bool]) -> None:
        self._progress, self._is_better, self._lock = progress, is_better, Lock()
        self._text, self._best = "", ""
        self._kept: dict[tuple[int, int], tuple[Fitted, str]] = {}  # by kind; a fit keeps the case, which that names

    def __call__(self, text: str) -> None:
        with self._lock:
            self._text = text
            self._tell()

    def note(self, found: Fitted) -> None:
        amendment = found.machine.amendment
        if not amendment.attachments:
            return
        kind = id(found.machine.case), len(amendment.trackers)
        with self._lock:
            if kind not in self._kept or self._is_better(found, self._kept[kind][0]):
                self._kept[kind] = found, " and ".join(a.said(found.point) for a in amendment.attachments)
            if self._kept[kind][1] != self._best:
                self._best = self._kept[kind][1]
                self._tell()

    def _tell(self) -> None:
        self._progress(self._text + (f"; best so far {self._best}" if self._best else ""))


_so_far: SoFar | None = None


@contextmanager
def telling(progress: Progress, is_better: Callable[[Any, Any], bool]) -> Iterator[SoFar]:
    """`progress` told of the best hypothesis, too, among what is fitted inside; `is_better` compares two fits."""
    global _so_far
    before, _so_far = _so_far, SoFar(progress, is_better)
    try:
        yield _so_far
    finally:
        _so_far = before


def noted(found: Ended) -> Ended:
    """The fit itself."""
    if _so_far is not None and found is not None:
        _so_far.note(found)
    return found
