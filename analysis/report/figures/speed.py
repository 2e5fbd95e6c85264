"""Figure 6 of the paper: the speed, zoomed, and its mean over severity."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.map.rows import Row
from lacuna.analysis.report.figures.style import (
    INK,
    MUTED,
    label_line_end,
    landmarks,
    new_figure,
    severity_axis,
    shade_bands,
    spread,
)
from lacuna.analysis.settings import Settings

TITLE = "Rotor speed"
CAPTION = (
    "As figure 6 of the paper. Left: the last tenth of a second; the speed ripples more with the fault."
    " Right: mean speed over whole turns after the start-up."
)
ZOOM = 0.1  # s, end of the record


def draw(settings: Settings, rows: list[Row]) -> Figure:
    figure = new_figure(10.5, 4.6)
    over_time, over_severity = figure.subplots(1, 2, width_ratios=[1.5, 1])
    _draw_zoom(over_time, settings, rows)
    _draw_means(over_severity, settings, rows)
    return figure


def _draw_zoom(axes: Axes, settings: Settings, rows: list[Row]) -> None:
    ends, labels = [], []
    for row, colour in landmarks(settings, rows):
        time, speed = row.traces["time"], row.traces["speed"]
        shown = time >= settings.duration - ZOOM
        axes.plot(1e3 * time[shown], speed[shown], color=colour, linewidth=1.4)
        ends.append(float(speed[-1]))
        labels.append((settings.fault.text(row.severity), colour))
    low, high = axes.get_ylim()
    for y, end, (text, colour) in zip(spread(ends, 0.055 * (high - low)), ends, labels, strict=True):
        axes.annotate(
            text, (1e3 * settings.duration, end), (1e3 * settings.duration * 1.0045, y), va="center", color=colour,
            fontsize=9, fontweight="bold", annotation_clip=False,
            arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.6},
        )  # fmt: skip
    axes.set_xlim(1e3 * (settings.duration - ZOOM), 1e3 * settings.duration)
    axes.set_xlabel("time from the step command  (ms)")
    axes.set_ylabel("rotor speed  (rad/s)")
    axes.set_title(f"Last {1e3 * ZOOM:.0f} ms of the test")


def _draw_means(axes: Axes, settings: Settings, rows: list[Row]) -> None:
    found = [(settings.fault.shown(row.severity), row.speed_mean) for row in rows if row.speed_mean is not None]
    shade_bands(axes, settings, names=False)
    severity_axis(axes, settings)
    axes.set_ylabel("mean speed over whole turns  (rad/s)")
    axes.set_title("Mean speed")
    if not found:
        axes.text(0.5, 0.5, "no whole turn was completed", transform=axes.transAxes, ha="center", color=MUTED)
        return
    severity, mean = np.array(found).T
    axes.plot(severity, mean, color=INK)
    axes.plot(severity[::10], mean[::10], "o", color=INK, markersize=4)
    label_line_end(axes, severity[-1], mean[-1], f"{mean[-1]:.2f}", INK)
    axes.annotate(
        f"{mean[0]:.2f}", (severity[0], mean[0]), xytext=(6, 5), textcoords="offset points", fontweight="bold"
    )
