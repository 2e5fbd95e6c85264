"""As figure 7 of the paper: the filtered phase currents around one electrical turn of the rotor."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.map.rows import Row
from lacuna.analysis.report.figures.style import INK, MUTED, PHASE_STYLES, PHASES, landmarks, new_figure, phase_name
from lacuna.analysis.settings import Settings

TITLE = "Phase currents and rotor position"
CAPTION = (
    "As figure 7 of the paper, over the last electrical turn. Around: electrical rotor angle, zero where "
    "phase A's back-EMF rises through zero. Outwards: filtered phase current; the dotted circle is zero current. "
    "The red arrow marks the angle at which the fault raises the back-EMF most. The healthy motor draws the same "
    "pattern three times, 120 degrees apart; the fault weakens the back-EMF on the side away from the arrow, and "
    "the current rushes in there."
)


def draw(settings: Settings, rows: list[Row]) -> Figure:
    figure = new_figure(11.5, 4.7)
    marks = landmarks(settings, rows)
    picks = [marks[0], *marks[-2:]]
    limit = 1.05 * max(float(np.abs(last_turn(settings, row)[1]).max()) for row, _ in picks)
    panels = figure.subplots(1, len(picks), subplot_kw={"projection": "polar"})
    for axes, (row, colour) in zip(panels, picks, strict=True):
        _draw_orbit(axes, settings, row, limit)
        axes.set_title(settings.fault.text(row.severity), loc="center", color=colour, pad=12)
    lines = [(PHASES[c], PHASE_STYLES[c], f"phase {phase_name(c)}") for c in range(len(settings.currents))]
    handles = [panels[0].plot([], [], style, color=colour, label=name)[0] for colour, style, name in lines]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(lines), frameon=False)
    return figure


def last_turn(settings: Settings, row: Row) -> tuple[np.ndarray, np.ndarray]:
    """Electrical angle (rad) and currents (A) over the last electrical turn of the record."""
    pole_pairs = settings.raw["actuator"].get("pole_pairs", 1)
    angle = pole_pairs * row.traces["angle"].astype(float)
    shown = angle >= angle[-1] - 2 * np.pi
    return angle[shown], row.traces["currents"][:, shown]


def _draw_orbit(axes: Axes, settings: Settings, row: Row, limit: float) -> None:
    angle, currents = last_turn(settings, row)
    for channel, current in enumerate(currents):
        axes.plot(angle, current, PHASE_STYLES[channel], color=PHASES[channel], linewidth=1.6)
    axes.set_ylim(-1.25 * limit, limit)
    ring = np.linspace(0, 2 * np.pi, 200)
    axes.plot(ring, np.zeros_like(ring), ":", color=MUTED, linewidth=1.2)
    step = 10.0 ** np.floor(np.log10(limit))
    levels = step * np.arange(-np.floor(limit / step), np.floor(limit / step) + 1)
    axes.set_rticks(levels, [f"{level:+g} A" if level else "0" for level in levels], fontsize=8, color=INK)
    for label in axes.get_yticklabels():
        label.set_bbox({"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 0.6})
    axes.set_rlabel_position(105)
    axes.set_xticks(np.radians(np.arange(0, 360, 60)))
    weak = settings.raw["actuator"].get("strongest_angle")
    if weak is not None and row.severity > 0:
        axes.annotate(
            "", (np.radians(weak), limit), (np.radians(weak), -1.25 * limit),
            arrowprops={"arrowstyle": "-|>", "color": "#c00000", "linewidth": 2.2},
        )  # fmt: skip
