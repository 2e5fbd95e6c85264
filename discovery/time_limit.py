"""A limit on the time that a search may take: what it has found until then stands."""

from __future__ import annotations

from collections.abc import Callable
import time

Progress = Callable[[str], None]


class TimeUp(Exception):
    """A search has taken as long as it may; the message says how long that is."""


def limited(progress: Progress, seconds: float | None) -> Progress:
    """Progress that ends what reports to it: a call later than `seconds` from now raises TimeUp."""
    if seconds is None:
        return progress
    end = time.monotonic() + seconds

    def report(text: str) -> None:
        if time.monotonic() > end:
            raise TimeUp(f"the search was stopped after {seconds:.0f} s, before it was done")
        progress(text)

    return report
