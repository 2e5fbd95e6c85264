"""One look for all figures: colours that colour-blind readers can tell apart, units, labels at the lines."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from string import ascii_uppercase

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.map.rows import Row
from lacuna.analysis.settings import Band, Settings

# Okabe and Ito's palette, for phases a, b, c.
PHASES = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00"]
PHASE_STYLES = ["-", "--", "-.", ":", "-", "--"]
READABLE = {"framealpha": 0.85, "edgecolor": "none", "facecolor": "white"}  # a legend over curves and bands
INK, MUTED, GRID = "#222222", "#666666", "#dddddd"

# The paper's names. Fill behind curves, and a darker shade of it for text and markers.
BAND_FILL = {"green": "#d5ecd4", "orange": "#fde3c0", "red": "#f8cfca", "violet": "#e2d5ef"}
BAND_INK = {"green": "#236823", "orange": "#964a00", "red": "#b3261e", "violet": "#6a3d9a"}

_STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 10,
    "axes.titlesize": 11,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelcolor": INK,
    "axes.edgecolor": MUTED,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.7,
    "xtick.color": INK,
    "ytick.color": INK,
    "text.color": INK,
    "lines.linewidth": 1.8,
    "figure.dpi": 100,
    "savefig.dpi": 160,
    "svg.hashsalt": "lacuna",  # equal input gives equal bytes
}


@contextmanager
def in_style() -> Iterator[None]:
    with rc_context(_STYLE):
        yield


def new_figure(width: float = 8.6, height: float = 4.8) -> Figure:
    """Inches; the layout keeps labels inside."""
    return Figure(figsize=(width, height), layout="constrained")


def phase_name(channel: int) -> str:
    return ascii_uppercase[channel]


def band_fill(band: Band) -> str:
    return BAND_FILL.get(band.name, "#eeeeee")


def band_ink(band: Band) -> str:
    return BAND_INK.get(band.name, MUTED)


def bands_on_map(settings: Settings) -> list[Band]:
    """Those that the map's severities reach."""
    return [band for band in settings.bands if band.first <= settings.fault.last and band.last >= settings.fault.first]


def landmarks(settings: Settings, rows: list[Row]) -> list[tuple[Row, str]]:
    """The first row in ink, and the last row of each band in the band's colour: what figures show of a map."""
    severity = np.array([row.severity for row in rows])
    ends = [(int(np.abs(severity - band.last).argmin()), band_ink(band)) for band in bands_on_map(settings)]
    return [(rows[0], INK)] + [(rows[k], colour) for k, colour in ends if k > 0]


def shade_bands(axes: Axes, settings: Settings, *, names: bool = True) -> None:
    """Colour the severities of each band; the gaps between the published bands stay white."""
    for band in bands_on_map(settings):
        first, last = settings.fault.shown(band.first), settings.fault.shown(band.last)
        axes.axvspan(first, last, color=band_fill(band), linewidth=0, zorder=0)
        if names:
            axes.text(
                (first + last) / 2,
                1.01,
                band.name,
                transform=axes.get_xaxis_transform(),
                ha="center",
                va="bottom",
                fontsize=9,
                color=band_ink(band),
                fontweight="bold",
            )


def severity_axis(axes: Axes, settings: Settings) -> None:
    axes.set_xlim(settings.fault.shown(settings.fault.first), settings.fault.shown(settings.fault.last))
    axes.set_xlabel(f"{settings.fault.name}  ({settings.fault.unit})")


def label_line_end(axes: Axes, x: float, y: float, text: str, colour: str, dx: float = 6) -> None:
    """Text at the end of a curve, instead of a legend."""
    axes.annotate(
        text, (x, y), xytext=(dx, 0), textcoords="offset points", va="center", ha="left", color=colour,
        fontweight="bold", annotation_clip=False,
    )  # fmt: skip


def spread(values: list[float], gap: float) -> list[float]:
    """`values` moved as little as needed so that neighbours are at least `gap` apart, for labels."""
    order = np.argsort(values)
    placed = np.array(values, dtype=float)[order]
    for _ in range(100):
        close = np.flatnonzero(np.diff(placed) < gap * (1 - 1e-9))
        if not len(close):
            break
        for k in close:
            middle = 0.5 * (placed[k] + placed[k + 1])
            placed[k], placed[k + 1] = middle - gap / 2, middle + gap / 2
    result = np.empty(len(placed))
    result[order] = placed
    return result.tolist()
