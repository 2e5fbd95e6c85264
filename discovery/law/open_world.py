"""Where the catalogue's own places do not explain the recordings: every place of the equations, and a law there.

A law found so stands instead of what the catalogue gave where it leaves less, its numbers paid for, and tells
recordings of the fit set that it was not fitted to better than no law does.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lacuna.codegen.library.classes import Library
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.catalogue.trace import left
from lacuna.discovery.efforts.find import WORTH, Found, add_laws, alike, alike_first, is_family, places_of, simplest
from lacuna.discovery.efforts.instruments import only_instruments, theirs
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.fit.evidence import (
    FAR,
    LEAST_TAKEN,
    common_correlation,
    excess,
    like_noise,
    nearly_noise,
)
from lacuna.discovery.law.beyond import margin
from lacuna.discovery.law.together.joining import two_places
from lacuna.discovery.law.together.pairs import Place, paired
from lacuna.discovery.law.together.several import (
    among_sensors,
    apart,
    find_long_anew,
    go_on,
    is_short,
    simplify,
    take_if_less,
)
from lacuna.discovery.law.together.unheard import beside_error, to_be_left_out
from lacuna.discovery.naming.comparison import (
    MIN_GAIN,
    TIE,
    Ranked,
    confidences,
    left_out_deviance,
    note_losers,
    price,
    said,
    score,
    told_by_data,
)
from lacuna.discovery.naming.judge import try_judge
from lacuna.discovery.naming.name import Finding, Naming, screen_all
from lacuna.discovery.naming.race import HALF
from lacuna.discovery.naming.screen import Candidate
from lacuna.discovery.naming.search import UNTOLD, Search
from lacuna.runtime import SimulationError

Progress = Callable[[str], None]


def begun_open(unbegun: Search, library: Library, progress: Progress) -> Found | None:
    """The places of the equations, looked at first where the catalogue knows none but sensors: those of which an error
    of any course leaves far more power than an effort at one place does need not be tried, as where the sensor is wrong
    it leaves about as little. None where the catalogue knows others."""
    case, structure = unbegun.case, unbegun.amendment.structure
    known = enumerate_attachments(case, structure, unbegun.effects, unbegun.amendment)
    if not unbegun.lead.direct or not known or not all(a.variable for a in known):
        return None
    found = places_of(case, unbegun.amendment, unbegun.fit, library, progress)
    best = max((s.explains for s in found.sites if s.place is not None), default=0.0)
    beaten = {s.location for s in found.sites if s.place is None and 1.0 - s.explains > FAR * (1.0 - best)}
    unbegun.blameless = frozenset(s.variable for s in case.outputs if f"sensor:{s.column}" in beaten)
    return found


def equations_first(unbegun: Search, found: Found, progress: Progress) -> bool:
    """Whether no error of a sensor, all that the catalogue knows, promises as much as a finding has to take away, and
    none of any course leaves as little as an effort at one place of the equations: laws are then looked for before such
    errors, which could but stand for them."""
    efforts, case, amendment = simplest(found.sites), unbegun.case, unbegun.amendment
    if not efforts or any(alike(s, efforts[0]) for s in found.sites if s.place is None):
        return False
    every = enumerate_attachments(case, amendment.structure, unbegun.effects, amendment)
    errors = [a for a in every if a.variable not in unbegun.blameless]
    promising, _ = screen_all(case, amendment, errors, unbegun.fit, progress)
    return all(c.predicted < LEAST_TAKEN for c in promising)


def explain_open(
    search: Search, unbegun: Search, library: Library, progress: Progress, places: Found | None,
    located: Callable[[Found], None],
) -> None:  # fmt: skip
    """Locate and explain what `unbegun`, the believed model, lacks, unless `search` has explained it in its equations;
    where what it found there leaves more than noise, laws at other places beside it. `places` may be known already;
    `located` is told of them as soon as they are, since the time may be up before a law is found.
    Where several effects explain it, they may stand for one law that the catalogue does not have. Of what instruments
    may leave by themselves only the best place is asked.

    Of no use where one has explained it, or where fits need shafts held near their motion: those are left to the
    catalogue.
    """
    if not unbegun.lead.direct or unbegun.amendment.trackers or _is_quiet(unbegun):
        return
    explained = search.settled() or theirs(search.fit)
    explained = explained and any(not f.ranked.attachment.variable for f in search.findings)
    if explained and len(search.findings) == 1:
        return
    found = places or places_of(search.case, unbegun.amendment, unbegun.fit, library, progress)
    located(found)
    hidden = only_instruments(search.case, unbegun.amendment, unbegun.fit)  # an effort says no more, a law hardly may
    most = 1 if hidden else alike_first(found)
    only = explained or hidden  # a law counts then, if it is short
    add_laws(found, search.case, unbegun.amendment, unbegun.fit, progress, most=most, short=only)
    if only:
        if found.short:
            _take(search, unbegun, found, progress)
        return
    pair = _pair(search, found, progress)
    if _beside_error(search, unbegun, found, pair, library, progress):
        return
    told = pair is not None and pair[1].site.explains > WORTH
    two = _two(unbegun, found, pair, library, progress) if told else None
    short = two is not None and theirs(two.fit) and all(map(is_short, two.findings))
    if not (short and take_if_less(search, two, unbegun.fit)):
        _one_by_one(search, unbegun, found, None if told else pair, library, progress)
        if two is not None:
            take_if_less(search, two, unbegun.fit)
    among_sensors(search, progress)
    simplify(search, progress)


def _is_quiet(unbegun: Search) -> bool:
    """Whether the believed model leaves hardly more than noise, and that with the memory of noise (colour alone may
    also be a misfit of fast motion), or as instruments err beside it."""
    fit = unbegun.fit
    return nearly_noise(fit) and (like_noise(fit) or only_instruments(unbegun.case, unbegun.amendment, fit))


def take_at_last(search: Search, unbegun: Search, found: Found, progress: Progress) -> None:
    """The best law that was fitted, where the time was up before any was compared with errors of sensors, if at all."""
    if found.laws and all(f.ranked.attachment.variable for f in search.findings):
        _take(search, unbegun, found, progress)


def _one_by_one(
    search: Search, unbegun: Search, found: Found, pair: tuple[Place, Place] | None, library: Library,
    progress: Progress,
) -> None:  # fmt: skip
    """A law at one place, then others beside it; and two at once where a `pair` of little evidence is left to try."""
    add_laws(found, search.case, unbegun.amendment, unbegun.fit, progress, wide=True)
    taken = bool(found.laws) and _take(search, unbegun, found, progress)
    physics = any(not f.ranked.attachment.variable for f in search.findings) and not search.amendment.trackers
    long = taken and not found.short and bool(found.single)
    whole = bool(search.findings) and theirs(search.fit) and not long
    two = None if whole or pair is None else _two(unbegun, found, pair, library, progress)
    if taken or physics:
        go_on(search, library, progress)
    if long:
        apart(search, unbegun, found.single[0], library, progress)
    if two is not None:
        take_if_less(search, two, unbegun.fit)


def _beside_error(
    search: Search, unbegun: Search, found: Found, pair: tuple[Place, Place] | None, library: Library,
    progress: Progress,
) -> bool:  # fmt: skip
    """Whether a law beside an error of a sensor leaves noise, where these tell more than efforts at two places do."""
    if not found.sites or not _is_left(search, found):
        return False
    told = pair[1].log if pair else found.null + max(s.gain for s in found.sites)
    several = pair is None or any(is_family(p.site) for p in pair)
    sensor = to_be_left_out(found, told, progress, lambda site: several or not is_family(site))
    trial = sensor and beside_error(unbegun, sensor, library, progress)
    return trial is not None and take_if_less(search, trial, unbegun.fit) and theirs(search.fit)


def _two(
    unbegun: Search, found: Found, pair: tuple[Place, Place], library: Library, progress: Progress
) -> Search | None:  # fmt: skip
    two = two_places(unbegun, pair, next(iter(found.laws), None), library, progress)
    if two is not None:
        find_long_anew(two, library, progress)
    return two


def _pair(search: Search, found: Found, progress: Progress) -> tuple[Place, Place] | None:
    """The two places whose efforts tell more than one does, where something is left to be told."""
    if found.locator is None or not _is_left(search, found):
        return None
    try:
        return paired(found, progress)
    except (NotNumeric, SimulationError, np.linalg.LinAlgError):
        return None


def _is_left(search: Search, found: Found) -> bool:
    """Whether what the search has found leaves more than noise, and so does a short law at the best place."""
    short = bool(found.laws) and found.short and theirs(found.laws[0].fit)
    return not short and not theirs(search.fit)


def _take(search: Search, unbegun: Search, found: Found, progress: Progress) -> bool:
    base, law = unbegun.fit, found.laws[0]
    correlation = common_correlation([law.fit, search.fit])
    ranked = [Ranked(c, c.fit, score(c, base, correlation)) for c in _one_a_place(found.laws)]
    gain = ranked[0].score
    if max(gain, told_by_data(law, base, correlation)) > -MIN_GAIN:
        left(said(law), "comparison", "parameters beyond what is believed of them could say as much", cost=gain)
        return False
    if search.findings and not _better(search, unbegun, law, gain, correlation):
        _tie(search, ranked[0], gain - _score_of(search, unbegun, correlation), found)
        left(said(law), "comparison", "not clearly better than what was found in the catalogue", cost=gain)
        return False
    progress("what the law says of recordings left out")
    if not _tells(unbegun, ranked[0], correlation):
        left(said(law), "unseen", UNTOLD, cost=gain)
        return False
    after = try_judge(law.machine, law.fit.point)
    if after is None:
        return False
    confidences(ranked)
    note_losers(ranked)
    search.findings[:] = [Finding(ranked[0], Naming(ranked, []), unbegun.judgement, after)]
    search.take([law.attachment], law.fit, after)
    search.reason = ""
    return True


def _tie(search: Search, law: Ranked, more: float, found: Found) -> None:
    """A law that costs `more` than an error of a sensor, by less than a tie, as a rival of that error; what is off in a
    reading that changes no state is the same as its sensor."""
    same = {s.location for s in found.sites if s.place is not None and s.place.reading}
    finding = search.findings[0]
    alone = len(search.findings) == 1 and finding.ranked.attachment.variable
    if alone and more < TIE and law.attachment.location not in same:
        finding.naming.ranked.append(replace(law, score=finding.ranked.score + more))
        finding.naming.ranked.sort(key=lambda r: r.score)
        confidences(finding.naming.ranked)


def _better(search: Search, unbegun: Search, law: Candidate, gain: float, correlation: dict[str, float]) -> bool:
    """Whether a law takes the place of findings: of effects in the equations, which have a name and a reason, only
    where it leaves noise, or they leave most of the misfit beside it, and the evidence is clearly for it, or a short
    one for several; of sensors where it is better."""
    before = _score_of(search, unbegun, correlation)
    if all(f.ranked.attachment.variable for f in search.findings):
        return gain < before - TIE
    quiet = nearly_noise(law.fit) or like_noise(law.fit) or excess(law.fit) < HALF * excess(search.fit)
    return gain < before - margin(search, law) and quiet


def _one_a_place(laws: list[Candidate]) -> list[Candidate]:
    best: dict[str, Candidate] = {}
    for law in laws:
        best.setdefault(law.attachment.location, law)
    return list(best.values())


def _score_of(search: Search, unbegun: Search, correlation: dict[str, float]) -> float:
    """Deviance and price of what the search has found, less the believed model's."""
    base = unbegun.fit
    added = {f.name for f in search.fit.estimate.free} - {f.name for f in base.estimate.free}
    return search.fit.deviance(correlation) + price(len(added), base, correlation) - base.deviance(correlation)


def _tells(unbegun: Search, ranked: Ranked, correlation: dict[str, float]) -> bool:
    """Whether a law fitted to some recordings tells the others better than the believed model so fitted does."""
    without = left_out_deviance(unbegun.fit, unbegun.fit, correlation)
    return left_out_deviance(ranked.fit, unbegun.fit, correlation) < without - TIE
