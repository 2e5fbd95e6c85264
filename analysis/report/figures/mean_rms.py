"""Figure 5 of the paper: mean RMS over severity, with the operating bands."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.map.rows import Row
from lacuna.analysis.report.figures.style import (
    INK,
    band_ink,
    bands_on_map,
    label_line_end,
    new_figure,
    severity_axis,
    shade_bands,
)
from lacuna.analysis.settings import Band, Settings

TITLE = "Mean RMS and operating bands"
CAPTION = (
    "As figure 5 of the paper: the map that turns a measured mean RMS into a severity. In each band: the rise from its "
    "first to its last severity here, and as published where it was. Band edges as published leave the gaps."
)


def draw(settings: Settings, rows: list[Row]) -> Figure:
    figure = new_figure()
    axes = figure.subplots()
    severity = settings.fault.shown(np.array([row.severity for row in rows]))
    mean = 1e3 * np.array([row.rms_mean for row in rows])
    shade_bands(axes, settings)
    axes.plot(severity, mean, color=INK, linewidth=2.2)
    for band in bands_on_map(settings):
        _mark_rise(axes, band, settings.fault.shown(band.first), settings.fault.shown(band.last), severity, mean)
    label_line_end(axes, severity[-1], mean[-1], f"{mean[-1]:.0f} mA", INK)
    severity_axis(axes, settings)
    axes.set_ylabel("mean RMS of the phase currents  (mA)")
    span = mean.max() - mean.min()
    axes.set_ylim(mean.min() - 0.12 * span, mean.max() + 0.05 * span)
    axes.set_title(TITLE, pad=20)
    return figure


def _mark_rise(axes: Axes, band: Band, first: float, last: float, severity: np.ndarray, mean: np.ndarray) -> None:
    """A bar at the end of the band, from the level at its beginning to that at its end."""
    low, high = np.interp([first, last], severity, mean)
    colour = band_ink(band)
    axes.plot([first, last], [low, low], color=colour, linewidth=1, linestyle=(0, (4, 3)))
    axes.plot([last, last], [low, high], color=colour, linewidth=2.2, solid_capstyle="butt")
    axes.plot([first, last], [low, high], "o", color=colour, markersize=5)
    published = "" if band.published_rise is None else f"\n(paper {1e3 * band.published_rise:.0f})"
    axes.annotate(
        f"+{high - low:.1f} mA{published}", ((first + last) / 2, low), xytext=(0, -5), textcoords="offset points",
        ha="center", va="top", fontsize=9, color=colour, fontweight="bold",
    )  # fmt: skip
