"""Figures of a study: overlay of the shown signals, their differences, and error against computing time."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.comparison.study import LaneResult, Study
from lacuna.analysis.report.figures.data import drawn_data
from lacuna.analysis.report.figures.style import INK, in_style, new_figure
from lacuna.drawn import save

COLOURS = {
    "ida": "#0072B2", "dopri5": "#009E73", "rodas4": "#CC79A7", "rk4": "#D55E00",
    "rk4, events not located": "#E69F00", "euler": "#56B4E9", "euler, events not located": "#999999",
}  # fmt: skip
MARKERS = {"ida": "o", "dopri5": "s", "rodas4": "D", "rk4": "^", "euler": "v"}

ROUNDING = 1e-14  # of a signal's largest magnitude: differences below it are not drawn

CAPTIONS = {
    "overlay": "Reference and the coarsest run of each fixed-step family.",
    "difference": "Distance from the reference over time; a gap means equal to 14 digits of the largest value.",
    "work_precision": "Largest relative deviation of any signal over the processor time of the run; further left and "
    "down is better. Open markers: events taken at the end of a step.",
}


def draw_all(study: Study, units: Mapping[str, str], folder: Path) -> list[str]:
    """Write <scenario>_<figure>.svg, .png and .csv into `folder`; the stems written, in order."""
    stems = []
    for kind, draw in {"overlay": overlay, "difference": difference, "work_precision": work_precision}.items():
        with in_style():
            figure = draw(study, units)
            FigureCanvasAgg(figure)
            stems.append(f"{study.scenario.name}_{kind}")
            for form in ("svg", "png"):
                save(figure, folder / f"{stems[-1]}.{form}", form)
            (folder / f"{stems[-1]}.csv").write_text(drawn_data(figure), encoding="utf-8")
    return stems


def _coarsest(study: Study) -> list[LaneResult]:
    """Of each fixed-step family the run with the largest step that ended well."""
    chosen: dict[str, LaneResult] = {}
    for result in study.lanes:
        if result.lane.step and result.failure is None:
            best = chosen.get(result.lane.family)
            if best is None or result.lane.step > best.lane.step:
                chosen[result.lane.family] = result
    return list(chosen.values())


def _stack(study: Study) -> tuple[Figure, list]:
    count = len(study.scenario.shown)
    figure = new_figure(8.6, 1.2 + 1.9 * count)
    return figure, list(np.atleast_1d(figure.subplots(count, 1, sharex=True)))


def overlay(study: Study, units: Mapping[str, str]) -> Figure:
    figure, panels = _stack(study)
    for axes, name in zip(panels, study.scenario.shown, strict=True):
        axes.plot(study.time, study.reference.values[name], color=INK, linewidth=2.6, label="reference (ida)")
        for result in _coarsest(study):
            family = result.lane.family
            values = result.values[name]
            axes.plot(
                study.time[: len(values)], values, "--", color=COLOURS[family], linewidth=1.2, label=result.lane.label
            )
        axes.set_ylabel(_label(name, units.get(name, "")))
    _finish(figure, panels, study, "signals")
    return figure


def difference(study: Study, units: Mapping[str, str]) -> Figure:
    figure, panels = _stack(study)
    for axes, name in zip(panels, study.scenario.shown, strict=True):
        reference = study.reference.values[name]
        for result in _coarsest(study):
            values = result.values[name]
            gap = np.abs(values - reference[: len(values)])
            rounding = ROUNDING * np.max(np.abs(reference))
            axes.semilogy(
                study.time[: len(gap)], np.where(gap > rounding, gap, np.nan), color=COLOURS[result.lane.family],
                linewidth=1.0, label=result.lane.label,
            )  # fmt: skip
        axes.set_ylabel(_label(f"|Δ {name}|", units.get(name, "")))
    _finish(figure, panels, study, "distance from the reference")
    return figure


def _finish(figure: Figure, panels: list, study: Study, what: str) -> None:
    panels[-1].set_xlabel("time (s)")
    panels[0].set_title(f"{study.scenario.title}: {what}")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3, fontsize=8, frameon=False)


def _label(name: str, unit: str) -> str:
    return f"{name}  ({unit})" if unit not in ("", "1") else name


def work_precision(study: Study, units: Mapping[str, str]) -> Figure:
    figure = new_figure(8.6, 5.0)
    axes = figure.subplots()
    families: dict[str, list[LaneResult]] = {}
    for result in study.lanes:
        if result.failure is None and result.error > 0:
            families.setdefault(result.lane.family, []).append(result)
    for family, group in families.items():
        points = sorted((r.seconds, r.error) for r in group)
        axes.loglog(
            *zip(*points, strict=True), "-", color=COLOURS[family], label=family, linewidth=1.4,
            marker=MARKERS[group[0].lane.solver], markerfacecolor=COLOURS[family] if group[0].lane.located else "white",
        )  # fmt: skip
    axes.set_xlabel("processor time of the run (s)")
    axes.set_ylabel("largest relative deviation of any signal")
    axes.set_title(f"{study.scenario.title}: work and precision")
    if axes.get_legend_handles_labels()[0]:  # none where all runs are equal to the reference
        figure.legend(loc="outside right center", fontsize=8, frameon=False)
    return figure
