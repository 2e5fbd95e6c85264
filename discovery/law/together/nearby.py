"""What an effect of the catalogue leaves is looked for where it is: where an effort of any course leaves least.

An effect or an error of a sensor can take away no more than an effort of any course does at its place. So where the
efforts at some places leave clearly less than those at others, only effects there, and laws, are tried at first: an
error of a sensor that is tried among all could but stand for what is missing elsewhere.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lacuna.codegen.library.classes import Library
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.efforts.find import INDIFFERENT, Found, alike, places_of, simplest
from lacuna.discovery.efforts.instruments import theirs
from lacuna.discovery.law.together.several import elsewhere, go_on, is_of_form, take_if_less
from lacuna.discovery.naming.search import Search

Progress = Callable[[str], None]


def go_on_nearby(search: Search, library: Library, progress: Progress) -> bool:
    """Add an effect of the catalogue, or laws, where what the findings leave is; whether that is all that was left."""
    found = _places_left(search, library, progress)
    if found is None:
        return False
    trials, near = [], _effects_near(search, found)
    if near:
        trials.append(_copied(search, near))
        trials[0].run(progress, most=len(search.findings) + 1)
    if not trials or not theirs(trials[0].fit):
        trials.append(_copied(search))
        go_on(trials[-1], library, progress, found)
    before, known = search.fit, len(search.findings)
    for trial in (t for t in trials if len(t.findings) > known):
        if take_if_less(search, trial, before):
            search.namings[:] = trial.namings
    return theirs(search.fit)


def _places_left(search: Search, library: Library, progress: Progress) -> Found | None:
    """The places of what is left beside effects in the equations; none where that is another form of what was found."""
    sensors = all(f.ranked.attachment.variable for f in search.findings)
    if sensors or not search.lead.direct or search.amendment.trackers or theirs(search.fit):
        return None
    found = places_of(search.case, search.amendment, search.fit, library, progress)
    efforts = simplest(found.sites)
    return found if efforts and not is_of_form(efforts, elsewhere(search.amendment)) else None


def _effects_near(search: Search, found: Found) -> frozenset[str]:
    """Where, of the catalogue's locations, an effort leaves hardly more than at the best place; sensors among them."""
    best = simplest(found.sites)[0]
    near = [s for s in found.sites if alike(s, best) or best.gain - s.gain < INDIFFERENT]
    effects = enumerate_attachments(search.case, search.amendment.structure, search.effects, search.amendment)
    locations = {a.location for a in effects}
    return frozenset(n for n in locations if any(s.place.named(n) if s.place else s.location == n for s in near))


def _copied(search: Search, near: frozenset[str] | None = None) -> Search:
    return replace(search, findings=[*search.findings], namings=[*search.namings], exhausted=False, near=near)
