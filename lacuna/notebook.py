"""How things show themselves in a notebook: tables and figures as HTML, everything escaped."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def page(title: str, *parts: str) -> str:
    """A titled block of parts that are HTML already."""
    return f"<div><b>{escape(title)}</b>{''.join(parts)}</div>"


def paragraph(text: str) -> str:
    return f"<p>{escape(text)}</p>"


def verbatim(text: str) -> str:
    return f"<pre>{escape(text)}</pre>"


def table(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table; numbers with five digits."""
    head = "".join(f"<th style='text-align:left'>{escape(name)}</th>" for name in header)
    cells = ("".join(f"<td style='text-align:left'>{escape(text(value))}</td>" for value in row) for row in rows)
    return f"<table><tr>{head}</tr>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>"


def text(value: object) -> str:
    if value is None:
        return ""
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def drawing(figure: Figure) -> str:
    """A figure as SVG inside the page."""
    buffer = io.StringIO()
    from lacuna.drawn import save

    save(figure, buffer, "svg")
    return buffer.getvalue().partition("<svg")[1] + buffer.getvalue().partition("<svg")[2]
