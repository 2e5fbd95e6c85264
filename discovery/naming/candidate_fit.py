"""The models of hypotheses, and their fits: the base's parameters and the effect's together, from a screened start.

Hypotheses share a model while they are screened, for to compile one costs more than the few runs of a first look. An
error of a sensor acts on its own reading alone, and an effect of which there is nothing yet, its parameters neutral, on
nothing at all: so each is seen by itself in a model that holds them all.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lacuna.codegen.errors import Diagnostic
from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.fit.fit import Fit, fit, linearised
from lacuna.discovery.fit.machine import Machine, try_machine
from lacuna.discovery.fit.objective import Objective
from lacuna.discovery.fit.solver.free import Free, pulls
from lacuna.discovery.fit.starts import in_doubt
from lacuna.discovery.naming.comparison import Progress, Ranked
from lacuna.discovery.naming.screen import Candidate

SMALL_STEP = 0.1  # of a start that is predicted to first order, which may still hold where the whole of it does not


def fit_candidate(
    case: Case, base: Fit, stages: int, iterations: int, progress: Progress, candidate: Candidate
) -> Fit | None:  # fmt: skip
    """Fit the base's parameters and the effect's together, from the screened start; what has settled stays."""
    if candidate.fit is not None and candidate.fit.settled:
        return candidate.fit
    progress(f"fitting {candidate.attachment.label}")
    believed = in_doubt(base.machine, base.estimate.free, candidate.attachment.variable)
    free: list[Free] = [*believed, *candidate.free]
    start = candidate.fit.point if candidate.fit is not None else _start(case, base, candidate)
    fixed = base.fixed | candidate.fixed
    return fit(
        candidate.machine, case.fit, base.noise, free, fixed, start=start, stages=stages, iterations=iterations,
        known=(candidate.fit or base).sensitivities(),
    )  # fmt: skip


def _start(case: Case, base: Fit, candidate: Candidate) -> dict[str, float]:
    """The screened start that misses by least: the base's parameters as they are, or as they would go with the effect,
    or only a little of both."""
    full = base.point | candidate.shift | candidate.start
    return nearest(case, base, candidate, base.point | candidate.start, full, _small_step(base, candidate, full))


def nearest(case: Case, base: Fit, candidate: Candidate, *starts: dict[str, float]) -> dict[str, float]:
    """Of these starts the one where the candidate misses the data, and leaves beliefs, by least; the first where it
    runs from none: a base without what is missing may have gone where no machine is."""
    objective = Objective(candidate.machine, case.fit, base.noise)
    weights, believed = objective.weights(base.level), base.estimate.free

    def missed(start: dict[str, float]) -> float:
        residual, full = objective.weighted(start | candidate.fixed, weights), base.point | start
        leaves = pulls(believed, np.array([full[f.name] for f in believed]))
        with np.errstate(over="ignore"):  # a run that goes away misses by any number
            return float("inf") if residual is None else float(residual @ residual + leaves @ leaves)

    return min(starts, key=missed)


def _small_step(base: Fit, candidate: Candidate, full: dict[str, float]) -> dict[str, float]:
    """A little of the way from the base without the effect to a start; what has no neutral value stays."""
    attachment = candidate.attachment
    neutral = {attachment.full_name(n): v for n, v in attachment.effect.neutral.items()}
    without = full | {n: v for n, v in neutral.items() if n in full} | base.point
    return {n: without[n] + SMALL_STEP * (v - without[n]) for n, v in full.items()}


def own_machine(
    case: Case, amendment: Amendment, attachment: Attachment, base: Fit
) -> tuple[Machine | None, str]:  # fmt: skip
    """The machine with this hypothesis alone; None with the reason where there is no such model."""
    return try_machine(case, replace(amendment, attachments=[*amendment.attachments, attachment]), base.machine)


def shared(case: Case, amendment: Amendment, attachments: list[Attachment], base: Fit) -> dict[str, Machine]:
    """By label, the machine in which a hypothesis can be seen beside others; those that need their own are missing: all
    that would be added, where one of them cannot be simulated (a spring at a shaft that turns on and on)."""
    sensors = tuple(a for a in attachments if a.variable and a.effect.neutral)  # a lag may be stiff where all is slow
    silent = list({a.component: a for a in attachments if _is_silent(a)}.values())
    for added in (silent, []):
        whole = replace(amendment, attachments=[*amendment.attachments, *added], beside=sensors)
        if len(added) + len(sensors) < 2:
            return {}
        machine, _ = try_machine(case, whole, base.machine)
        if machine is not None and all(machine.simulate(base.point, r) is not None for r in machine.case.fit):
            read = {a.label: try_machine(case, replace(whole, seen=a), base.machine)[0] for a in sensors}
            return dict.fromkeys((a.label for a in added), machine) | read
    return {}


def _is_silent(attachment: Attachment) -> bool:
    """Whether the effect only adds a torque, and none as it is declared: voltages that are added close loops, and a run
    with those is as dear as a model of its own."""
    effect = attachment.effect
    neutral = bool(effect.neutral) and all(effect.parameter(n).default == v for n, v in effect.neutral.items())
    return effect.attaches == "flange" and neutral and not effect.friction


def without(found: Fit, ranked: Ranked, amendment: Amendment, stages: int = 0) -> Fit | None:
    """The model of `amendment`, which lacks this effect: fitted anew in so many stages, or with all else left where it
    is (what is missing then is that effect). None where it is no model, or cannot be simulated: another law is a
    function of what this one computes."""
    prefix = f"{ranked.attachment.component}."
    free = [f for f in found.estimate.free if not f.name.startswith(prefix)]
    fixed = {n: v for n, v in found.fixed.items() if not n.startswith(prefix)}
    try:
        machine = found.machine.amended(amendment)
    except Diagnostic:
        return None
    recordings = machine.case.fit
    if not stages:
        return linearised(machine, recordings, found.noise, free, fixed, found.point)
    return fit(machine, recordings, found.noise, free, fixed, start=found.point, stages=stages)
