"""report.html: the verdict in one sentence, then everything it rests on; one file without outside references."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
import io
from pathlib import Path
import re

from markupsafe import Markup
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from lacuna.analysis.report.figures.data import drawn_data
from lacuna.analysis.report.page import code, page, table
from lacuna.analysis.report.page import figure as figure_of
from lacuna.discovery.case.cases import Case
from lacuna.discovery.experiment.files import FOLDER
from lacuna.discovery.experiment.picture import picture
from lacuna.discovery.explanation.diagnosis import build, left_over, sentence
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.fit.fit import Fit, noise_of
from lacuna.discovery.law.locate import Located
from lacuna.discovery.naming.judge import Judgement, noise_floor
from lacuna.discovery.naming.name import Naming
from lacuna.drawn import save
from lacuna.written import write_whole

_NRMSE = (
    "<p>Normalised root mean square error: of what is measured and not simulated, over the standard deviation of the "
    "measured signal; <em>unseen</em> are recordings that nothing was fitted to.</p>"
)


def write(result: Explanation, folder: Path, amended: Path | None) -> Path:
    """Write the report of an explanation into `folder`."""
    parts = _problems(result)
    if result.before is not None:
        parts += _quality(result) + _overlays(result)
        parts += _located(result.located) if result.located and result.located.best else []
        parts += _findings(result) + _rivals(result) + _parameters(result) + _left(result)
    if amended is not None:
        parts += ["<h2>The amended model</h2>", code(amended.read_text(encoding="utf-8"), "amended model")]
    action = result.experiment or ""
    return _page(parts, result.case.title, folder, sentence(result), action, result.case.files)


def _page(parts: list[str], title: str, folder: Path, verdict: str, action: str, inputs: Sequence[Path]) -> Path:
    path = folder / "report.html"
    write_whole(path, page(title, Markup("\n".join(parts)), verdict=verdict, action=action, inputs=inputs))
    return path


def _table(header: list[str], rows: list[list[object]]) -> str:
    return table(header, ([f"{c:.4g}" if isinstance(c, float) else str(c) for c in row] for row in rows))


def _svg(drawn: plt.Figure, title: str) -> str:
    buffer = io.StringIO()
    data = drawn_data(drawn)
    save(drawn, buffer, "svg", bbox_inches="tight")
    plt.close(drawn)
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
    header = ["signal", "unseen: before", "after", "noise floor", "fitted: before", "after"]
    note = "<p><em>Before</em> is the believed model with its parameters already refitted.</p>"
    return ["<h2>How well it fits</h2>", _table(header, rows), _NRMSE, note]


def _overlays(result: Explanation) -> list[str]:
    name = result.case.validate[0].name
    curves = [("believed", "C3", result.before.residuals[name])]
    if result.findings:
        curves.append(("amended", "C0", result.after.residuals[name]))
    return _overlay(result.case, curves)


def _overlay(case: Case, curves: list[tuple[str, str, dict[str, np.ndarray]]]) -> list[str]:
    """The first validation recording and simulations of it: (label, colour, residual of each column)."""
    recording = case.validate[0]
    size = (11, 2.1 * len(case.outputs))
    figure, axes = plt.subplots(len(case.outputs), 2, figsize=size, sharex=True, squeeze=False)
    keep = slice(None, None, max(1, len(recording.time) // 1500))
    for (ax, beside), signal in zip(axes, case.outputs, strict=True):
        measured = recording.columns[signal.column]
        ax.plot(recording.time[keep], measured[keep], "0.6", lw=1, label="measured")
        for label, colour, residual in curves:
            ax.plot(recording.time[keep], (measured - residual[signal.column])[keep], colour, lw=1, label=label)
            beside.plot(recording.time[keep], residual[signal.column][keep], colour, lw=0.7)
        ax.set_ylabel(f"{signal.column} / {signal.si_unit}")
    axes[0, 0].legend(loc="upper right", fontsize="small")
    axes[0, 1].set_title("measured minus simulated", fontsize="medium")
    for ax in axes[-1]:
        ax.set_xlabel("time / s")
    figure.tight_layout()
    return [
        f"<h2>On a recording that nothing was fitted to ({escape(recording.name)})</h2>",
        _svg(figure, f"Measured and simulated: {recording.name}"),
    ]


def write_judgement(case: Case, judged: Judgement, folder: Path, model: Path) -> Path:
    """The page of one judged model file: its errors and its course on a validation recording."""
    floor = noise_floor(case, case.validate, noise_of(case))
    rows = [[c or "all", judged.validate[c], floor.get(c, ""), judged.fit[c]] for c in judged.validate]
    parts = _overlay(case, [(model.name, "C0", judged.residuals[case.validate[0].name])])
    parts += ["<h2>How well it fits</h2>", _table(["signal", "unseen", "noise alone", "fitted"], rows), _NRMSE]
    noise = float(np.sqrt(np.mean(np.square(list(floor.values())))))
    verdict = (
        f"As it is written, {model.name} misses the recordings that nothing was fitted to by "
        f"{100 * judged.validate['']:.3g} % of how much they vary; noise alone would be {100 * noise:.3g} %."
    )
    action = f"lacuna explain {case.folder.name} says whether what is left is physics that the equations lack"
    return _page(parts, f"{case.title}: {model.name}", folder, verdict, action, (*case.files, model))


def _located(located: Located) -> list[str]:
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3))
    best, found = located.best, located.organiser
    for name, (time, effort) in best.effort.items():
        left.plot(time, effort, lw=1, label=name)
    left.set_xlabel("time / s")
    left.set_ylabel(f"missing {best.kind} at {best.location} / {best.unit}")
    left.legend(fontsize="x-small")
    _regime(right, located)
    right.set_ylabel(f"{best.kind} / {best.unit}")
    figure.tight_layout()
    rows = [[p.location, p.kind, f"{p.explained:.1%}"] for p in located.places]
    said = found.sentence
    note = f"<p>{escape(said[0].upper() + said[1:])}. Fast changes show smaller than they are.</p>"
    return [
        "<h2>Where effort is missing</h2>",
        _table(["place", "effort", "misfit explained"], rows),
        note,
        _svg(figure, f"Missing {best.kind} at {best.location}"),
    ]


def _regime(ax: plt.Axes, located: Located) -> None:
    """The effort over what organises it: a curve or a loop over a variable, a spectrum over an angle's orders."""
    found = located.organiser
    if found.kind == "orders":
        ax.bar(found.centres, found.means, color="C0")
        ax.set_xlabel(f"order of {found.variable} (periods a turn)")
        return
    keep = slice(None, None, max(1, len(located.values) // 3000))
    ax.plot(located.values[keep], located.effort[keep], ".", ms=2, color="0.6", label="samples")
    over = found.centres if found.kind == "value" else np.sort(located.values)
    mean = found.means if found.kind == "value" else np.interp(np.sign(over), found.centres, found.means)
    ax.plot(over, mean, "C0-", lw=2, label="mean")
    ax.legend(fontsize="x-small")
    ax.set_xlabel(f"{found.variable} / {found.unit}")


def _findings(result: Explanation) -> list[str]:
    rows = []
    for f in build(result, None)["findings"]:
        values = ", ".join(
            f"{n} = {p['value']:.5g} {_within(p['std'])} {p['unit']}" for n, p in f["parameters"].items()
        )
        said = f"{escape(f['location'])}, confidence {f['confidence']:.2f}: {values}. {escape(f['where']['text'])}"
        rows.append(f"<li><b>{escape(f['effect'])}</b> at {said}.</li>")
    return ["<h2>What was left out</h2>", f"<ol>{''.join(rows)}</ol>"] if rows else []


def _rivals(result: Explanation) -> list[str]:
    parts = []
    for k, naming in enumerate(result.namings):
        rows = [[r.attachment.label, r.score - naming.ranked[0].score, f"{r.confidence:.3f}", len(r.candidate.free),
                 _leaves(r.candidate.fit)] for r in naming.ranked[:10]]  # fmt: skip
        header = ["hypothesis", "evidence behind the best", "confidence", "parameters", "leaves"]
        parts += [f"<h2>Hypotheses fitted, round {k + 1}</h2>", _table(header, rows)]
        tried = {r.attachment.label for r in naming.ranked}
        others = [(label, share) for label, share in naming.screened if label not in tried][:12]
        rest = ", ".join(f"{label} ({share:.0%})" for label, share in others)
        if rest:
            parts.append(f"<p>Screened out (share of the misfit they could explain): {escape(rest)}.</p>")
        parts += _failures(naming)
    return parts


def _failures(naming: Naming) -> list[str]:
    """Hypotheses that lost without having been tried, and why."""
    if not naming.failures:
        return []
    rows = "".join(f"<li>{escape(label)}: {escape(why.splitlines()[0])}</li>" for label, why in naming.failures)
    return [f"<details><summary>{len(naming.failures)} could not be tried</summary><ul>{rows}</ul></details>"]


def _leaves(fit: Fit) -> str:
    """The signal that a hypothesis explains worst; a finding that lost leaves more, or needs more parameters."""
    worst = max(fit.level, key=lambda c: fit.level[c])
    return f"{fit.level[worst]:.2f} x noise in {worst}"


def _within(std: float | None) -> str:
    """The half width of a 95 % interval; a direction that the data says nothing of has no end."""
    return "(not determined)" if std is None or not np.isfinite(std) else f"\u00b1 {1.96 * std:.2g}"


def _parameters(result: Explanation) -> list[str]:
    rows, refitted = [], result.base.point
    for name, p in build(result, None)["parameters"].items():
        flag = "outside belief" if p["outside_belief"] else ""
        rows.append([name, p["believed"], refitted[name], p["value"], _within(p["std"]), p["unit"], flag])
    return [
        "<h2>Parameters</h2>",
        _table(["parameter", "believed", "refitted before", "after", "95 %", "unit", ""], rows),
    ]


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
