"""report.html of an assessed recording: its severity on the map, what was read from it, and what was odd about it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from markupsafe import Markup

from lacuna.analysis.report.page import figure, heading, page, paragraph, table


def report_html(done: Any, svg: str, data: str, inputs: list[Path], caption: str) -> str:
    """`done` is an Assessment, of one fault or two: the first half of its sentence is the verdict, the rest what the
    band advises. `svg` shows the recording on its map, which `caption` explains; `data` is that as CSV."""
    recording, warnings, features = Path(done.recording), done.warnings, done.features
    verdict, action = _split(done.sentence)
    rows = [
        (f"RMS of phase {phase}, mA", f"{1e3 * value:.2f}")
        for phase, value in zip("ABC", features["rms"], strict=False)
    ]
    rows += [("mean RMS, mA", f"{1e3 * features['rms_mean']:.2f}")]
    rows += [
        (f"first peak of phase {phase}, Hz", _hertz(value))
        for phase, value in zip("ABC", features["peak_hz"], strict=False)
    ]
    body = [figure(svg, f"{recording.name} on its map", caption, ("assessment.csv", data))]
    if warnings:
        items = Markup("").join(Markup("<li>{}</li>").format(text) for text in warnings)
        body += [heading("What was odd"), Markup("<ul>{}</ul>").format(items)]
    body += [heading("What was read from the recording"), table(("quantity", "value"), rows)]
    body += [paragraph("assessment.json has the same with all digits, and the spectrum's lines.")]
    return page(
        f"Severity: {recording.name}", Markup("\n").join(body), verdict=verdict, action=action,
        inputs=[recording, *inputs],
    )  # fmt: skip


def _split(sentence: str) -> tuple[str, str]:
    """The reading, and what the band advises to do after it."""
    head, mode, action = sentence.partition(" mode. ")
    return (f"{head} mode.", action) if mode else (sentence, "")


def _hertz(value: float | None) -> str:
    return "none" if value is None or value != value else f"{value:.2f}"
