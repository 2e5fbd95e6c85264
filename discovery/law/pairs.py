"""Two laws at two places, found together: each is screened beside an effort of any course at the other place.

Where two things are missing, a law at one place is sought in what both leave, and the first that is found stands for
both as well as it can, at a third place and of a form that neither has. An effort of any course at the other place has
no form; beside it each law is screened as if it were alone. Places are taken in turn, each the best beside the other,
until none moves: the evidence of the two rises with every turn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.efforts.find import LAWS, Found, simplest
from lacuna.discovery.efforts.instruments import NATS
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.efforts.located import Locator, Site
from lacuna.discovery.efforts.numeric import NotNumeric
from lacuna.discovery.fit.evidence import nearly_noise, pays, settled, within_instruments
from lacuna.discovery.fit.fit import Fit, linearised
from lacuna.discovery.fit.machine import try_machine
from lacuna.discovery.law.empirical_law import fitted_law, free_of, simplified
from lacuna.discovery.law.law import attach, component_of
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.law.several import finding, paid
from lacuna.discovery.naming.comparison import MIN_GAIN
from lacuna.discovery.naming.judge import try_judge
from lacuna.discovery.naming.left_out import left_out
from lacuna.discovery.naming.name import Finding
from lacuna.discovery.naming.search import Search
from lacuna.runtime import SimulationError

Progress = Callable[[str], None]


@dataclass
class Place:
    """A place with the locator in which it was the best beside the other one."""

    locator: Locator
    site: Site

    def laws(self) -> list[Proposal]:
        """Laws of one group of terms, the most telling first, then of two; started where the efforts at both lead."""
        guided = self.locator.guided(self.site)
        ones, twos = proposals(self.locator, self.site, guided, LAWS, strained=False)
        offered = [*ones, *twos]
        for proposal in offered:
            proposal.point = guided.point
        return offered


def two_places(unbegun: Search, found: Found, progress: Progress) -> Search | None:
    """A search that has found two laws at two places, where an effort at a second place tells clearly more than one at
    the best place alone does; None where they leave more than noise or do not pay."""
    if found.locator is None or within_instruments(unbegun.fit):
        return None
    try:
        pair = paired(found, progress)
        offered = [place.laws() for place in pair] if pair else []
    except (NotNumeric, SimulationError, np.linalg.LinAlgError):
        return None
    trial = _trial(unbegun, offered, progress) if offered and all(offered) else None
    if trial is None or not nearly_noise(trial.fit):
        return None
    base, correlation = unbegun.fit, trial.fit.correlation()
    if paid(trial, base, correlation) > base.deviance(correlation) - MIN_GAIN:
        return None
    told = pays(left_out(unbegun.case, base), left_out(unbegun.case, trial.fit), unbegun.floor)
    return trial if told else None


def is_short(finding: Finding) -> bool:
    """Whether a law is of one term: one of two ends no search, since its second may stand for what is elsewhere."""
    return sum(p.name.startswith("c_") for p in finding.ranked.attachment.effect.parameters) == 1


def paired(found: Found, progress: Progress) -> tuple[Place, Place] | None:
    """The two places whose efforts together have the most evidence; None where one has as much."""
    efforts = simplest([s for s in found.sites if s.place is not None and s.gain > 0])
    if not efforts:
        return None
    one = Place(found.locator, efforts[0])
    known: set[str] = set()
    while True:
        progress(f"locating beside {one.site.location}")
        two = _beside(found.locator, one)
        if two is None or two.site.gain < NATS:
            return None
        if two.site.location in known:
            return one, two
        known |= {one.site.location}
        one = two


def _beside(locator: Locator, place: Place) -> Place | None:
    """The best place beside an effort at another one."""
    there = locator.beside(place.locator, place.site)
    sites = [s for s in there.ranked() if s.place is not None and s.location != place.site.location]
    sites = simplest([s for s in sites if s.gain > 0])
    return Place(there, sites[0]) if sites else None


def _trial(unbegun: Search, offered: list[list[Proposal]], progress: Progress) -> Search | None:
    """A search that has found the best law of each list, fitted together."""
    case, amendment, base = unbegun.case, unbegun.amendment, unbegun.fit
    ones, twos = offered
    first, best = ones[0], None
    for two in twos:
        best = _better(best, _joint(case, amendment, base, first, two, progress))
        if best is not None and settled(best.candidate.fit):
            break
    for other in ones[1:]:
        if best is not None and settled(best.candidate.fit):
            break
        trial = _joint(case, amendment, base, other, best or twos[0], progress)
        if trial is not None and _better(best, trial) is trial:
            first, best = other, trial
    if best is None:
        return None
    return _found(unbegun, first, best)


def _better(one: Proposal | None, other: Proposal | None) -> Proposal | None:
    if one is None or (other is not None and other.candidate.fit.deviance() < one.candidate.fit.deviance()):
        return other
    return one


def _joint(
    case: Case, amendment: Amendment, base: Fit, one: Proposal, two: Proposal, progress: Progress
) -> Proposal | None:  # fmt: skip
    """The second law fitted together with the first."""
    progress(f"fitting {one.law.text()} at {one.law.site.location} and {two.law.text()} at {two.law.site.location}")
    with_one = _with(case, amendment, base, one)
    if with_one is None:
        return None
    candidate = fitted_law(case, *with_one, two.law, two.start, two.point | with_one[1].point)
    return None if candidate is None else replace(two, candidate=candidate)


def _with(case: Case, amendment: Amendment, base: Fit, law: Proposal) -> tuple[Amendment, Fit] | None:
    """(the model with a law where that starts, as a fit that does not move); None where it cannot be simulated."""
    attachment = attach(law.law)
    own = replace(amendment, attachments=[*amendment.attachments, attachment])
    machine, _ = try_machine(case, own, base.machine)
    if machine is None:
        return None
    free = [*base.estimate.free, *free_of(law.law, attachment, law.start)]
    point = (law.point or base.point) | {attachment.full_name(n): v for n, v in law.start.items()}
    there = linearised(machine, case.fit, base.noise, free, base.fixed, point)
    return None if there is None else (own, there)


def _found(unbegun: Search, one: Proposal, two: Proposal) -> Search | None:
    """Both laws simplified, each beside the other, and judged."""
    case, amendment, base = unbegun.case, unbegun.amendment, unbegun.fit
    two = _simpler(case, amendment, base, one, two)
    one = two and _simpler(case, amendment, base, _at(two, two.candidate.fit), _at(one, two.candidate.fit))
    alone = one and fitted_law(case, amendment, base, one.law, one.start, one.point)
    after = one and try_judge(one.candidate.machine, one.candidate.fit.point)
    if after is None:
        return None
    between = (alone and try_judge(alone.machine, alone.fit.point)) or unbegun.judgement
    findings = [
        finding(one.candidate, base, unbegun.judgement, between),
        finding(replace(two.candidate, fit=one.candidate.fit), alone.fit if alone else base, between, after),
    ]
    trial = replace(unbegun, findings=findings, namings=[])
    trial.take([two.candidate.attachment, one.candidate.attachment], one.candidate.fit, after)
    return trial


def _simpler(case: Case, amendment: Amendment, base: Fit, one: Proposal, two: Proposal) -> Proposal | None:
    """The second law, fitted with the first, without what it does not need."""
    with_one = _with(case, amendment, base, one)
    if with_one is None:
        return None
    candidate = fitted_law(case, *with_one, two.law, two.start, two.point | with_one[1].point)
    return None if candidate is None else simplified(case, *with_one, replace(two, candidate=candidate))


def _at(proposal: Proposal, fit: Fit) -> Proposal:
    """A law that starts where it was fitted together with another one."""
    prefix = f"{component_of(proposal.law)}."
    start = {n.removeprefix(prefix): v for n, v in fit.point.items() if n.startswith(prefix)}
    return replace(proposal, start=start, point=fit.point)
