"""Plain figures: signals against time, features over a fault, the tests of a sweep. They belong to no display."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
import io
from pathlib import Path

from matplotlib.figure import Figure
import numpy as np

from lacuna.drawn import save
from lacuna.written import whole_file

MOST_SIGNALS = 8  # more lines than this in one panel tell a reader nothing
MOST_PANELS = 6


class Drawing(Figure):
    """A figure that shows itself in a notebook, whatever displays are set up there."""

    def _repr_svg_(self) -> str:
        buffer = io.StringIO()
        save(self, buffer, "svg")
        return buffer.getvalue()


def over_axis(axis: np.ndarray, label: str, columns: Mapping[str, np.ndarray], unit: str) -> Drawing:
    """`columns` [points] over `axis` [points], marked at each point."""
    figure = Drawing(figsize=(8, 3.2), layout="tight")
    panel = figure.subplots()
    for name, values in columns.items():
        panel.plot(axis, values, label=name, linewidth=1, marker=".", markersize=3)
    panel.set_xlabel(label)
    panel.set_ylabel(unit)
    panel.legend(fontsize="small")
    panel.grid(alpha=0.3)
    return figure


def cloud(x: tuple[str, np.ndarray], y: tuple[str, np.ndarray], colour: tuple[str, np.ndarray] | None) -> Drawing:
    """Points of named columns [tests], coloured by a third one."""
    figure = Drawing(figsize=(8, 3.6), layout="tight")
    panel = figure.subplots()
    drawn = panel.scatter(x[1], y[1], s=9, c=None if colour is None else colour[1], cmap="viridis")
    panel.set_xlabel(x[0])
    panel.set_ylabel(y[0])
    panel.grid(alpha=0.3)
    if colour is not None:
        figure.colorbar(drawn, ax=panel, label=colour[0])
    return figure


def trajectories(time: np.ndarray, columns: Mapping[str, np.ndarray], units: Mapping[str, str]) -> Drawing:
    """Of at most eight of `columns` a unit, at most six units; all [rows], `time` in s."""
    panels: dict[str, list[str]] = defaultdict(list)
    for name in columns:
        if len(panels[units.get(name, "")]) < MOST_SIGNALS:
            panels[units.get(name, "")].append(name)
    shown = list(panels.items())[:MOST_PANELS]
    figure = Drawing(figsize=(8, 1.0 + 2.2 * len(shown)), layout="tight")
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
    with whole_file(path) as partial:
        save(figure, partial, "svg")
    return path
