"""When the catalogue is not enough: an empirical law instead of what was found, or beside it.

A law takes the place of findings only where it leaves noise and the evidence is clearly for it: an effect of the
catalogue, which has a name and a reason, is the better answer to the same residual.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lacuna.discovery.fit.evidence import common_correlation, like_noise, nearly_noise, pays
from lacuna.discovery.fit.fit import Fit, carried
from lacuna.discovery.law.empirical_law import GROUPS, find
from lacuna.discovery.naming.comparison import MIN_GAIN, Ranked, price, score
from lacuna.discovery.naming.judge import try_judge
from lacuna.discovery.naming.left_out import left_out
from lacuna.discovery.naming.name import Finding, Naming
from lacuna.discovery.naming.screen import Candidate
from lacuna.discovery.naming.search import Search

SHORT = 3  # parameters of a law that needs no margin over several effects
MARGIN = 40.0  # of the deviance, by which a law has to beat effects of the catalogue that leave as little

Progress = Callable[[str], None]


def explain_beyond(search: Search, unbegun: Search, progress: Progress) -> None:
    """Go on with a search after its first round; then a law in place of its findings or beside them.

    `unbegun` is a search that has found nothing: the believed model, and how fits of laws instead of findings are led.
    Where several effects together leave noise, one group of terms is tried that could stand for them all; where they do
    not, longer laws too.
    """
    if search.settled() or like_noise(unbegun.fit):
        return
    search.run(progress)
    if search.findings and like_noise(search.fit):
        return
    explained = bool(search.findings) and (search.settled() or nearly_noise(search.fit))
    if explained and len(search.findings) == 1:
        return
    progress("looking for an empirical law")
    held = unbegun.lead.hold(unbegun.fit)
    law = find(held.machine.case, unbegun.amendment, held, progress, most=1 if explained else GROUPS)
    if law is not None and _instead(search, unbegun, held, law):
        return
    if search.findings and not explained:
        _beside(search, progress)


def _beside(search: Search, progress: Progress) -> None:
    """A law for what the findings leave."""
    progress("looking for an empirical law beside what was found")
    start = search.lead.hold(search.fit)
    candidate = find(start.machine.case, search.amendment, start, progress)
    if candidate is None or score(candidate, start, candidate.fit.correlation()) > -MIN_GAIN:
        return
    ranked = _ranked(candidate, start)
    polished = search.polished(ranked, search.fit)
    after = try_judge(polished.machine, polished.point) if polished is not None else None
    if after is not None and _tells(search, search.fit, polished):
        ranked.fit = polished
        search.findings.append(Finding(ranked, Naming([ranked], []), search.judgement, after))
        search.take([*search.amendment.attachments, candidate.attachment], polished, after)
        search.drop_needless(progress)  # it may only have helped the findings out of a dip


def _instead(search: Search, unbegun: Search, held: Fit, law: Candidate) -> bool:
    """One law for all of the misfit of the believed model, in place of every finding."""
    if not (nearly_noise(law.fit) or like_noise(law.fit)):
        return False
    correlation = common_correlation([law.fit, search.fit])
    gain = score(law, held, correlation)
    found = search.findings and _found(search, unbegun, held, correlation) - margin(search, law)
    if gain > -MIN_GAIN or (search.findings and gain > found):
        return False
    ranked = _ranked(law, held)
    polished = unbegun.polished(ranked, unbegun.fit)
    after = try_judge(polished.machine, polished.point) if polished is not None else None
    if after is None or not _tells(search, unbegun.fit, polished):
        return False
    ranked.fit = polished
    search.findings[:] = [Finding(ranked, Naming([ranked, *_others(search)], []), unbegun.judgement, after)]
    search.take([law.attachment], polished, after)
    search.reason = ""
    return True


def margin(search: Search, law: Candidate) -> float:
    """Of the deviance, by which a law has to beat what a search has found: none for a short one against several."""
    return 0.0 if len(law.free) <= SHORT and len(search.findings) > 1 else MARGIN


def _tells(search: Search, before: Fit, after: Fit) -> bool:
    return pays(left_out(search.case, before), left_out(search.case, after), search.floor)


def _found(search: Search, unbegun: Search, held: Fit, correlation: dict[str, float]) -> float:
    """What the findings of the catalogue score against the believed model, their shafts held as a law's are."""
    amendment = replace(search.amendment, trackers=unbegun.amendment.trackers)
    machine = search.fit.machine.amended(amendment, search.case)
    there = carried(search.fit, machine, stages=1, iterations=0) or search.fit
    found = unbegun.lead.hold(there, held)
    added = {f.name for f in found.estimate.free} - {f.name for f in held.estimate.free}
    return found.deviance(correlation) + price(len(added), held, correlation) - held.deviance(correlation)


def _ranked(candidate: Candidate, base: Fit) -> Ranked:
    return Ranked(candidate, candidate.fit, score(candidate, base, candidate.fit.correlation()), 1.0)


def _others(search: Search) -> list[Ranked]:
    """What the first round tried: the law's rivals, none of which leaves noise."""
    return [replace(r, confidence=0.0) for r in search.namings[0].ranked] if search.namings else []
