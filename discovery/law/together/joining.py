"""Two laws at two places, found together: each is screened beside an effort of any course at the other place.

Where two things are missing, a law at one place is sought in what both leave, and the first that is found stands for
both as well as it can, at a third place and of a form that neither has. An effort of any course at the other place has
no form; beside it each law is screened as if it were alone. Where the two so found leave more than noise, each is found
anew with the other one in the model.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from lacuna.codegen.library.classes import Library
from lacuna.discovery.catalogue.attachment import values_of
from lacuna.discovery.catalogue.trace import left, looking
from lacuna.discovery.efforts.find import places_of
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.law_at import LawsAt
from lacuna.discovery.fit.evidence import common_correlation, excess, nearly_noise, pays
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.side_by_side import in_threads
from lacuna.discovery.law.empirical_law import fitted_law, simplified, unmoved
from lacuna.discovery.law.law import attach, component_of
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.law.together.pairs import Place
from lacuna.discovery.law.together.several import finding, paid
from lacuna.discovery.naming.comparison import MIN_GAIN, TIE, price, score, told_by_data
from lacuna.discovery.naming.judge import try_judge
from lacuna.discovery.naming.left_out import left_out
from lacuna.discovery.naming.race import HALF
from lacuna.discovery.naming.screen import Candidate
from lacuna.discovery.naming.search import UNTOLD, Search
from lacuna.runtime import SimulationError

Progress = Callable[[str], None]


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
    unbegun: Search, pair: tuple[Place, Place], single: Candidate | None, library: Library, progress: Progress
) -> Search | None:
    """A search that has found two laws at two places; None where they leave more than noise, and most of what `single`
    leaves, the best law at one place, or do not pay."""
    joining = Joining(unbegun, library, progress)
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


class Joining:
    """Laws at two places, fitted together on top of what a search that has found nothing has fitted."""

    def __init__(self, unbegun: Search, library: Library, progress: Progress) -> None:
        self.unbegun, self.library, self.progress = unbegun, library, progress
        self.case, self.amendment, self.base = unbegun.case, unbegun.amendment, unbegun.fit

    def laws(self, pair: tuple[Place, Place], single: Candidate | None) -> Both | None:
        """The best two laws, of one group of terms each; of two where these leave more than noise, and yet less than a
        `single` one at one place does. Simplified, each beside the other; None where all leave more than noise, and
        most of what that one leaves."""
        best: Both | None = None
        for ones, twos in zip(pair[0].offered, pair[1].offered, strict=False):
            found = self._best(ones, twos, best)
            best = found if found is best else self._anew(found)
            if best is not None and nearly_noise(best.fit):
                return self._simplified(best)
            if best is None or (single and self._is_less(single, best)):
                return None
        best = self._anew(best, whole=True)
        most = best is None or single is None or excess(best.fit) > HALF * excess(single.fit)
        return None if most else self._simplified(best)

    def _anew(self, best: Both | None, whole: bool = False) -> Both | None:
        """Each law found anew with the other one in the model, while the two leave more than noise, and clearly less
        each time: an effort of any course, beside which it was screened, takes part of what the right one says. Of one
        group of terms, or of two (the `whole`)."""
        sides: tuple[bool, ...] = (True, False)  # whether it is the first law that is found anew
        while best is not None and not nearly_noise(best.fit):
            before = best
            for first in sides:
                other = self._exchanged(before, first, whole)
                if other is not None and self._better(best, other) is other:
                    best, sides = other, (not first,)
            correlation = common_correlation([best.fit, before.fit])
            if self._paid(best, correlation) > self._paid(before, correlation) - TIE:
                break
        return best

    def _exchanged(self, both: Both, first: bool, whole: bool) -> Both | None:
        """One of the two laws found anew with the other one in the model."""
        kept, old = (both.two, both.one) if first else (both.one, both.two)
        law = self._law_beside(_at(kept, both.fit), old.law.site.location, whole)
        return law and Both(*((law, kept) if first else (kept, law)), law.candidate.fit)

    def _law_beside(self, kept: Proposal, location: str, whole: bool) -> Proposal | None:
        """The best law at a place of the model that has another law."""
        beside = unmoved(self.case, self.amendment, self.base, kept)
        found = beside and places_of(self.case, *beside, self.library, self.progress)
        site = next((s for s in found.sites if s.place and s.place.named(location)), None) if found else None
        if site is None:
            return None
        laws = LawsAt(self.case, *beside, found.locator, site, self.progress)
        while laws.go_on() and whole and not laws.settled:
            pass
        return laws.end()[0]

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
        for both in in_threads(lambda two: self._joint(first, two), twos):
            best = self._better(best, both)
        second = best.two if best else twos[0]
        for both in in_threads(lambda one: self._joint(one, second), ones if first is not ones[0] else ones[1:]):
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
        fitted = partial(fitted_law, self.case, self.amendment, base)
        alone, rest = in_threads(lambda p: fitted(p.law, p.start, p.point), (one, two))
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
