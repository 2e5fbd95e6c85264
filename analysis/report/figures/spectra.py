"""Peak-hold spectra of the phase currents, and what makes the first peak change its line."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.map.rows import Row
from lacuna.analysis.report.figures.style import (
    INK,
    MUTED,
    PHASE_STYLES,
    PHASES,
    label_line_end,
    landmarks,
    new_figure,
    phase_name,
    severity_axis,
    shade_bands,
)
from lacuna.analysis.settings import Settings

TITLE = "Peak-hold spectra and first peak"
CAPTION = (
    "Above: peak-hold amplitude spectra, first peaks marked. Below: the line of the first peak is the spectral line "
    "nearest to the electrical frequency, which changes smoothly with the speed of the motor; a switch is where it "
    "crosses the middle between two lines, not a threshold of the machine."
)
SHOWN = 4.8  # times the frequency of the first peak: with its harmonics
FEW = 4  # switches that can be marked one by one


def draw(settings: Settings, rows: list[Row]) -> Figure:
    figure = new_figure(11.0, 7.0)
    channels = len(settings.currents)
    grid = figure.add_gridspec(2, channels, height_ratios=[1.25, 1])
    first = None
    for channel in range(channels):
        axes = figure.add_subplot(grid[0, channel], sharey=first)
        first = first or axes
        _draw_spectrum(axes, settings, rows, channel)
    first.set_ylabel("peak-hold amplitude  (mA)")
    first.set_ylim(0, 1.05e3 * max(float(row.traces["held"].max()) for row, _ in landmarks(settings, rows)))
    _draw_lines(figure.add_subplot(grid[1, :]), settings, rows)
    return figure


def _draw_spectrum(axes: Axes, settings: Settings, rows: list[Row], channel: int) -> None:
    limit = float(rows[0].traces["frequency"][-1])
    peaks = [hz for row in rows for hz in row.peak_hz if hz is not None]
    limit = min(limit, SHOWN * float(np.median(peaks))) if peaks else limit
    for row, colour in reversed(landmarks(settings, rows)):
        frequency, held = row.traces["frequency"], 1e3 * row.traces["held"][channel]
        shown = frequency <= limit
        label = settings.fault.text(row.severity)
        axes.plot(frequency[shown], held[shown], color=colour, linewidth=1.3, label=label)
        if row.peak_bin[channel] is not None and row.peak_bin[channel] < len(held):
            axes.plot(row.peak_hz[channel], held[row.peak_bin[channel]], "o", color=colour, markersize=4.5)
    axes.set_xlim(0, limit)
    axes.set_xlabel("frequency  (Hz)")
    axes.set_title(f"phase {phase_name(channel)}", color=PHASES[channel])
    if channel == 0:
        axes.legend(frameon=False, loc="upper right")


def _draw_lines(axes: Axes, settings: Settings, rows: list[Row]) -> None:
    """First-peak line of each phase, and the electrical frequency in units of lines."""
    severity = settings.fault.shown(np.array([row.severity for row in rows]))
    resolution = float(rows[0].traces["frequency"][1])
    shade_bands(axes, settings, names=False)
    for channel, (colour, style) in enumerate(zip(PHASES, PHASE_STYLES, strict=True)):
        if channel < len(settings.currents):
            lines = [np.nan if row.peak_bin[channel] is None else row.peak_bin[channel] for row in rows]
            axes.plot(severity, lines, style, color=colour, drawstyle="steps-mid", label=f"phase {phase_name(channel)}")
    if any(row.speed_mean is not None for row in rows):
        _draw_electrical_frequency(axes, settings, rows, resolution)
    axes.set_ylabel(f"spectral line  (of {resolution:.4f} Hz)")
    axes.set_title("First peak of the three phases")
    axes.legend(frameon=False, ncols=4, loc="upper right")
    severity_axis(axes, settings)


def _draw_electrical_frequency(axes: Axes, settings: Settings, rows: list[Row], resolution: float) -> None:
    pole_pairs = settings.raw["actuator"].get("pole_pairs", 1)
    severity = settings.fault.shown(np.array([row.severity for row in rows]))
    speed = np.array([np.nan if row.speed_mean is None else row.speed_mean for row in rows])
    electrical = pole_pairs * speed / (2 * np.pi) / resolution
    axes.plot(severity, electrical, color=INK, linewidth=1.2)
    label_line_end(axes, severity[-1], electrical[-1], "electrical\nfrequency", INK)
    low, high = np.nanmin(electrical), np.nanmax(electrical)
    switches = [middle for middle in np.arange(np.floor(low) + 0.5, np.ceil(high)) if low <= middle <= high]
    if len(switches) > FEW:
        return
    for middle in switches:
        axes.axhline(middle, color=MUTED, linestyle=":", linewidth=1.2)
        text = f"  middle between lines {middle - 0.5:.0f} and {middle + 0.5:.0f}"
        axes.text(settings.fault.shown(settings.fault.first), middle, text, va="bottom", fontsize=9, color=MUTED)
    axes.set_ylim(np.floor(low) + 0.4, np.ceil(high) + 0.45)
    axes.set_yticks(np.arange(np.floor(low) + 1, np.ceil(high) + 1))
