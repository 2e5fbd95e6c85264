"""Where tables are printed."""

from __future__ import annotations

from rich.console import Console

WIDTH = 110  # columns, where the terminal has fewer or there is none: broken words help nobody


def console() -> Console:
    return Console(width=max(Console().width, WIDTH))
