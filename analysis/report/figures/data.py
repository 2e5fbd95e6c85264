"""What a figure shows, as numbers: for those who want to draw it themselves."""

from __future__ import annotations

import csv
import io

from matplotlib.axes import Axes
from matplotlib.figure import Figure
import numpy as np


def drawn_data(figure: Figure) -> str:
    """CSV of every curve, bar and band, a row a point: panel (from 1), its axes' labels, the curve's, x, y. What is not
    data (in coordinates of the panel) is left out."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(("panel", "x is", "y is", "curve", "x", "y"))
    for number, axes in enumerate(figure.axes, 1):
        for label, x, y in _curves(axes):
            head = (number, axes.get_xlabel(), axes.get_ylabel(), label)
            rows.writerows((*head, f"{a:.9g}", f"{b:.9g}") for a, b in zip(x, y, strict=True))
    return text.getvalue()


def _curves(axes: Axes) -> list[tuple[str, np.ndarray, np.ndarray]]:
    found = [
        (_label(line, f"curve {k}"), np.asarray(line.get_xdata(orig=True)), np.asarray(line.get_ydata(orig=True)))
        for k, line in enumerate(axes.lines, 1)
        if line.get_transform() == axes.transData
    ]
    found += [
        (_label(container, "bars"), np.array([b.get_x() + b.get_width() / 2 for b in container]),
         np.array([b.get_height() for b in container]))
        for container in axes.containers if hasattr(container, "patches")
    ]  # fmt: skip
    for k, band in enumerate(axes.collections, 1):
        for path in band.get_paths() if band.get_transform() == axes.transData else ():
            found.append((_label(band, f"area {k}"), path.vertices[:, 0], path.vertices[:, 1]))
    plain = [(label, np.ravel(x).astype(float), np.ravel(y).astype(float)) for label, x, y in found]
    return [(label, x, y) for label, x, y in plain if x.size == y.size]


def _label(artist: object, otherwise: str) -> str:
    label = str(artist.get_label())
    return otherwise if not label or label.startswith("_") else label
