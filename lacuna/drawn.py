"""Figures as files: names of users are text and no formulas, and equal figures are equal bytes."""

from __future__ import annotations

from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_UNSAID = dict.fromkeys(("Date", "Creator", "Format", "Type"))  # what SVG says of the day and the program


def save(figure: Figure, target: Path | IO[str], kind: str, **settings: Any) -> None:
    """Write `figure` as `kind` ("svg" or "png")."""
    from matplotlib import rc_context

    for axes in figure.axes:
        legend = axes.get_legend()
        entries = legend.get_texts() if legend is not None else []
        for text in (axes.title, axes.xaxis.label, axes.yaxis.label, *axes.texts, *entries):
            text.set_parse_math(False)
    with rc_context({"svg.hashsalt": "lacuna"}):
        figure.savefig(target, format=kind, metadata=_UNSAID if kind == "svg" else None, **settings)
