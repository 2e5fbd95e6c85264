"""Two laws at two places, found together: each is screened beside an effort of any course at the other place.

Where two things are missing, a law at one place is sought in what both leave, and the first that is found stands for
both as well as it can, at a third place and of a form that neither has. An effort of any course at the other place has
no form; beside it each law is screened as if it were alone. Places are taken in turn, each the best beside the other,
until none moves: the evidence of the two rises with every turn.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from lacuna.discovery.catalogue.attachment import values_of
from lacuna.discovery.catalogue.trace import left, looking
from lacuna.discovery.efforts.find import Found, alike, is_family, simplest
from lacuna.discovery.efforts.guide import guide
from lacuna.discovery.efforts.instruments import NATS
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.law_at import TRIED
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.efforts.located import Locator, Site
from lacuna.discovery.fit.evidence import LEFT, common_correlation, excess, nearly_noise, pays
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.side_by_side import apart
from lacuna.discovery.law.empirical_law import fitted_law, simplified, unmoved
from lacuna.discovery.law.law import attach, component_of
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.law.together.several import finding, paid
from lacuna.discovery.naming.comparison import MIN_GAIN, price, score, told_by_data
from lacuna.discovery.naming.judge import try_judge
from lacuna.discovery.naming.left_out import left_out
from lacuna.discovery.naming.race import HALF
from lacuna.discovery.naming.screen import Candidate
from lacuna.discovery.naming.search import UNTOLD, Search
from lacuna.runtime import SimulationError

Progress = Callable[[str], None]


@dataclass
class Place:
    """A place with the locator in which it was the best beside the other one; `sites` are all those of that locator."""

    locator: Locator
    site: Site
    sites: list[Site]

    def __post_init__(self) -> None:
        self.offered = self._screened()

    def _screened(self) -> Iterator[list[Proposal]]:
        """Laws of one group of terms, the most telling first, then of two; started where the efforts at both lead."""
        guided = guide(self.locator, self.site)
        for offered in proposals(self.locator, self.site, guided, TRIED, strained=False):
            for proposal in offered:
                proposal.point = guided.point
            yield offered

    @property
    def log(self) -> float:
        """Log evidence of an effort here beside the other one."""
        return self.locator.null + self.site.gain

    def alike(self, other: Site) -> list[Place]:
        """Places at which an effort leaves hardly more than at this one: of two that are coupled stiffly a smooth
        effort, which takes no edge as sharply as a law does, may tell the wrong one by any number of nats."""
        near = [s for s in self.sites[:TRIED] if s is not self.site and s.location != other.location]
        return [Place(self.locator, s, self.sites) for s in near if alike(s, self.site)]


@dataclass
class Both:
    """Two laws as they were fitted together; the candidate of either is the model with both."""

    one: Proposal
    two: Proposal
    fit: Fit

    def said(self) -> str:
        """Both in a line, with their numbers."""
        return " and ".join(attach(p.law).said(self.fit.point) for p in (self.one, self.two))


def two_places(
    unbegun: Search, pair: tuple[Place, Place], single: Candidate | None, progress: Progress
) -> Search | None:
    """A search that has found two laws at two places; None where they leave more than noise, and most of what `single`
    leaves, the best law at one place, or do not pay."""
    joining = Joining(unbegun, progress)
    looking(f"laws at {pair[0].site.location} and {pair[1].site.location}")
    try:
        best = joining.laws(pair, single)
        best = joining.elsewhere(best, pair) if best is not None else None
    except (NotNumeric, SimulationError, np.linalg.LinAlgError):
        return None
    finally:
        for place in pair:
            place.offered.close()  # what they were screened along is wanted no more
    trial = best and joining.found(best)
    if trial is None:
        return None
    base, correlation = unbegun.fit, trial.fit.correlation()
    if paid(trial, base, correlation) > base.deviance(correlation) - MIN_GAIN:
        return None
    if pays(left_out(unbegun.case, base), left_out(unbegun.case, trial.fit), unbegun.floor):
        return trial
    left(best.said(), "unseen", UNTOLD)
    return None


def paired(found: Found, progress: Progress) -> tuple[Place, Place] | None:
    """The two places whose efforts together have the most evidence; None where one has as much. A family has an effort
    in each of its members: where two places outside of families leave as little, the two it is."""
    sites = simplest(found.sites)
    best = _paired(found, sites, progress)
    alone = [s for s in sites if not is_family(s)]
    if best is None or not alone or not any(is_family(p.site) for p in best):
        return best
    fewer = _paired(found, alone, progress, lambda site: not is_family(site))
    return fewer if fewer is not None and _left(found, fewer) <= LEFT**2 * _left(found, best) else best


def _left(found: Found, pair: tuple[Place, Place]) -> float:
    """Share of the misfit that efforts at both places leave."""
    one, two = pair
    alone = next(s for s in found.sites if s.location == one.site.location)
    return (1.0 - alone.explains) * (1.0 - two.site.explains)


def _paired(
    found: Found, sites: list[Site], progress: Progress, among: Callable[[Site], bool] = lambda site: True
) -> tuple[Place, Place] | None:
    """The best of these places, and the best beside it, in turn until none moves."""
    if not sites:
        return None
    one = Place(found.locator, sites[0], sites)
    known: set[str] = set()
    while True:
        progress(f"locating beside {one.site.location}")
        two = _beside(found.locator, one, among)
        if two is None or two.site.gain < NATS:
            return None
        if two.site.location in known:
            return one, two
        known |= {one.site.location}
        one = two


def _beside(locator: Locator, place: Place, among: Callable[[Site], bool]) -> Place | None:
    """The best place of some beside an effort at another one."""
    there = locator.beside(place.locator, place.site)
    sites = [s for s in simplest([s for s in there.ranked() if s.location != place.site.location]) if among(s)]
    return Place(there, sites[0], sites) if sites else None


class Joining:
    """Laws at two places, fitted together on top of what a search that has found nothing has fitted."""

    def __init__(self, unbegun: Search, progress: Progress) -> None:
        self.unbegun, self.progress = unbegun, progress
        self.case, self.amendment, self.base = unbegun.case, unbegun.amendment, unbegun.fit

    def laws(self, pair: tuple[Place, Place], single: Candidate | None) -> Both | None:
        """The best two laws, of one group of terms each; of two where these leave more than noise, and yet less than a
        `single` one at one place does. Simplified, each beside the other; None where all leave more than noise, and
        most of what that one leaves."""
        best: Both | None = None
        for ones, twos in zip(pair[0].offered, pair[1].offered, strict=False):
            best = self._best(ones, twos, best)
            if best is not None and nearly_noise(best.fit):
                return self._simplified(best)
            if best is None or (single and self._is_less(single, best)):
                return None
        most = best is None or single is None or excess(best.fit) > HALF * excess(single.fit)
        return None if most else self._simplified(best)

    def _is_less(self, single: Candidate, both: Both) -> bool:
        correlation = common_correlation([single.fit, both.fit])
        return score(single, self.base, correlation) < self._paid(both, correlation) - self.base.deviance(correlation)

    def elsewhere(self, best: Both, pair: tuple[Place, Place]) -> Both:
        """The same laws' best at places alike, one law after the other."""
        for place, other in (pair, pair[::-1]):
            for near in place.alike(other.site):
                kept = best.two if place is pair[0] else best.one
                for law in next(near.offered, []):
                    moved = self._joint(kept, law)
                    if moved is not None:
                        moved = moved if place is pair[1] else Both(moved.two, moved.one, moved.fit)
                        best = self._simplified(moved) if self._better(best, moved) is moved else best
        return best

    def _best(self, ones: list[Proposal], twos: list[Proposal], best: Both | None) -> Both | None:
        """The best of what was the best and of these: each second law beside the first one, each first one beside the
        best second one."""
        if not ones or not twos:
            return best
        first = best.one if best else ones[0]
        for both in apart(lambda two: self._joint(first, two), twos):
            best = self._better(best, both)
        second = best.two if best else twos[0]
        for both in apart(lambda one: self._joint(one, second), ones if first is not ones[0] else ones[1:]):
            best = self._better(best, both)
        return best

    def _better(self, one: Both | None, other: Both | None) -> Both | None:
        """The one with less deviance and price."""
        if one is None or other is None:
            return one or other
        correlation = common_correlation([one.fit, other.fit])
        best, lost = sorted((one, other), key=lambda both: self._paid(both, correlation))
        behind = self._paid(lost, correlation) - self._paid(best, correlation)
        left(lost.said(), "comparison", f"{behind:.1f} behind {best.said()}")
        return best

    def _paid(self, both: Both, correlation: dict[str, float]) -> float:
        added = len(both.fit.estimate.free) - len(self.base.estimate.free)
        picks = both.one.law.pick() + both.two.law.pick()
        return both.fit.deviance(correlation) + price(added, self.base, correlation) + 2 * picks

    def _joint(self, one: Proposal, two: Proposal) -> Both | None:
        """The second law fitted together with the first."""
        sides = [f"{p.law.text()} at {p.law.site.location}" for p in (one, two)]
        self.progress(f"fitting {' and '.join(sides)}")
        beside = unmoved(self.case, self.amendment, self.base, one)
        fitted = beside and fitted_law(self.case, *beside, two.law, two.start, (two.point or {}) | beside[1].point)
        return Both(one, replace(two, candidate=fitted), fitted.fit) if fitted else None

    def _simplified(self, both: Both) -> Both:
        """Both laws without what they do not need, each beside the other."""
        one, two, fit = both.one, both.two, both.fit
        for _ in range(2):
            one, two, fit = self._simpler(_at(two, fit), _at(one, fit)) or (two, one, fit)
        return Both(one, two, fit)

    def _simpler(self, one: Proposal, two: Proposal) -> tuple[Proposal, Proposal, Fit] | None:
        """(the first law, the second without what it does not need beside it, their fit)."""
        both, beside = self._joint(one, two), unmoved(self.case, self.amendment, self.base, one)
        if both is None or beside is None:
            return None
        two = simplified(self.case, *beside, both.two)
        return one, two, two.candidate.fit

    def found(self, both: Both) -> Search | None:
        """A search that has found both; None where either alone says as much as the recordings have to say: what the
        other one then stands for is a parameter that has left its belief."""
        one, two, base, unbegun = both.one, both.two, self.base, self.unbegun
        joint = self._joint(_at(two, both.fit), _at(one, both.fit))
        after = joint and try_judge(joint.two.candidate.machine, joint.fit.point)
        if after is None:
            return None
        own, other = joint.two.candidate, replace(both.two.candidate, fit=joint.fit)
        alone, rest = apart(lambda p: fitted_law(self.case, self.amendment, base, p.law, p.start, p.point), (one, two))
        if not all(_is_needed(c, beside) for c, beside in ((other, alone), (own, rest))):
            return None
        between = (alone and try_judge(alone.machine, alone.fit.point)) or unbegun.judgement
        findings = [
            finding(own, base, unbegun.judgement, between),
            finding(other, alone.fit if alone else base, between, after),
        ]
        trial = replace(unbegun, findings=findings, namings=[])
        trial.take([other.attachment, own.attachment], joint.fit, after)
        return trial


def _is_needed(law: Candidate, beside: Candidate | None) -> bool:
    """Whether a law says more of the recordings than the other one alone, `beside`, does."""
    return beside is None or told_by_data(law, beside.fit, law.fit.correlation()) < -MIN_GAIN


def _at(proposal: Proposal, fit: Fit) -> Proposal:
    """A law that starts where it was fitted together with another one."""
    return replace(proposal, start=values_of(component_of(proposal.law), fit.point), point=fit.point)
