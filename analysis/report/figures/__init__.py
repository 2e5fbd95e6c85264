"""The figures of a map, one module each; `draw_all` writes them as SVG and PNG.

Matplotlib is imported here, so import this package only where figures are wanted.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from lacuna.analysis.map.rows import Row
from lacuna.analysis.report.figures import currents, mean_rms, phase_rms, spectra, speed
from lacuna.analysis.report.figures.data import drawn_data
from lacuna.analysis.report.figures.style import in_style
from lacuna.analysis.settings import Settings
from lacuna.drawn import save

# File stem: (title in the report, what to see there, function that draws it).
FIGURES: dict[str, tuple[str, str, Callable[[Settings, list[Row]], Figure]]] = {
    "fig4_phase_rms": (phase_rms.TITLE, phase_rms.CAPTION, phase_rms.draw),
    "fig5_mean_rms": (mean_rms.TITLE, mean_rms.CAPTION, mean_rms.draw),
    "fig6_speed": (speed.TITLE, speed.CAPTION, speed.draw),
    "fig7_currents": (currents.TITLE, currents.CAPTION, currents.draw),
    "spectra": (spectra.TITLE, spectra.CAPTION, spectra.draw),
}


def draw_all(settings: Settings, rows: list[Row], folder: Path) -> None:
    """Write every figure into `folder`, as <stem>.svg and <stem>.png, and what it shows as <stem>.csv."""
    for stem, (_, _, draw) in FIGURES.items():
        with in_style():
            figure = draw(settings, rows)
            FigureCanvasAgg(figure)
            for kind in ("svg", "png"):
                save(figure, folder / f"{stem}.{kind}", kind)
            (folder / f"{stem}.csv").write_text(drawn_data(figure), encoding="utf-8")
