"""The loop: fit, locate, name, amend, judge, until what is left is noise; then the diagnosis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
import time

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Case
from lacuna.discovery.case.values import is_parameter
from lacuna.discovery.catalogue.modifications import unsubscripted
from lacuna.discovery.catalogue.trace import traced
from lacuna.discovery.experiment.proposal import propose
from lacuna.discovery.explanation.conclusion import conclude
from lacuna.discovery.explanation.contenders import contenders
from lacuna.discovery.explanation.explanation import Clock, Explanation
from lacuna.discovery.fit.evidence import is_noise
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.so_far import telling
from lacuna.discovery.fit.solver.time_limit import within
from lacuna.discovery.naming.comparison import is_better
from lacuna.discovery.naming.judge import judge_file
from lacuna.discovery.steps import add_effort, add_findings, add_fit, add_location, add_scatter, opened
from lacuna.written import write_whole

Progress = Callable[[str], None]


def explain(
    case: Case, progress: Progress = lambda text: None, library: Library | None = None, limit: float | None = None
) -> Explanation:
    """Explain a case; after `limit` seconds no search goes on, and what was found stands. Fit and location always end.

    Raises CaseError where model and case do not fit, Diagnostic where the model is wrong.
    """
    begun = time.monotonic()
    library = library or case.library()
    result, machine = opened(case, library)
    if machine is None:
        return result
    clock = Clock(result.seconds)
    add_fit(result, machine, progress)
    clock.done("fit")
    if not is_noise(result.base):
        add_location(result, progress)
        clock.done("locate")
    with within(limit, begun), traced() as result.trace, telling(progress, is_better) as tell:
        add_findings(result, library, tell)
        add_scatter(result, tell)
    clock.done("name")
    conclude(result)
    add_effort(result, progress)
    _advise(result, progress)
    clock.done("next experiment")
    return result


def _advise(result: Explanation, progress: Progress) -> None:
    """What to do next: the recording that decides; no recording where the search has not seen all there are."""
    if result.stopped and result.verdict == "undetermined":
        until_then = f"; until then: {result.reason}" if result.reason != result.stopped else ""
        result.reason = result.stopped + until_then
        result.experiment = "explain the case again with a longer limit (--limit): the recordings may be enough"
        return
    result.trial = propose(result.case, contenders(result), progress)
    result.experiment = result.trial.sentence() if result.trial else result.experiment


def amended_name(case: Case) -> str:
    return case.base.rsplit(".", 1)[-1] + "Amended"


def write_amended(result: Explanation, folder: Path) -> Path | None:
    """The amended model as a readable file: the believed one as fitted where nothing is missing; None without a fit."""
    if result.final is None:
        return None
    believed_names = {f.name for f in result.base.estimate.free} | set(result.base.fixed)
    point = result.final.point
    parameters = {n: point[n] for n in believed_names if n in point and is_parameter(n)}
    parameters = _whole_arrays(parameters, result.final)
    amendment = replace(result.amendment, parameters=dict(sorted(parameters.items())), trackers=[])
    name = amended_name(result.case)
    effects = {k: v for k, v in point.items() if k not in believed_names}
    titles = ", ".join(f.ranked.attachment.effect.title.lower() for f in result.findings)
    path = folder / f"{name}.mo"
    comment = f"{result.case.model} with {titles or 'fitted parameters'}"
    write_whole(path, amendment.text(name, effects, comment))
    _beside(result.case, folder)
    return path


def _whole_arrays(parameters: dict[str, float], found: Fit) -> dict[str, float]:
    """With the elements of arrays that are not among them: an array is modified as a whole."""
    arrays = {unsubscripted(n) for n in parameters if "[" in n}
    known = found.machine.constants(found.point) if arrays else {}
    return {n: v for n, v in known.items() if "[" in n and unsubscripted(n) in arrays} | parameters


def _beside(case: Case, folder: Path) -> None:
    """The file that holds the believed model, put beside the amended one, so that both open together."""
    file = case.found.file if case.found else None
    if file is not None and file.parent != folder.resolve():
        write_whole(folder / file.name, file.read_bytes())


def judge_written(result: Explanation, path: Path) -> None:
    """Judge the amended file as it is written: its own numbers are those that are reported."""
    if not result.findings:
        return
    starts = {n: v for n, v in result.final.point.items() if not is_parameter(n)}
    result.rejudge(judge_file(result.case, result.amendment, path, starts))
