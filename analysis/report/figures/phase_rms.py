"""Figure 4 of the paper: RMS of each filtered phase current over severity."""

from __future__ import annotations

from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.map.rows import Row
from lacuna.analysis.report.figures.style import (
    PHASE_STYLES,
    PHASES,
    label_line_end,
    new_figure,
    phase_name,
    severity_axis,
    shade_bands,
    spread,
)
from lacuna.analysis.settings import Settings

TITLE = "RMS of the filtered phase currents"
CAPTION = (
    "As figure 4 of the paper. The currents grow with the fault and drift apart. They differ slightly without a fault "
    "already, because the start-up belongs to the record."
)


def draw(settings: Settings, rows: list[Row]) -> Figure:
    figure = new_figure()
    axes = figure.subplots()
    severity = settings.fault.shown(np.array([row.severity for row in rows]))
    rms = 1e3 * np.array([row.rms for row in rows])
    shade_bands(axes, settings)
    ends = spread(rms[-1].tolist(), 0.06 * (rms.max() - rms.min()))
    for channel, end in enumerate(ends):
        colour = PHASES[channel]
        axes.plot(severity, rms[:, channel], PHASE_STYLES[channel], color=colour)
        axes.plot(severity[::10], rms[::10, channel], "o", color=colour, markersize=4)
        label_line_end(axes, severity[-1], end, f"phase {phase_name(channel)}, {rms[-1, channel]:.0f} mA", colour)
    severity_axis(axes, settings)
    axes.set_ylabel("RMS of the filtered phase current  (mA)")
    axes.set_ylim(bottom=0.9 * rms.min())
    axes.set_title(TITLE, pad=20)
    return figure
