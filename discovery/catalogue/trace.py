"""What became of every hypothesis: while what was looked for, at which step, and why it left the search (trace.json).

A search notes it with `left` where it happens, with `looking` what it looks for; outside of `traced` nothing is kept.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
import json
from pathlib import Path
from typing import Any

from lacuna.written import write_whole


@dataclass(frozen=True)
class Left:
    """A hypothesis that left. `step`: model (there is none, or it does not run), screen (by its promise, to first
    order), race (while it was fitted), comparison (with what was fitted, too), unseen (by recordings left out) or
    needless (others do without it). `promise` is the share of the misfit that it could explain; `cost` its deviance and
    prices over those of no hypothesis, below zero where it pays."""

    looking: str
    hypothesis: str
    step: str
    why: str
    promise: float | None = None
    cost: float | None = None


class Trace:
    """All that left a search, in its order."""

    def __init__(self) -> None:
        self.entries: list[Left] = []
        self.looking = ""

    def write(self, folder: Path) -> Path:
        path = folder / "trace.json"
        told = {"left": [_plain(entry) for entry in self.entries]}
        write_whole(path, json.dumps(told, indent=1, ensure_ascii=False) + "\n")
        return path


def _plain(entry: Left) -> dict[str, Any]:
    return {n: float(f"{v:.4g}") if isinstance(v, float) else v for n, v in asdict(entry).items() if v is not None}


_trace: Trace | None = None


@contextmanager
def traced() -> Iterator[Trace]:
    """Keep what is noted inside."""
    global _trace
    before, _trace = _trace, Trace()
    try:
        yield _trace
    finally:
        _trace = before


def looking(text: str) -> None:
    """What leaves from here on leaves while this is looked for."""
    if _trace is not None:
        _trace.looking = text


def left(hypothesis: str, step: str, why: str, promise: float | None = None, cost: float | None = None) -> None:
    if _trace is not None:
        _trace.entries.append(Left(_trace.looking, hypothesis, step, why, promise, cost))


def note_screened(promises: list[tuple[str, float]], tried: Collection[str]) -> None:
    """Those that were not `tried`; hypotheses with their promises, the most promising first."""
    for label, promise in promises:
        if label not in tried:
            left(label, "screen", f"{promises[0][0]} promises {promises[0][1]:.1%}", promise)
