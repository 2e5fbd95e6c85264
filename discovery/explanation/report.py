"""report.html: the verdict in one sentence, then everything it rests on; one file without outside references."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
import io
from pathlib import Path
import re

from markupsafe import Markup
from matplotlib.figure import Figure
import numpy as np

from lacuna.analysis.report.figures.data import drawn_data
from lacuna.analysis.report.page import code, page, table, unbroken
from lacuna.analysis.report.page import figure as figure_of
from lacuna.discovery.case.cases import Case
from lacuna.discovery.efforts.places.sites import MOST
from lacuna.discovery.experiment.files import FOLDER
from lacuna.discovery.experiment.picture import picture
from lacuna.discovery.explanation.confidence import certainty
from lacuna.discovery.explanation.contenders import named
from lacuna.discovery.explanation.diagnosis import build, left_over, sentence
from lacuna.discovery.explanation.drawn_laws import laws_over_efforts
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.explanation.figures import Curve, courses, missing
from lacuna.discovery.explanation.wording import action, equation_of, in_words, rounded, with_error
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.objective import noise_of
from lacuna.discovery.naming.judge import Judgement, noise_floor
from lacuna.discovery.naming.name import Naming
from lacuna.drawn import save
from lacuna.written import write_whole

_NRMSE = (
    "<p>Normalised root mean square error: of what is measured and not simulated, over the standard deviation of the "
    "measured signal; <em>unseen</em> are recordings that nothing was fitted to.</p>"
)

_ANY_COURSE = (
    "<p>Grey: the effort, whatever its course, that the recording tells at the place of the law, all else as the "
    "amended model has it; where the band is wide the recording does not tell it. Blue: the law.</p>"
)
_PLACES = (
    "<p>An effort of any course at a place, alone beside the believed model, or an error of a sensor. More than one "
    "law may explain what no single place does. Places that explain less: {more}.</p>"
)
_SENSOR = "an error of the sensor"


def write(result: Explanation, folder: Path, amended: Path | None) -> Path:
    """Write the report of an explanation into `folder`."""
    parts = _problems(result)
    if result.before is not None:
        parts += _findings(result) + _located(result) + _overlays(result) + _quality(result)
        parts += _parameters(result) + _rivals(result) + _left(result)
    if amended is not None:
        parts += [f"<h2>{_amended_as(result)}</h2>", code(amended.read_text(encoding="utf-8"), "amended model")]
    verdict = f"{sentence(result)} {certainty(result)}"
    return _page(parts, result.case.title, folder, verdict, action(result, amended), result.case.files)


def _amended_as(result: Explanation) -> str:
    if result.verdict == "undetermined":
        return "A model that would explain them, which is not claimed"
    return "The amended model" if result.findings else "The model with its parameters as fitted"


def _page(parts: list[str], title: str, folder: Path, verdict: str, action: str, inputs: Sequence[Path]) -> Path:
    path = folder / "report.html"
    write_whole(path, page(title, Markup("\n".join(parts)), verdict=verdict, action=action, inputs=inputs))
    return path


def _table(header: list[str], rows: list[list[object]], numbers: range = range(1, 99)) -> str:
    return table(header, ([f"{c:.4g}" if isinstance(c, float) else str(c) for c in row] for row in rows), numbers)


def _svg(drawn: Figure, title: str) -> str:
    buffer = io.StringIO()
    data = drawn_data(drawn)
    save(drawn, buffer, "svg", bbox_inches="tight")
    name = re.sub(r"\W+", "-", title).strip("-").lower()
    return figure_of(buffer.getvalue(), title, data=(f"{name}.csv", data))


def _problems(result: Explanation) -> list[str]:
    if not result.problems:
        return []
    items = "".join(f"<li{' class=flag' if p.fatal else ''}>{escape(str(p))}</li>" for p in result.problems)
    return ["<h2>The recordings</h2>", f"<ul>{items}</ul>"]


def _quality(result: Explanation) -> list[str]:
    rows = [
        [
            c,
            result.before.validate[c],
            result.after.validate[c],
            result.floor[c],
            result.before.fit[c],
            result.after.fit[c],
        ]
        for c in result.floor
    ]
    rows.append(
        ["all", result.before.validate[""], result.after.validate[""], "", result.before.fit[""], result.after.fit[""]]
    )
    header = ["signal", "unseen: before", "after", "noise alone", "fitted: before", "after"]
    note = "<p><em>Before</em> is the believed model with its parameters already refitted.</p>"
    return ["<h2>How well it fits</h2>", _table(header, rows), _NRMSE, note]


def _overlays(result: Explanation) -> list[str]:
    recording = result.case.validate[0]
    curves: list[Curve] = [("believed model, refitted", "C3", result.before.residuals[recording.name])]
    if result.findings:
        curves.append(("amended model", "C0", result.after.residuals[recording.name]))
    return _overlay(result.case, curves, {c: n.std for c, n in result.base.noise.items()})


def _overlay(case: Case, curves: list[Curve], noise: dict[str, float]) -> list[str]:
    """The first validation recording and simulations of it."""
    recording = case.validate[0]
    return [
        f"<h2>On a recording that nothing was fitted to ({escape(recording.name)})</h2>",
        _svg(courses(case, recording, curves, noise), f"Measured and simulated: {recording.name}"),
    ]


def write_judgement(case: Case, judged: Judgement, folder: Path, model: Path) -> Path:
    """The page of one judged model file: its errors and its course on a validation recording."""
    levels = noise_of(case)
    floor = noise_floor(case, case.validate, levels)
    rows = [[c or "all", judged.validate[c], floor.get(c, ""), judged.fit[c]] for c in judged.validate]
    parts = _overlay(
        case, [(model.name, "C0", judged.residuals[case.validate[0].name])], {c: n.std for c, n in levels.items()}
    )
    parts += ["<h2>How well it fits</h2>", _table(["signal", "unseen", "noise alone", "fitted"], rows), _NRMSE]
    noise = float(np.sqrt(np.mean(np.square(list(floor.values())))))
    verdict = (
        f"As it is written, {model.name} misses the recordings that nothing was fitted to by "
        f"{100 * judged.validate['']:.3g} % of how much they vary; noise alone would be {100 * noise:.3g} %."
    )
    following = f"lacuna explain {case.folder.name} says whether what is left is physics that the equations lack"
    return _page(parts, f"{case.title}: {model.name}", folder, verdict, following, (*case.files, model))


def _located(result: Explanation) -> list[str]:
    if result.opened is not None and result.opened.sites:
        return _anywhere(result)
    located, drawn = result.located, missing(result)
    if drawn is None:
        return []
    rows = [[p.location, p.kind, f"{100 * p.explained:.0f} %"] for p in located.places]
    parts = ["<h2>Where something is missing</h2>"]
    note = (
        "<p>At each place the smoothest effort over time that explains the recordings, a few dozen values of it: fast "
        "changes show smaller than they are. The band is two standard deviations. Left: by the parameters fitted with "
        "the law, where there is one; right and in the table: by those fitted without it.</p>"
    )
    parts += [_svg(drawn, "What is missing, and the law for it"), note]
    return [*parts, _table(["place", "what", "misfit that it could explain"], rows, range(2, 3))]


def _anywhere(result: Explanation) -> list[str]:
    """Each law over the effort at its place, and what an effort at every other place would explain."""
    parts = ["<h2>Where something is missing</h2>"]
    if drawn := laws_over_efforts(result):
        parts += [_svg(drawn, "What is missing, and the law for it"), _ANY_COURSE]
    sites = result.opened.sites[:MOST]
    rows = [[s.location, s.place.sites[0].stands if s.place else _SENSOR, f"{100 * s.explains:.0f} %"] for s in sites]
    parts.append(_table(["place", "what acts there", "misfit that it could explain"], rows, range(2, 3)))
    parts.append(_PLACES.format(more=len(result.opened.sites) - len(sites)))
    if closed := result.opened.closed:
        rows = "".join(f"<li>{escape(label)}: {escape(why)}</li>" for label, why in closed)
        count = "1 place was" if len(closed) == 1 else f"{len(closed)} places were"
        parts.append(f"<details><summary>{count} not looked at</summary><ul>{rows}</ul></details>")
    return parts


def _findings(result: Explanation) -> list[str]:
    parts, claimed = [], result.verdict != "undetermined"
    for finding, said in zip(result.findings, build(result, None)["findings"], strict=True):
        values = "; ".join(
            f"{n} = {with_error(p['value'], p['std'])} {p['unit'] if p['unit'] != '1' else ''}".rstrip()
            for n, p in said["parameters"].items()
        )
        place = f"({escape(said['effect'])}) at {escape(said['location'])}"
        title = finding.ranked.attachment.effect.title
        title = f"{title}, {in_words(said['form'])}" if "form" in said else title
        equation = said.get("law") or equation_of(result, finding)
        parts.append(
            f"<li><b>{escape(title)}</b> {place}: {escape(unbroken(values))}. "
            f"{_sure(said['odds']) if claimed else ''}Seen as: {escape(said['where']['text'])}."
            f"{code(equation, f'equation of {title}') if equation else ''}</li>"
        )
    head = "What was left out" if claimed else "What would explain the recordings, and is not claimed"
    return [f"<h2>{head}</h2>", f"<ol>{''.join(parts)}</ol>"] if parts else []


def _sure(odds: str) -> str:
    return f"{escape(odds[0].upper() + odds[1:])}. "


def _rivals(result: Explanation) -> list[str]:
    rounds = {id(n): n for n in (*result.namings, *(f.naming for f in result.findings))}
    told = [n for n in rounds.values() if len(n.ranked) > 1 or n.screened or n.unneeded or n.failures]
    return [part for k, naming in enumerate(told) for part in _round(naming, k)]


def _round(naming: Naming, k: int) -> list[str]:
    """What was tried in a round of naming, best first, and what was not."""
    rows = [[named(r), r.score - naming.ranked[0].score, f"{r.confidence:.3f}", len(r.candidate.free), _leaves(r.fit)]
            for r in naming.ranked[:10]]  # fmt: skip
    header = ["what could be missing", "2 ln of the odds behind the best", "probability among these", "parameters",
              "leaves"]  # fmt: skip
    parts = [f"<h2>What else was tried{f', step {k + 1}' if k else ''}</h2>"]
    parts += [_table(header, rows)] if rows else []
    tried = {r.attachment.label for r in naming.ranked}
    others = [(label, share) for label, share in naming.screened if label not in tried][:12]
    rest = ", ".join(f"{label} ({100 * share:.0f} %)" for label, share in others)
    if rest:
        parts.append(f"<p>Not fitted, for they could explain little (share of the misfit): {escape(rest)}.</p>")
    if naming.unneeded:
        rest = escape(", ".join(naming.unneeded))
        parts.append(f"<p>Not looked at, since the best leaves nothing but noise: {rest}.</p>")
    return [*parts, *_failures(naming)]


def _failures(naming: Naming) -> list[str]:
    """Hypotheses that lost without having been tried, and why."""
    if not naming.failures:
        return []
    rows = "".join(f"<li>{escape(label)}: {escape(why.splitlines()[0])}</li>" for label, why in naming.failures)
    return [f"<details><summary>{len(naming.failures)} could not be tried</summary><ul>{rows}</ul></details>"]


def _leaves(fit: Fit) -> str:
    """The signal that a hypothesis explains worst; a finding that lost leaves more, or needs more parameters."""
    worst = max(fit.level, key=lambda c: fit.level[c])
    return f"{fit.level[worst]:.2f} \u00d7 noise in {worst}"


def _parameters(result: Explanation) -> list[str]:
    rows, refitted = [], result.base.point
    for name, p in build(result, None)["parameters"].items():
        flag = "more than 3 sigma from what was believed" if p["outside_belief"] else ""
        before = rounded(refitted[name], p["std"])
        rows.append([name, p["believed"], before, with_error(p["value"], p["std"]), p["unit"], flag])
    header = ["parameter", "believed", "fitted to the believed model", "now, with its 95 % interval", "unit", ""]
    return ["<h2>Parameters</h2>", _table(header, rows, range(1, 4))]


def _left(result: Explanation) -> list[str]:
    left = left_over(result)
    text = (
        "<p>What is left is noise.</p>"
        if not left
        else "<ul>" + "".join(f"<li>{escape(t)}</li>" for t in left) + "</ul>"
    )
    if result.findings and result.reason:
        text += f"<p>Why the search went no further: {escape(result.reason)}.</p>"
    extra = f"<p>To decide: {escape(result.experiment)}.</p>" if result.experiment else ""
    return ["<h2>What remains unexplained</h2>", text + extra, *_trial(result)]


def _trial(result: Explanation) -> list[str]:
    """The recording that would tell the explanations apart, as the first and its hardest rival expect it."""
    if result.trial is None:
        return []
    how = f"<p>Its waveform, a case that reads the recording, and these curves are in {FOLDER}/.</p>"
    return [_svg(picture(result.case, result.trial), "The experiment that decides"), how]
