"""Readings against the truth for both methods, and their receiver operating characteristics."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.report.figures.style import INK, MUTED, PHASES, new_figure
from lacuna.analysis.settings import Settings
from lacuna.analysis.severity.robustness import Results, roc

METHODS = (("mean RMS (paper)", "paper", PHASES[1]), ("signature", "estimate", PHASES[0]))


def draw(settings: Settings, results: Results) -> Figure:
    figure = new_figure(12.0, 4.4)
    first, second, third = figure.subplots(1, 3)
    for axes, method in zip((first, second), METHODS, strict=True):
        _draw_readings(axes, settings, results, *method)
    _draw_roc(third, settings, results)
    return figure


def _draw_readings(axes: Axes, settings: Settings, results: Results, name: str, field: str, colour: str) -> None:
    fault = settings.fault
    truth, reading = fault.shown(results.severity), fault.shown(getattr(results, field))
    axes.plot(truth, reading, ".", color=colour, markersize=2.5, alpha=0.4, rasterized=True)
    ends = [fault.shown(fault.first), fault.shown(fault.last)]
    axes.plot(ends, ends, color=INK, linewidth=1)
    unit = "points" if fault.unit == "%" else fault.unit
    error = np.sqrt(np.nanmean((reading - truth) ** 2))
    axes.set_title(f"{name}: {error:.2f} {unit} off", color=colour)
    axes.set_xlabel(f"true severity  ({fault.unit})")
    axes.set_ylabel(f"severity as read  ({fault.unit})")
    axes.set_aspect("equal")


def _draw_roc(axes: Axes, settings: Settings, results: Results) -> None:
    threshold = settings.table("assessment")["maintenance"]
    sick = results.severity >= threshold
    for name, field, colour in METHODS:
        alarms, hits, area = roc(sick, getattr(results, field))
        axes.plot(100 * alarms, 100 * hits, color=colour, label=f"{name}: area {area:.4f}")
    axes.plot([0, 100], [0, 100], ":", color=MUTED)
    axes.set_xlabel("false alarms  (% of rotors that need none)")
    axes.set_ylabel("found  (% of rotors that need maintenance)")
    axes.set_title(f"Needs maintenance: {settings.fault.text(threshold)} and above")
    axes.legend(frameon=False, loc="lower right")
    axes.set_aspect("equal")
