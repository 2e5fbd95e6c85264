"""More than one law: places of the equations are searched again with the laws found so far in the model.

The first of two laws stands for both as well as it can, at its own place. So once a further one is found at another
place, each earlier one is found anew given the others, and exchanged where that is better.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import combinations

import numpy as np

from lacuna.codegen.library.classes import Library
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.catalogue.trace import left
from lacuna.discovery.efforts.find import INDIFFERENT, Found, add_laws, find, places_of, simplest
from lacuna.discovery.efforts.instruments import theirs
from lacuna.discovery.efforts.located import Site
from lacuna.discovery.fit.evidence import common_correlation, pays
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.law.beyond import MARGIN
from lacuna.discovery.law.empirical_law import simplified
from lacuna.discovery.law.law import Law
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.naming.candidate_fit import without
from lacuna.discovery.naming.comparison import MIN_GAIN, TIE, Ranked, price, said, score, told_by_data
from lacuna.discovery.naming.judge import Judgement, try_judge
from lacuna.discovery.naming.left_out import left_out
from lacuna.discovery.naming.name import Finding, Naming, compete, screen_all
from lacuna.discovery.naming.screen import Candidate
from lacuna.discovery.naming.search import MAX_FINDINGS, Search

Progress = Callable[[str], None]


def go_on(search: Search, library: Library, progress: Progress, places: Found | None = None) -> None:
    """Add laws at other places while the model leaves more than instruments are off by and they pay; find earlier ones
    anew, and drop what these do without. `places` of what is left now may be known."""
    known = len(search.findings)
    while len(search.findings) < MAX_FINDINGS and not theirs(search.fit):
        progress("looking for a law at another place")
        found = places or places_of(search.case, search.amendment, search.fit, library, progress)
        free, places = elsewhere(search.amendment), None
        if is_of_form(found.sites, free):
            break
        add_laws(found, search.case, search.amendment, search.fit, progress, free)
        law = found.laws[0] if found.laws else None
        if law is None:
            break
        if not _pays(search, search.fit, law):
            left(said(law), "unseen", "does not pay beside what was found")
            break
        after = try_judge(law.machine, law.fit.point)
        if after is None:
            break
        search.findings.append(finding(law, search.fit, search.judgement, after))
        search.take([*search.amendment.attachments, law.attachment], law.fit, after)
        for k in range(len(search.findings) - 1):
            _find_anew(search, k, library, progress)
    if len(search.findings) > known:
        search.drop_needless(progress)
    while len(search.findings) > 2 and _one_for_two(search, library, progress):
        pass


def _one_for_two(search: Search, library: Library, progress: Progress) -> bool:
    """Whether one law elsewhere is taken in the place of two findings, where deviance and prices are less: what pulls
    a cage pulls its rope less what turns the sheave, and may have been found as that."""
    taken = {f.ranked.attachment.location for f in search.findings}
    for numbers in combinations(range(len(search.findings)), 2):
        pair = [search.findings[k] for k in numbers]
        amendment, base = _taken_out(search, *numbers)
        if base is None:
            continue
        both = " and ".join(f.ranked.attachment.location for f in pair)
        progress(f"looking for one law in the place of those at {both}")
        law = _best(search, amendment, base, library, progress, lambda site: not any(map(site.place.named, taken)))
        if law is None:
            continue
        correlation = common_correlation([search.fit, law.fit])
        paid_now = sum(
            price(len(f.ranked.candidate.free), base, correlation) + 2 * f.ranked.candidate.pick for f in pair
        )
        present = search.fit.deviance(correlation) + paid_now - base.deviance(correlation)
        after = try_judge(law.machine, law.fit.point) if score(law, base, correlation) < present else None
        if after is not None:
            others = [f for k, f in enumerate(search.findings) if k not in numbers]
            search.findings[:] = [*others, finding(law, base, pair[0].before, after)]
            search.take([*amendment.attachments, law.attachment], law.fit, after)
            return True
    return False


def apart(search: Search, unbegun: Search, single: Candidate, library: Library, progress: Progress) -> None:
    """Take laws at several places instead of one of two groups at one place, where deviance and prices are less: the
    second group of the best place may only stand for what is missing at another one.

    `single` is the best law of one group; `unbegun` is the search that has found nothing.
    """
    progress("looking for laws at two places")
    after = try_judge(single.machine, single.fit.point)
    if after is None:
        return
    trial = replace(unbegun, findings=[finding(single, unbegun.fit, unbegun.judgement, after)], namings=[])
    trial.take([single.attachment], single.fit, after)
    go_on(trial, library, progress)
    if len(trial.findings) > 1:
        take_if_less(search, trial, unbegun.fit)


def find_long_anew(search: Search, library: Library, progress: Progress) -> None:
    """Find each law of several terms anew, a level among them, given the others: it was screened beside an effort of
    any course at their places, and its further terms may stand for what that takes of it."""
    for k, found in enumerate(search.findings):
        if len(found.ranked.attachment.law.groups) > 1:
            _find_anew(search, k, library, progress)


def is_short(finding: Finding) -> bool:
    """Whether a law is of one term, or of one beside a level: one of two ends no search, since its second may stand for
    what is elsewhere."""
    law = finding.ranked.attachment.law
    return isinstance(law, Law) and law.terms == 1


def simplify(search: Search, progress: Progress) -> None:
    """Each of several laws without what it does not need, given the others: terms that stood for what was missing
    elsewhere, before that was found."""
    for k in range(len(search.findings) if len(search.findings) > 1 else 0):
        ranked = search.findings[k].ranked
        law = ranked.attachment.law
        amendment, base = _taken_out(search, k) if isinstance(law, Law) else (search.amendment, None)
        if base is None:
            continue
        progress(f"what is not needed at {ranked.attachment.location}")
        values = ranked.attachment.own_values(search.fit.point)
        present = Proposal(law, values, replace(ranked.candidate, fit=search.fit))
        simpler = simplified(search.case, amendment, base, present)
        if simpler is not present:
            _take_instead(search, k, base, simpler.candidate, 0.0)


def take_if_less(search: Search, trial: Search, base: Fit) -> bool:
    """Take what another search has found where deviance and prices, those of `base` being none, are less."""
    correlation = common_correlation([search.fit, trial.fit])
    if (behind := paid(trial, base, correlation) - paid(search, base, correlation)) >= 0:
        for f in trial.findings:
            law = f.ranked.attachment.said(trial.fit.point)
            left(law, "comparison", f"with what was found beside it {behind:.1f} behind what was found before")
        return False
    search.findings[:] = trial.findings
    search.take(trial.amendment.attachments, trial.fit, trial.judgement)
    search.reason = ""
    return True


def paid(search: Search, base: Fit, correlation: dict[str, float]) -> float:
    """Deviance of what was found, with the price of its parameters and of having been picked among many."""
    added = len(search.fit.estimate.free) - len(base.estimate.free)
    picks = sum(f.ranked.candidate.pick for f in search.findings)
    return search.fit.deviance(correlation) + price(added, base, correlation) + 2 * picks


def _find_anew(search: Search, k: int, library: Library, progress: Progress) -> None:
    """Find law k anew, given the others: taken where deviance and price fall, and clearly so for what has a name."""
    old = search.findings[k].ranked.attachment
    progress(f"looking again at {old.location}")
    amendment, base = _taken_out(search, k)
    if base is None:
        return
    law = _best(search, amendment, base, library, progress, lambda site: site.place.named(old.location))
    if law is not None:
        _take_instead(search, k, base, law, MARGIN if old.effect.identifier != "unknown" else 0.0)


def _take_instead(search: Search, k: int, base: Fit, law: Candidate, margin: float) -> None:
    ranked = Ranked(law, law.fit, score(law, base, law.fit.correlation()), 1.0)
    _exchange(search, k, base, Naming([ranked], []), ranked, margin)


def _taken_out(search: Search, *numbers: int) -> tuple[Amendment, Fit | None]:
    """The amendment without some findings, and the present fit without them."""
    amendment, fit = search.amendment, search.fit
    for old in (search.findings[k] for k in numbers):
        others = [a for a in amendment.attachments if a is not old.ranked.attachment]
        amendment = replace(amendment, attachments=others)
        fit = fit and without(fit, old.ranked, amendment)
    return amendment, fit


def _exchange(search: Search, k: int, base: Fit, naming: Naming, ranked: Ranked, margin: float) -> None:
    """Take a finding in the place of number k where on `base`, which lacks it, it costs less by a margin."""
    old, correlation = search.findings[k], common_correlation([search.fit, ranked.fit])
    present = score(replace(old.ranked.candidate, fit=search.fit), base, correlation)
    if score(ranked.candidate, base, correlation) >= present - margin:
        return
    after = try_judge(ranked.fit.machine, ranked.fit.point)
    if after is not None:
        search.findings[k] = Finding(ranked, naming, old.before, after)
        others = [a for a in search.amendment.attachments if a is not old.ranked.attachment]
        search.take([*others, ranked.attachment], ranked.fit, after)


def among_sensors(search: Search, progress: Progress) -> None:
    """Look at errors of sensors again, in the place of each of several laws; what these do without is dropped."""
    before = list(search.findings)
    for k in range(len(before) if len(before) > 1 else 0):
        _sensor_instead(search, k, progress)
    if any(now is not old for now, old in zip(search.findings, before, strict=True)):
        search.drop_needless(progress)


def _sensor_instead(search: Search, k: int, progress: Progress) -> None:
    """An error of a sensor in the place of law k where, given the others, it costs less: alone it explained little
    beside what else is missing, and a law stood for it as well as one can."""
    old = search.findings[k].ranked.attachment
    if old.variable:
        return
    progress(f"looking at sensors in the place of {old.label}")
    amendment, base = _taken_out(search, k)
    if base is None:
        return
    naming = errors_of_sensors(search, amendment, base, progress)
    if naming.simplest is not None:
        _exchange(search, k, base, naming, naming.simplest, TIE)


def errors_of_sensors(
    search: Search, amendment: Amendment, base: Fit, progress: Progress, only: str = ""
) -> Naming:  # fmt: skip
    """What may be wrong with the sensors, or with `only` that of one variable, beside what `base`, the fit of
    `amendment`, has."""
    every = enumerate_attachments(search.case, amendment.structure, search.effects, amendment)
    errors = [a for a in every if a.variable and only in ("", a.variable)]
    candidates, _ = screen_all(search.case, amendment, errors, base, progress)
    return compete(search.case, candidates, base, progress=progress)


def is_of_form(sites: list[Site], free: Callable[[Site], bool]) -> bool:
    """Whether an effort where a law is already tells what is left better than one at any place that is free: that law
    has another form than what is missing there, and laws elsewhere would stand for the difference."""
    efforts = simplest(sites)
    best = max((s.gain for s in efforts if free(s)), default=-np.inf)
    return max((s.gain for s in efforts if not free(s)), default=-np.inf) > best + INDIFFERENT


def elsewhere(amendment: Amendment) -> Callable[[Site], bool]:
    """Places that have no law yet, nor share a balance with one: both would say what is missing there."""
    taken = {a.location for a in amendment.attachments}

    def free(site: Site) -> bool:
        balances = [part.label for part in site.place.sites[0].parts]
        return not any(map(site.place.named, taken)) and not any(f"der({t})" in b for t in taken for b in balances)

    return free


def _best(
    search: Search, amendment: Amendment, base: Fit, library: Library, progress: Progress,
    admitted: Callable[[Site], bool],
) -> Candidate | None:  # fmt: skip
    found = find(search.case, amendment, base, library, progress, admitted)
    return found.laws[0] if found.laws else None


def _pays(search: Search, before: Fit, law: Candidate) -> bool:
    """Whether a law pays for its numbers, and tells recordings left out better than the model without it."""
    correlation = law.fit.correlation()
    if max(score(law, before, correlation), told_by_data(law, before, correlation)) > -MIN_GAIN:
        return False
    return pays(left_out(search.case, before), left_out(search.case, law.fit), search.floor)


def finding(law: Candidate, base: Fit, before: Judgement, after: Judgement) -> Finding:
    ranked = Ranked(law, law.fit, score(law, base, law.fit.correlation()), 1.0)
    return Finding(ranked, Naming([ranked], []), before, after)
