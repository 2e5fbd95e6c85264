"""Plain figures of one run: one panel a unit, signals against time. They belong to no display."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure
import numpy as np

MOST_SIGNALS = 8  # more lines than this in one panel tell a reader nothing
MOST_PANELS = 6


def trajectories(time: np.ndarray, columns: Mapping[str, np.ndarray], units: Mapping[str, str]) -> Figure:
    """Of at most eight of `columns` a unit, at most six units; all [rows], `time` in s."""
    panels: dict[str, list[str]] = defaultdict(list)
    for name in columns:
        if len(panels[units.get(name, "")]) < MOST_SIGNALS:
            panels[units.get(name, "")].append(name)
    shown = list(panels.items())[:MOST_PANELS]
    figure = Figure(figsize=(8, 1.0 + 2.2 * len(shown)), layout="tight")
    axes = figure.subplots(max(len(shown), 1), sharex=True, squeeze=False)[:, 0]
    for axis, (unit, signals) in zip(axes, shown, strict=False):
        for name in signals:
            axis.plot(time, columns[name], label=name, linewidth=1)
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
