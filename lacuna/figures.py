"""Plain figures of one run: one panel a unit, signals against time. They belong to no display."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

if TYPE_CHECKING:
    from lacuna.results import Result

MOST_SIGNALS = 8  # more lines than this in one panel tell a reader nothing
MOST_PANELS = 6


def trajectories(result: Result, names: Sequence[str]) -> Figure:
    """Of at most eight of `names` a unit, at most six units."""
    panels: dict[str, list[str]] = defaultdict(list)
    for name in names:
        column = result[name]  # an unknown name is refused before anything is drawn
        if len(column) and len(panels[result.units.get(name, "")]) < MOST_SIGNALS:
            panels[result.units.get(name, "")].append(name)
    shown = list(panels.items())[:MOST_PANELS]
    figure = Figure(figsize=(8, 1.0 + 2.2 * len(shown)), layout="tight")
    axes = figure.subplots(max(len(shown), 1), sharex=True, squeeze=False)[:, 0]
    for axis, (unit, signals) in zip(axes, shown, strict=False):
        for name in signals:
            axis.plot(result.time, result[name], label=name, linewidth=1)
        axis.set_ylabel(unit or "1")
        axis.legend(loc="upper right", fontsize="small")
        axis.grid(alpha=0.3)
    axes[-1].set_xlabel("time, s")
    return figure


def write(figure: Figure, path: Path) -> Path:
    """As SVG; complete or not there."""
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(".part")
    figure.savefig(partial, format="svg")
    return partial.replace(path)
