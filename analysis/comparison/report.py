"""report.html of a comparison: every scenario with its orders, lanes, worst signals and figures, in one file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from string import Template
from types import MappingProxyType

from markupsafe import Markup
import numpy as np

from lacuna.analysis.comparison.deviation import SignalDeviation
from lacuna.analysis.comparison.figures import CAPTIONS
from lacuna.analysis.comparison.study import LaneResult, Study
from lacuna.analysis.report.page import figure_in, page
from lacuna.analysis.report.page import table as _table

_ACTION = "of the runs in a table below whose largest deviation is small enough for you, take the fastest"
_TEMPLATE = Path(__file__).with_name("report.html.in")


def report_html(
    studies: Sequence[Study],
    figures: dict[str, list[str]],
    folder: Path,
    inputs: Sequence[Path] = (),
    hashes: Mapping[str, str] = MappingProxyType({}),
) -> str:
    """The page; `figures` maps a scenario to the stems that lie in `folder` as SVG and PNG, `hashes` a model to what it
    was translated from. `inputs`: files that say what was run."""
    sections = "\n".join(_section(study, figures[study.scenario.name], folder) for study in studies)
    said = findings(studies)
    body = Template(_TEMPLATE.read_text(encoding="utf-8")).substitute(
        count=_scenarios(len(studies)), summary=_summary(studies), sections=sections,
        findings="\n".join(f"<li>{escape(text)}</li>" for text in said),
    )  # fmt: skip
    return page(
        _title(studies), Markup(body), verdict=f"{said[0][0].upper()}{said[0][1:]}." if said else "", action=_ACTION,
        inputs=inputs, notes=[f"Model {name}: {value}" for name, value in hashes.items()],
    )  # fmt: skip


def _title(studies: Sequence[Study]) -> str:
    of = studies[0].scenario.title if len(studies) == 1 else _scenarios(len(studies))
    return f"Variable step against fixed step: {of}"


def _scenarios(count: int) -> str:
    return f"{count} scenario{'s' * (count != 1)}"


def order_text(study: Study, family: str) -> str:
    """An observed order for a table; a dash where too few errors stand clear of the reference's own, a star where some
    run takes another course (see `Study.off_course`)."""
    order = study.orders.get(family, np.nan)
    text = "-" if np.isnan(order) else f"{order:.2f}" if order > 0 else "none"
    return text + "*" * (family in study.off_course)


def findings(studies: Sequence[Study]) -> list[str]:
    """What the studies show, in sentences: how near variable steps are, the orders, how event times agree."""
    said = _variable(studies)
    for family in dict.fromkeys(family for study in studies for family in study.orders):
        on_course = [s.orders[family] for s in studies if family in s.orders and family not in s.off_course]
        known = [order for order in on_course if not np.isnan(order)]
        if known:
            span = " to ".join(dict.fromkeys(f"{order:.2f}" for order in (min(known), max(known))))
            said.append(f"{family}: order {span}, {len(known)} of {_scenarios(len(studies))}")
    return said + _on_events([s for s in studies if _has_events(s)])


def _variable(studies: Sequence[Study]) -> list[str]:
    variable = [lane for study in studies for lane in study.lanes if _counts(lane)]
    failed = sum(lane.failure is not None for study in studies for lane in study.lanes)
    said = []
    if variable:
        worst = max((signal for lane in variable for signal in lane.signals), key=lambda s: s.relative)
        matched = [lane.events.maximum for lane in variable if lane.events.matched]
        times = f", event times within {max(matched):.1e} s" if matched else ""
        said.append(
            f"variable steps at 1e-6 or tighter: signals within {worst.relative:.1e} of the reference, relative "
            f"({worst.name}{_where(studies, worst)}){times}"
        )
    return said + [f"{failed} run{'s' * (failed != 1)} failed: the tables say why"] * bool(failed)


def _where(studies: Sequence[Study], worst: SignalDeviation) -> str:
    """The scenario of a deviation, and the largest one of all others, where there are several scenarios."""
    if len(studies) == 1:
        return ""
    found = {s.scenario.title: [x for r in s.lanes if _counts(r) for x in r.signals] for s in studies}
    own = next(title for title, signals in found.items() if any(x is worst for x in signals))
    others = max((x.relative for title, signals in found.items() if title != own for x in signals), default=0.0)
    return f" in {own}; {others:.1e} in all others"


def _has_events(study: Study) -> bool:
    return any(r.events.matched or r.events.unmatched for r in (study.reference, *study.lanes))


def _on_events(studies: Sequence[Study]) -> list[str]:
    if not studies:
        return ["no events happen"]
    said = []
    finest = [min((r for r in s.lanes if r.lane.family == "rk4"), key=lambda r: r.lane.step) for s in studies]
    if finest:
        worst = max(r.events.maximum for r in finest)
        said.append(f"rk4 at the finest step: event times within {worst:.1e} s in all of {_scenarios(len(finest))}")
    checked = [(study, lane) for study in studies for lane in study.lanes if _counts(lane)]
    late = [_late(study, lane) for study, lane in checked if _is_late(study, lane)]
    said.append(
        f"event times: within ten times the relative tolerance of the duration in {len(checked) - len(late)} of "
        f"{len(checked)} variable-step runs at 1e-6 or tighter" + ("; the others:" * bool(late))
    )
    return said + late


def _counts(lane: LaneResult) -> bool:
    return lane.lane.rtol is not None and lane.lane.rtol <= 1e-6 and lane.failure is None


def _is_late(study: Study, lane: LaneResult) -> bool:
    return _counts(lane) and lane.events.maximum > 10 * lane.lane.rtol * study.scenario.stop


def _late(study: Study, lane: LaneResult) -> str:
    lost = f", {lane.events.unmatched} without partner" if lane.events.unmatched else ""
    return (
        f"{study.scenario.title}, {lane.lane.label}: {lane.events.maximum:.1e} s at {lane.events.at_time:.6g} s"
        f" ({lane.events.kind}{lost})"
    )


def _summary(studies: Sequence[Study]) -> str:
    families = list(studies[0].orders) if studies else []
    rows = [
        [s.scenario.title, str(s.reference.events.matched), f"{s.second.rms_error:.1e}",
         *(order_text(s, f) for f in families)]
        for s in studies
    ]  # fmt: skip
    return _table(["scenario", "events", "error of the reference", *(f"order: {f}" for f in families)], rows)


def _section(study: Study, stems: Sequence[str], folder: Path) -> str:
    scenario = study.scenario
    settings = ", ".join(f"{name} = {value:g}" for name, value in scenario.parameters.items()) or "as declared"
    images = "\n".join(_image(stem, stem.removeprefix(scenario.name + "_"), folder) for stem in stems)
    return (
        f"<h2>{escape(scenario.title)}</h2><p><code>{escape(scenario.model)}</code>, {scenario.stop:g} s; "
        f"parameters: {escape(settings)}; reference: IDA at rtol {scenario.reference_rtol:g}.</p>"
        f"{_lanes(study)}{_failures(study)}{images}"
    )


def _failures(study: Study) -> str:
    failed = [(lane.lane.label, lane.failure) for lane in study.lanes if lane.failure is not None]
    return "".join(f"<p class=warn>{escape(label)} failed: {escape(why)}</p>" for label, why in failed)


def _lanes(study: Study) -> str:
    return _table(
        ["run", "processor time, s", "worst signal", "largest deviation", "relative", "event times, s", "worst at, s",
         "without partner", "steps"],
        [_lane_row(result) for result in (study.second, *study.lanes)],
    )  # fmt: skip


def _lane_row(result: LaneResult) -> list[str]:
    if result.failure is not None:
        return [result.lane.label, f"{result.seconds:.2g}", "failed", "", "", "", "", "", ""]
    worst = max(result.signals, key=lambda s: s.relative)
    return [
        result.lane.label, f"{result.seconds:.2g}", worst.name, _with_unit(worst), f"{worst.relative:.2e}",
        *(["-", "-"] if np.isnan(result.events.at_time) else
          [f"{result.events.maximum:.1e}", f"{result.events.at_time:.5g}"]),
        str(result.events.unmatched), f"{result.counters['steps']:,}",
    ]  # fmt: skip


def _with_unit(worst: SignalDeviation) -> str:
    unit = "" if worst.unit in ("", "1") else f"\N{NO-BREAK SPACE}{worst.unit}"
    return f"{worst.maximum:.2e}{unit}"


def _image(stem: str, kind: str, folder: Path) -> str:
    return figure_in(folder, stem, CAPTIONS[kind].partition(".")[0], CAPTIONS[kind])
