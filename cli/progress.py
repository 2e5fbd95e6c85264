"""How far long work is: a bar for people, lines of JSON for programs, on standard error."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
import json
import time

import typer

import lacuna

INTERVAL = 0.5  # s, between lines that say the same in other numbers
shown: ContextVar[str] = ContextVar("shown", default="bar")  # bar | lines | nothing


class Pace:
    """How long work goes on, if it goes on as it did since its share was last set back."""

    def __init__(self, clock: Callable[[], float] = time.monotonic):
        self._clock, self._since, self._begin = clock, clock(), 0.0
        self._share: float | None = None

    def left(self, share: float | None) -> float | None:
        """s, None where that is not known."""
        now, before = self._clock(), self._share
        self._share = share
        if share is None or before is None or share < before:
            self._since, self._begin = now, share or 0.0
            return None
        done = share - self._begin
        return (now - self._since) * (1 - share) / done if done > 0 else None


@contextmanager
def progress(limit: float | None = None) -> Iterator[lacuna.Progress]:
    """A callback for what is being done: with --json lines; else a bar with the time left, where standard error is a
    terminal. Of a search nobody knows the time left: its `limit` (s) is shown."""
    if shown.get() == "lines":
        yield _lines()
        return
    with _bar("" if limit is None else f"limit {_span(limit)}") as tell:
        yield tell


def _lines() -> lacuna.Progress:
    """`progress` (text), `share` (0 to 1 or null), `elapsed` and `left` (s or null): one object a line."""
    begin, pace = time.monotonic(), Pace()
    last = ("", -INTERVAL)

    def tell(text: str, share: float | None) -> None:
        nonlocal last
        elapsed, left = time.monotonic() - begin, pace.left(share)
        if text == last[0] and elapsed - last[1] < INTERVAL and share != 1:
            return
        last = (text, elapsed)
        said = {"progress": text, "share": share, "elapsed": round(elapsed, 3), "left": left and round(left, 3)}
        typer.echo(json.dumps(said, ensure_ascii=False), err=True)

    return tell


@contextmanager
def _bar(otherwise: str) -> Iterator[lacuna.Progress]:
    """`otherwise`: what is said in place of the time left where that is not known."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    console, pace = Console(stderr=True), Pace()
    columns = (
        SpinnerColumn(), TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[rest]}"),
        TimeElapsedColumn(),
    )  # fmt: skip
    hidden = shown.get() == "nothing" or not console.is_terminal
    with Progress(*columns, console=console, transient=True, disable=hidden) as bar:
        task = bar.add_task("", total=None, rest="")

        def tell(text: str, share: float | None) -> None:
            left = pace.left(share)
            rest = otherwise if share is None else f"{share:.0%}" + ("" if left is None else f", {_span(left)} left")
            bar.update(task, description=text, total=None if share is None else 1.0, completed=share or 0.0, rest=rest)

        yield tell


def _span(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"
