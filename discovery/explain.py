"""The loop: fit, locate, name, amend, judge, until what is left is noise; then the diagnosis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
import time

import numpy as np

from codegen.library import Library

from . import catalogue, places
from .amend import Amendment
from .beyond import consider
from .cases import Case
from .evidence import is_noise, like_noise, outside_belief, whiteness
from .experiments import Experiment, separate
from .fit import Fit, bandwidths_for, believed, fit, noise_of
from .judge import Judgement, judge, judge_file, noise_floor
from .locate import Located, locate
from .machine import Machine
from .name import Naming, Ranked
from .recordings_check import Problem, check_case
from .search import Finding, Search, tracked
from .semantic_check import check_against_model
from .tracking import trackable

Progress = Callable[[str], None]


@dataclass
class Explanation:
    """Everything that is known about a case in the end; diagnosis.json and the report are written from it."""

    case: Case
    problems: list[Problem]
    verdict: str = "undetermined"
    reason: str = ""
    experiment: str = ""
    trial: Experiment | None = None  # the recording that would separate tied explanations, simulated
    base: Fit | None = None
    final: Fit | None = None
    amendment: Amendment | None = None
    findings: list[Finding] = field(default_factory=list)
    namings: list[Naming] = field(default_factory=list)
    located: Located | None = None
    before: Judgement | None = None
    after: Judgement | None = None
    floor: dict[str, float] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)


class _Clock:
    """Seconds of each step."""

    def __init__(self, seconds: dict[str, float]):
        self.seconds, self.last = seconds, time.perf_counter()

    def done(self, step: str) -> None:
        now = time.perf_counter()
        self.seconds[step] = self.seconds.get(step, 0.0) + now - self.last
        self.last = now


def explain(case: Case, progress: Progress = lambda text: None, library: Library | None = None) -> Explanation:
    """Explain a case. Raises CaseError where model and case do not fit, Diagnostic where the model is wrong."""
    result = Explanation(case, check_case(case))
    if any(p.fatal for p in result.problems):
        result.reason = "the recordings cannot be trusted: " + "; ".join(str(p) for p in result.problems if p.fatal)
        return result
    clock = _Clock(result.seconds)
    library = library or Library()
    structure = places.read(library, case.model)
    effects = catalogue.read(library)
    machine = _believed_machine(case, structure)
    result.problems += check_against_model(machine, believed(case, machine))
    if any(p.fatal for p in result.problems):
        result.reason = "the recordings contradict themselves: " + "; ".join(str(p) for p in result.problems if p.fatal)
        return result
    progress("fitting the believed model")
    result.base, bandwidths = fit_believed(case, machine)
    result.amendment, result.final = machine.amendment, result.base
    result.before = result.after = judge(machine, result.base.point)
    result.floor = noise_floor(case, case.validate, result.base.noise)
    clock.done("fit")
    if not is_noise(result.base):
        progress("locating the missing effort")
        result.located = locate(case, tracked(result.base, bandwidths))
        clock.done("locate")
    search = Search(
        case, effects, bandwidths, result.floor, result.amendment, result.final, result.after,
        result.findings, result.namings,
    )  # fmt: skip
    search.run(progress)
    consider(search, result.base, result.before, progress)
    result.amendment, result.final, result.after = search.amendment, search.fit, search.judgement
    result.reason = search.reason
    clock.done("name")
    _conclude(result)
    return result


def _believed_machine(case: Case, structure: places.Structure) -> Machine:
    """The believed model; with trackers on recorded shafts where its events make a fit rough."""
    machine = Machine(case, Amendment(structure))
    free, fixed = believed(case, machine)
    shafts = trackable(case, machine.model, structure)[:1]
    values = fixed | {f.name: f.centre for f in free}
    if not shafts or machine.events_per_second(values, case.fit[0]) < 20:
        return machine
    return Machine(case, Amendment(structure, trackers=shafts))


def fit_believed(case: Case, machine: Machine) -> tuple[Fit, tuple[float, ...]]:
    """The believed model's best fit from several starts, and the bandwidths that lead fits of this model."""
    noise = noise_of(case)
    free, fixed = believed(case, machine)
    bandwidths = bandwidths_for(case, machine, fixed | {f.name: f.centre for f in free})
    best = fit(machine, case.fit, noise, free, fixed, bandwidths=bandwidths)
    if best is not None and is_noise(best):
        return best, bandwidths
    random = np.random.default_rng(1)
    start = {f.name: f.clip(f.centre + f.scale * float(random.normal())) for f in free}
    other = (
        fit(machine, case.fit, noise, free, fixed, start=start, bandwidths=bandwidths) if len(bandwidths) < 2 else None
    )
    if other is not None and (best is None or other.deviance() < best.deviance()):
        best = other
    if best is None:
        raise RuntimeError(f"{case.model} cannot be simulated with the recorded inputs of {case.label}")
    return best, bandwidths


def _conclude(result: Explanation) -> None:
    """The verdict, from the findings, the whiteness of what is left and the believed parameters."""
    left = [w for w in whiteness(result.final).values() if not w.passed]
    if result.findings:
        first = result.findings[0]
        rivals = first.naming.rivals(first.ranked)
        if rivals and first.ranked.confidence < 0.5:
            result.verdict = "undetermined"
            names = ", ".join(dict.fromkeys(r.attachment.label for r in rivals[:3]))
            result.reason = f"{first.ranked.attachment.label} and {names} explain the data equally well"
            result.trial = separate(result.case, first.ranked.fit, rivals[0].fit)
            labels = (first.ranked.attachment.label, rivals[0].attachment.label)
            result.experiment = result.trial.sentence(labels) if result.trial else experiment_for(first.ranked, rivals)
        else:
            result.verdict = "missing_physics"
        return
    outside = outside_belief(result.base)
    if left and not like_noise(result.final):
        result.verdict = "undetermined"
        worst = max(left, key=lambda w: w.ratio / w.limit)
        result.reason = result.reason or (
            f"the residual of {worst.column} is not noise, and no effect of the catalogue explains it"
        )
        result.experiment = "record the same motion with the quantities that are not recorded now"
    else:
        result.verdict = "parameters" if outside else "consistent"


def experiment_for(best: Ranked, rivals: list[Ranked]) -> str:
    """What to record so that tied hypotheses part: the excitation that the catalogue asks for each of them."""
    wanted = dict.fromkeys(
        r.attachment.effect.excitation for r in [best, *rivals[:2]] if r.attachment.effect.excitation
    )
    return "record: " + "; ".join(wanted)


def amended_name(case: Case) -> str:
    return case.model.rsplit(".", 1)[-1].removesuffix(".mo") + "Amended"


def write_amended(result: Explanation, folder: Path) -> Path | None:
    """The amended model as a readable file; None where nothing is amended."""
    if not result.findings:
        return None
    believed_names = {f.name for f in result.base.estimate.free} | set(result.base.fixed)
    point = result.final.point
    parameters = {n: point[n] for n in believed_names if n in point and not n.startswith("start:")}
    amendment = replace(result.amendment, parameters=dict(sorted(parameters.items())), trackers=[])
    name = amended_name(result.case)
    effects = {k: v for k, v in point.items() if k not in believed_names}
    titles = ", ".join(f.ranked.attachment.effect.title.lower() for f in result.findings)
    path = folder / f"{name}.mo"
    partial = path.with_suffix(".tmp")
    partial.write_text(amendment.text(name, effects, f"{result.case.model} with {titles}"), encoding="utf-8")
    partial.replace(path)
    return path


def judge_written(result: Explanation, path: Path) -> None:
    """Judge the amended file as it is written: its own numbers are those that are reported."""
    starts = {n: v for n, v in result.final.point.items() if n.startswith("start:")}
    result.after = judge_file(result.case, result.amendment, path, starts)
    result.findings[-1] = replace(result.findings[-1], after=result.after)
