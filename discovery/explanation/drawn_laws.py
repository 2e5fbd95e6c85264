"""Each law that was found at a place of the equations, over the effort of any course that the recordings tell there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.report.figures.style import in_style
from lacuna.discovery.case.cases import Recording
from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.latent.chains import Latent, Piece
from lacuna.discovery.efforts.latent.evidence import evidence
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.latent.smoother import courses
from lacuna.discovery.efforts.latent.thinned import SAMPLES, thinned
from lacuna.discovery.efforts.located import SIZES, TIMES, Locator
from lacuna.discovery.experiment.picture import with_unit
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.explanation.figures import ABOVE
from lacuna.discovery.explanation.wording import HALF_WIDTH
from lacuna.discovery.naming.name import Finding
from lacuna.runtime import SimulationError


@dataclass(frozen=True)
class Drawn:
    """A law along a recording, what the recording tells of the effort there whatever its course, and the variable that
    the law is a function of; "" where it is of none."""

    title: str
    unit: str
    time: np.ndarray
    law: np.ndarray
    effort: np.ndarray
    error: np.ndarray
    variable: str = ""
    over: np.ndarray | None = None


def laws_over_efforts(result: Explanation) -> Figure | None:
    """A row for each law: in time, and over the first variable of it. None where no law stands at a place, or where
    the believed model does not run with the efforts of all of them put in."""
    if result.opened is None or result.opened.locator is None:
        return None
    laws = [f for f in result.findings if f.ranked.attachment.site is not None]
    physics = [f for f in result.findings if not f.ranked.attachment.variable]
    if not laws or len(laws) < len(physics):
        return None
    try:
        drawn = _drawn(result, result.opened.locator, laws)
    except (NotNumeric, SimulationError, np.linalg.LinAlgError):
        return None
    return _figure(drawn) if drawn else None


def _drawn(result: Explanation, locator: Locator, laws: list[Finding]) -> list[Drawn]:
    """The laws along the recording in which the first of them varies most."""
    point, columns = result.final.point, [_column(locator, f) for f in laws]
    if None in columns:
        return []

    def along(recording: Recording) -> list[np.ndarray]:
        return [_values(result, f, recording) for f in laws]

    recording, efforts = max(((r, along(r)) for r in result.case.fit), key=lambda pair: float(np.ptp(pair[1][0])))
    own = {n: v for n, v in point.items() if n in locator.point}
    whole = locator.piece(locator.point | own, recording, list(zip(columns, efforts, strict=True)))
    left = _left(result, locator, recording)
    drawn = []
    for finding, column, law in zip(laws, columns, efforts, strict=True):
        answer = whole.along.response(np.array([column]), law[:, None], hold=True)[:, :, 0]
        piece = Piece(whole.along, (left + answer)[:, :, None], locator.noise, whole.start)
        effort, error = courses([piece], _likeliest(piece, column), np.zeros(0))[0]
        title = f"missing at {finding.ranked.attachment.location}"
        shown = Drawn(title, _unit(finding), recording.time, law, effort, error)
        drawn.append(replace(shown, **_first_variable(result, finding, recording)))
    return drawn


def _first_variable(result: Explanation, finding: Finding, recording: Recording) -> dict[str, Any]:
    """The first variable that a law reads, with its course."""
    attachment, machine = finding.ranked.attachment, result.final.machine
    if not attachment.signals:
        return {}
    local, reading = attachment.signals[0]
    name = f"{attachment.component}.{local}"
    over = machine.trajectory(result.final.point, recording, [name])[name]
    return {"variable": with_unit(reading, machine.model.variables[name].unit), "over": over}


def _column(locator: Locator, finding: Finding) -> int | None:
    """The input of the opened model that acts where the law does."""
    own = finding.ranked.attachment.site
    everywhere = [p for place in locator.places for p in (place, *place.other)]
    return next((p.columns[0] for p in everywhere for s in p.sites if (s.kind, s.label) == (own.kind, own.label)), None)


def _unit(finding: Finding) -> str:
    return finding.ranked.attachment.effect.parameters[0].unit or "1"


def _values(result: Explanation, finding: Finding, recording: Recording) -> np.ndarray:
    """(n,) what the law gives along a recording, in the sense in which an effort acts there."""
    attachment, machine = finding.ranked.attachment, result.final.machine
    site = attachment.site.parts[0] if attachment.site.members else attachment.site
    port, own = site.port, attachment.component
    plus, minus = f"{own}.effort", None
    if site.outside:
        plus, minus = {
            "node": (None, f"{own}.port.{port.flow}"),
            "branch": (None, f"{own}.b.{port.flow}"),
            "edge": (f"{own}.a.{port.potential}", f"{own}.b.{port.potential}"),
        }[site.kind]
    found = machine.trajectory(result.final.point, recording, [n for n in (plus, minus) if n])
    none = np.zeros(len(recording.time))
    return (found[plus] if plus else none) - (found[minus] if minus else none)


def _left(result: Explanation, locator: Locator, recording: Recording) -> np.ndarray:
    """(n, y) what the amended model leaves; nothing of a signal whose sensor errs."""
    residuals = result.final.residuals[recording.name]
    left = np.stack([residuals[s.column] for s in locator.case.outputs], 1)
    wrong = {f.ranked.attachment.variable for f in result.findings}
    left[:, [s.variable in wrong for s in locator.case.outputs]] = np.nan
    return left


def _likeliest(piece: Piece, column: int) -> Latent:
    """The size and time constant of an effort there that explain the recording best."""
    along: Along = piece.along
    count = len(SIZES) * len(TIMES)
    answer = along.response(np.array([column]), np.ones((len(along.time), 1)))[:, :, 0] / piece.noise
    misfit = piece.data[:, :, 0] / piece.noise
    unit = np.sqrt(np.nanmean(misfit**2) / max(np.mean(answer**2), 1e-300))
    size, time = (g.ravel() for g in np.meshgrid(SIZES * unit, np.array(TIMES) * np.ptp(along.time)))
    many = Latent(np.full((count, 1), column), np.full(count, -1), size, time)
    log = evidence([thinned(piece, -(-len(along.time) // SAMPLES[0]))], many).log
    return many.of([int(np.argmax(np.where(np.isfinite(log), log, -np.inf)))])


@in_style()
def _figure(drawn: list[Drawn]) -> Figure:
    figure = Figure(figsize=(9, 0.3 + 2.8 * len(drawn)), layout="constrained")
    axes = figure.subplots(len(drawn), 2, squeeze=False)
    for (left, right), law in zip(axes, drawn, strict=True):
        reach = HALF_WIDTH * law.error
        left.fill_between(law.time, law.effort - reach, law.effort + reach, color="0.6", alpha=0.3, lw=0)
        left.plot(law.time, law.effort, "0.6", lw=3, label="located, any course; band: 95 %")
        left.plot(law.time, law.law, "C0", lw=1.2, label="the law")
        left.set(xlabel="time  (s)", ylabel=with_unit(law.title, law.unit))
        left.legend(**ABOVE, ncols=2)
        if law.over is None:
            right.set_axis_off()
            continue
        right.plot(law.over, law.effort, ".", ms=6, color="0.6", label="located")
        right.plot(law.over, law.law, "C0.", ms=1.5, label="the law")
        right.set(xlabel=law.variable, ylabel=with_unit(law.title, law.unit))
        right.legend(**ABOVE, ncols=2, markerscale=4)
    return figure
