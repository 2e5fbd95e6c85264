"""A limit on the time that a search may take: what it has found until then stands.

Long work calls `check` between its simulations; past the end of the limit that raises TimeUp.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import math
import time

_seconds, _end = math.inf, math.inf


class TimeUp(Exception):
    """A search has taken as long as it may; the message says how long that is."""


@contextmanager
def within(seconds: float | None, begun: float | None = None) -> Iterator[None]:
    """Limit what is done inside to so many seconds from now, or from when it was `begun` (s of `time.monotonic`); None
    sets no limit."""
    global _seconds, _end
    if seconds is not None:
        _seconds, _end = seconds, (time.monotonic() if begun is None else begun) + seconds
    try:
        yield
    finally:
        _seconds, _end = math.inf, math.inf


def check() -> None:
    """Raise TimeUp where the limit has been passed."""
    if time.monotonic() > _end:
        raise TimeUp(f"the search was stopped after {_seconds:.0f} s, before it was done")
