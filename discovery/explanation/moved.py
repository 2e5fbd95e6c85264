"""One sensor's error instead of several parameters that no machine has.

Where the believed model leaves noise only with parameters outside what is believed of them, the recordings are
explained, but by several beliefs that are all wrong at once. An error of one sensor may leave as much and every
parameter where it was believed. Both are hypotheses of some numbers: a belief that is given up costs what a parameter
of an effect costs.
"""

from __future__ import annotations

from dataclasses import replace

from lacuna.discovery.catalogue.catalogue import Effect
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.fit.evidence import outside_belief, settled
from lacuna.discovery.fit.fit import Fit, fit
from lacuna.discovery.naming.comparison import MIN_GAIN, TIE, Progress, price
from lacuna.discovery.naming.judge import try_judge
from lacuna.discovery.naming.name import Finding, rank
from lacuna.discovery.naming.search import Search


def sensor_instead(search: Search, effects: list[Effect], progress: Progress) -> tuple[str, ...]:
    """Add the error of a sensor to a search that has found nothing, where it explains what two or more parameters
    outside belief would have to; these, or () where nothing is added."""
    base, outside = search.fit, outside_belief(search.fit)
    if len(outside) < 2 or not search.lead.direct or not settled(base):
        return ()
    progress(f"an error of a sensor instead of {' and '.join(outside)}")
    sensors = [e for e in effects if e.attaches == "sensor"]
    attachments = enumerate_attachments(search.case, search.amendment.structure, sensors, search.amendment)
    naming = rank(search.case, search.amendment, attachments, base, progress=progress)
    best = naming.best
    if best is None or not settled(best.fit) or outside_belief(best.fit):
        return ()
    given_up = [_without_belief(base, name, naming.correlation) for name in outside]
    if best.score > min(-MIN_GAIN, min(given_up) - TIE):
        return ()
    after = try_judge(best.candidate.machine, best.fit.point)
    if after is None:
        return ()
    search.findings.append(Finding(best, naming, search.judgement, after))
    search.namings.append(naming)
    search.take([*search.amendment.attachments, best.attachment], best.fit, after)
    return tuple(outside)


def _without_belief(base: Fit, name: str, correlation: dict[str, float]) -> float:
    """Deviance and price, less the base's, of one parameter being anywhere."""
    free = [replace(f, sigma=None) if f.name == name else f for f in base.estimate.free]
    found = fit(base.machine, base.machine.case.fit, base.noise, free, base.fixed, start=base.point)
    if found is None:
        return 0.0
    return found.deviance(correlation) + price(1, base, correlation) - base.deviance(correlation)
