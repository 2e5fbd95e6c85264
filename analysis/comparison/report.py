"""report.html of a comparison: every scenario with its orders, lanes, worst signals and figures, in one file."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from html import escape
from pathlib import Path
from string import Template

import numpy as np

from analysis.comparison.figures import CAPTIONS
from analysis.comparison.study import LaneResult, Study

_TEMPLATE = Path(__file__).with_name("report.html.in")


def report_html(studies: Sequence[Study], figures: dict[str, list[str]], folder: Path) -> str:
    """The page; `figures` maps a scenario to the stems that lie in `folder` as SVG and PNG."""
    sections = "\n".join(_section(study, figures[study.scenario.name], folder) for study in studies)
    return Template(_TEMPLATE.read_text(encoding="utf-8")).substitute(
        count=len(studies), summary=_summary(studies), sections=sections
    )


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    body = "\n".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def order_text(order: float) -> str:
    """An observed order for a table; a dash where too few errors stand clear of the reference's own tolerance."""
    return "-" if np.isnan(order) else f"{order:.2f}"


def _summary(studies: Sequence[Study]) -> str:
    families = list(studies[0].orders) if studies else []
    rows = [
        [s.scenario.title, str(s.reference.events.matched), *(order_text(s.orders.get(f, np.nan)) for f in families)]
        for s in studies
    ]
    return _table(["scenario", "events", *(f"order: {f}" for f in families)], rows)


def _section(study: Study, stems: Sequence[str], folder: Path) -> str:
    scenario = study.scenario
    settings = ", ".join(f"{name} = {value:g}" for name, value in scenario.parameters.items()) or "as declared"
    images = "\n".join(_image(stem, stem.removeprefix(scenario.name + "_"), folder) for stem in stems)
    return (
        f"<h2>{escape(scenario.title)}</h2><p><code>{escape(scenario.model)}</code>, {scenario.stop:g} s; "
        f"parameters: {escape(settings)}; reference: IDA at rtol {scenario.reference_rtol:g}.</p>"
        f"{_lanes(study)}{images}"
    )


def _lanes(study: Study) -> str:
    return _table(
        ["run", "time", "worst signal", "largest deviation", "relative", "event times", "events unmatched", "steps"],
        [_lane_row(result) for result in study.lanes],
    )


def _lane_row(result: LaneResult) -> list[str]:
    if result.failure is not None:
        return [result.lane.label, f"{result.seconds:.3f} s", f"failed: {result.failure}", "", "", "", "", ""]
    worst = max(result.signals, key=lambda s: s.relative)
    return [
        result.lane.label, f"{result.seconds:.3f} s", worst.name, f"{worst.maximum:.2e}", f"{worst.relative:.2e}",
        f"{result.events.maximum:.1e} s", str(result.events.unmatched), f"{result.counters['steps']:,}",
    ]  # fmt: skip


def _image(stem: str, kind: str, folder: Path) -> str:
    data = base64.b64encode((folder / f"{stem}.png").read_bytes()).decode()
    caption = escape(CAPTIONS[kind])
    return (
        f'<figure><img alt="{caption}" src="data:image/png;base64,{data}"><figcaption>{caption}</figcaption></figure>'
    )
