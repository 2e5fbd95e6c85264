"""A recording on its map: estimated severity with its interval, each phase's RMS, and the paper's reading beside it."""

from __future__ import annotations

from pathlib import Path
from string import ascii_lowercase

from matplotlib.figure import Figure

from lacuna.analysis.recording.text import read_text
from lacuna.analysis.report.figures.style import (
    INK,
    MUTED,
    PHASE_STYLES,
    PHASES,
    READABLE,
    band_ink,
    label_line_end,
    new_figure,
    phase_name,
    severity_axis,
    shade_bands,
)
from lacuna.analysis.settings import Settings
from lacuna.analysis.severity.severity_table import Estimate
from lacuna.analysis.spectra.chain import Features

CAPTION = (
    "Curves: the map. Dots: the measured RMS of each phase, at the severity that they show together: the black line, "
    "with its 95 % interval in grey."
)


def draw(settings: Settings, map_csv: Path, features: Features, estimate: Estimate) -> Figure:
    figure = new_figure()
    axes = figure.subplots()
    table = read_text(map_csv)
    rows = dict(zip(table.header, table.values, strict=True))
    severity = settings.fault.shown(rows[settings.fault.symbol])
    found = settings.fault.shown(estimate.severity)
    low, high = settings.fault.shown(estimate.low), settings.fault.shown(estimate.high)
    shade_bands(axes, settings)
    axes.axvspan(low, high, color=INK, alpha=0.18, linewidth=0)
    axes.axvline(found, color=INK, linewidth=1.5)
    for channel, measured in enumerate(1e3 * features.rms):
        curve = 1e3 * rows[f"rms_{ascii_lowercase[channel]}"]
        colour = PHASES[channel]
        axes.plot(severity, curve, PHASE_STYLES[channel], color=colour, linewidth=1.3)
        axes.plot(found, measured, "o", color=colour, markersize=8, markeredgecolor="white", clip_on=False)
        label_line_end(axes, severity[-1], curve[-1], f"phase {phase_name(channel)}", colour)
    axes.plot(severity, 1e3 * rows["rms_mean"], color=MUTED, linewidth=1.3)
    label_line_end(axes, severity[-1], 1e3 * rows["rms_mean"][-1], "mean", MUTED)
    axes.plot(
        settings.fault.shown(estimate.paper), 1e3 * features.rms_mean, "D", color=MUTED, markersize=7, clip_on=False,
        label="mean RMS read back alone, as in the paper",
    )  # fmt: skip
    axes.plot([], [], "o", color=INK, label="measured phase RMS, at the estimated severity")
    severity_axis(axes, settings)
    axes.set_ylabel("RMS of the phase currents  (mA)")
    axes.legend(loc="upper left", **READABLE)
    band = settings.bands[estimate.band]
    axes.set_title(
        f"{found:.1f} {settings.fault.unit}  ({low:.1f} to {high:.1f})  {band.name}", color=band_ink(band), pad=20
    )
    return figure
