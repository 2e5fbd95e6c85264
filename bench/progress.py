"""A progress bar for long sweeps, on standard error."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from lacuna.analysis.map.sweep import Progress


@contextmanager
def progress_bar(description: str) -> Iterator[Progress]:
    """A function to pass as `progress`; draws a bar where standard error is a terminal, nothing elsewhere."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    console = Console(stderr=True)
    columns = [TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn()]
    with Bar(*columns, TimeRemainingColumn(), console=console, disable=not console.is_terminal) as bar:
        task = bar.add_task(description)
        yield lambda done, total: bar.update(task, completed=done, total=total)
