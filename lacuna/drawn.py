"""Figures as files: names of users are text and no formulas, and equal figures are equal bytes."""

from __future__ import annotations

from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_UNSAID = dict.fromkeys(("Date", "Creator", "Format", "Type"))  # what SVG says of the day and the program


def save(figure: Figure, target: Path | IO[str], kind: str, **settings: Any) -> None:
    """Write `figure` as `kind` ("svg" or "png"). The only formulas are powers at the ticks of logarithmic axes."""
    from matplotlib import rc_context
    from matplotlib.text import Text

    drawn_by_us = {
        label
        for axes in figure.axes
        for axis in (axes.xaxis, axes.yaxis)
        if axis.get_scale() == "log"
        for label in axis.get_ticklabels(which="both")
    }
    for text in figure.findobj(Text):
        if text not in drawn_by_us:
            text.set_parse_math(False)
    with rc_context({"svg.hashsalt": "lacuna"}):
        figure.savefig(target, format=kind, metadata=_UNSAID if kind == "svg" else None, **settings)
