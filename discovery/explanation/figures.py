"""What an explanation shows: the courses of signals, what is left of them beside noise, and the law over what is
missing."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.report.figures.style import in_style
from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.catalogue.places import Line, Shaft
from lacuna.discovery.experiment.picture import POINTS, with_unit
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.explanation.wording import HALF_WIDTH
from lacuna.discovery.law.locate import Located
from lacuna.discovery.naming.name import Finding

SAMPLES = 3000  # of a cloud
ABOVE = {"fontsize": 8, "loc": "lower right", "bbox_to_anchor": (1, 1), "frameon": False}  # off curves and exponents

Curve = tuple[str, str, Mapping[str, np.ndarray]]  # label, colour, measured minus simulated of each column


@in_style()
def courses(case: Case, recording: Recording, curves: list[Curve], noise: Mapping[str, float]) -> Figure:
    """A recording and simulations of it, a row for each output; at the right what is left, over the band of noise."""
    figure = Figure(figsize=(9, 0.6 + 1.7 * len(case.outputs)), layout="constrained")
    axes = figure.subplots(len(case.outputs), 2, sharex=True, squeeze=False)
    for (ax, beside), signal in zip(axes, case.outputs, strict=True):
        own = np.flatnonzero(np.isfinite(recording.columns[signal.column]))
        rows = own[:: max(1, len(own) // POINTS)]
        time, measured = recording.time[rows], recording.columns[signal.column][rows]
        ax.plot(time, measured, "0.6", lw=2.5, label="measured")
        for label, colour, residual in curves:
            ax.plot(time, measured - residual[signal.column][rows], colour, lw=1, label=label)
            beside.plot(time, residual[signal.column][rows], colour, lw=0.7)
        if signal.column in noise:
            reach = HALF_WIDTH * noise[signal.column]
            beside.axhspan(-reach, reach, color="0.85", zorder=0, label="noise, 95 %")
        ax.set_ylabel(with_unit(signal.column, signal.model_unit))
        beside.set_ylabel(with_unit("", signal.model_unit))
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper left", ncols=4, fontsize=8, frameon=False)
    axes[0, 1].set_title("measured minus simulated; grey: noise, 95 %", fontsize=8, fontweight="normal")
    for ax in axes[-1]:
        ax.set_xlabel("time  (s)")
    return figure


@in_style()
def missing(result: Explanation) -> Figure | None:
    """What is missing at the place that explains most, in time and over what it depends on, and the law that was found
    for it there; None where no effort was located."""
    located, finding = result.located, _at(result)
    place = result.effort or (located.best if located else None)
    if place is None:
        return None
    figure = Figure(figsize=(9, 3.1), layout="constrained")
    left, right = figure.subplots(1, 2)
    name = max(place.effort, key=lambda n: float(np.ptp(place.effort[n][1])))
    time, effort = place.effort[name]
    left.plot(time, effort, "C7o-", ms=3, lw=1, label=f"located, {name}")
    if name in place.error:
        left.fill_between(
            time, *(effort + s * HALF_WIDTH * place.error[name] for s in (-1, 1)), color="C7", alpha=0.25, lw=0
        )
    _law(left, result, finding, name)
    left.set(xlabel="time  (s)", ylabel=with_unit(f"missing {place.kind} at {place.location}", place.unit))
    left.legend(**ABOVE)
    _regime(right, located)
    right.set_ylabel(with_unit(f"{located.best.kind} at {located.best.location}", located.best.unit))
    return figure


def _at(result: Explanation) -> Finding | None:
    """The first finding at a place where an effort can be located."""
    found = (f for f in result.findings if isinstance(_site(f), Shaft | Line))
    return next(found, None)


def _site(finding: Finding) -> Shaft | Line | None:
    attachment = finding.ranked.attachment
    return attachment.shaft or (attachment.lines[0] if attachment.lines else None)


def _law(ax: Axes, result: Explanation, finding: Finding | None, name: str) -> None:
    """The effort of a finding as the amended model has it: what it takes from its place, seen as what acts there."""
    if finding is None:
        return
    machine, recording = result.final.machine, next((r for r in result.case.fit if r.name == name), None)
    effort = "flange.tau" if isinstance(_site(finding), Shaft) else "v"
    variable = f"{finding.ranked.attachment.component}.{effort}"
    if recording is None or variable not in machine.model.variables:
        return
    course = -machine.trajectory(result.final.point, recording, [variable])[variable]
    rows = slice(None, None, max(1, len(course) // POINTS))
    ax.plot(recording.time[rows], course[rows], "C0", lw=1.2, label=f"law: {finding.ranked.attachment.effect.title}")


def _regime(ax: Axes, located: Located) -> None:
    """The effort over what organises it: a curve or a loop over a variable, a spectrum over an angle's orders."""
    found = located.organiser
    if found.kind == "orders":
        ax.bar(found.centres, found.means, color="C0")
        ax.set_xlabel(f"order of {found.variable} (periods a turn)")
        return
    keep = slice(None, None, max(1, len(located.values) // SAMPLES))
    ax.plot(located.values[keep], located.effort[keep], ".", ms=2, color="0.6", label="samples")
    over = found.centres if found.kind == "value" else np.sort(located.values)
    mean = found.means if found.kind == "value" else np.interp(np.sign(over), found.centres, found.means)
    ax.plot(over, mean, "C0-", lw=2, label="mean")
    ax.legend(**ABOVE)
    ax.set_xlabel(with_unit(found.variable, found.unit))
