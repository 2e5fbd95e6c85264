"""The best law at one place: screened, fitted in a race, varied, simplified."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.trace import looking
from lacuna.discovery.efforts.guide import Guided, guide
from lacuna.discovery.efforts.instruments import is_colour
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.laws.begun import begun_at
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.efforts.laws.variants import varied
from lacuna.discovery.efforts.located import Locator, Site
from lacuna.discovery.fit.evidence import astray, common_correlation, settled
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.lead import joined
from lacuna.discovery.fit.solver.side_by_side import in_threads
from lacuna.discovery.law.empirical_law import race, simplified, unfitted
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.naming.comparison import TIE, note_laws, rival_score
from lacuna.discovery.naming.race import NEAR
from lacuna.discovery.naming.screen import Candidate
from lacuna.runtime import SimulationError

TRIED = 3  # places at most at which laws are fitted, and laws of one group of terms there, and of two

Progress = Callable[[str], None]


class LawsAt:
    """The best law at a place, looked for a round of proposals at a time: laws of one group of terms come first."""

    def __init__(
        self, case: Case, amendment: Amendment, base: Fit, locator: Locator, site: Site, progress: Progress,
        wide: bool = False, short: bool = False,
    ):  # fmt: skip
        self.case, self.amendment, self.base, self.site, self.progress = case, amendment, base, site, progress
        self.best: Proposal | None = None
        self.ended = False
        self._single: Proposal | None = None
        self._begun: list[Candidate | None] = []
        self._fitted: list[Proposal] = []
        self._offered = _offered(locator, site, progress, wide, short)

    @property
    def settled(self) -> bool:
        """Whether the best law leaves noise, or what instruments may be off by beside it."""
        return self.best is not None and _settled(self.best.candidate.fit)

    def go_on(self) -> bool:
        """Fit the laws of one more round; whether there was one."""
        looking(f"a law at {self.site.location}")
        offered = next(self._offered, None)
        if offered is None:
            return False
        tried, guided = offered
        case, amendment, base = self.case, self.amendment, self.base
        for proposal in tried:
            self.progress(f"fitting a law at {self.site.location}: {proposal.law.text()}")
        begun = in_threads(lambda p: begun_at(case, amendment, base, p, guided.point), tried)
        for proposal, candidate in zip(tried, begun, strict=True):
            proposal.candidate = candidate
        self._begun += begun
        started = [c for c in begun if c is not None]
        race(case, base, started, self.best and self.best.candidate)
        if self.best is None:
            _join(case, base, started, guided)
        tried = [p for p in (self.best, *tried) if p is not None and p.candidate is not None and p.candidate.fit]
        self._fitted += tried
        self.best = self._best_of(tried)
        return True

    def _best_of(self, tried: list[Proposal]) -> Proposal | None:
        """The best of fitted laws and, where none leaves noise, of variants of those still in the race."""
        best, base = _best(tried, self.base), self.base
        if best is not None and not settled(best.candidate.fit):
            near = _near(tried, best, base)
            best = _best([best, *(v for law in near for v in _varied(self.case, self.amendment, base, law))], base)
        if best is not None and len(best.law.groups) > 1:
            several = [p for p in tried if len(p.law.groups) > 1]
            return _shortest([*([self._single] if self._single else []), *several], best, base)
        self._single = best
        return best

    def end(self) -> tuple[Proposal | None, Candidate | None]:
        """The best law, without what it does not need; and, where it is of two groups of terms that are not a level and
        one term, the best of one. What it was screened along is wanted no more."""
        self.ended = True
        self._offered.close()
        note_laws(self._begun, self.best and self.best.candidate, self.base)
        if self.best is None:
            return None, None
        best, single = _in_its_balance(self._fitted, self.best, self.base, self.site.location), self._single
        apart = best is not single and best.law.terms > 1
        best = simplified(self.case, self.amendment, self.base, best)
        return best, single.candidate if apart and single else None


def _settled(fit: Fit) -> bool:
    return settled(fit) or is_colour(fit)


def _near(fitted: list[Proposal], best: Proposal, base: Fit) -> list[Proposal]:
    """The best law and those still in the race with it: which of them has the right form, their variants say."""
    correlation = best.candidate.fit.correlation()
    least = rival_score(best.candidate, base, correlation)
    return [p for p in fitted if rival_score(p.candidate, base, correlation) < (1 - NEAR) * least]


def _varied(case: Case, amendment: Amendment, base: Fit, best: Proposal) -> list[Proposal]:
    """A fitted law's variants, fitted from there side by side."""
    found, point = varied(best), best.candidate.fit.point
    begun = in_threads(lambda p: unfitted(case, amendment, base, p.law, p.start, point), found)
    found = [replace(p, candidate=c) for p, c in zip(found, begun, strict=True) if c is not None]
    race(case, base, [other.candidate for other in found], best.candidate)
    return [other for other in found if other.candidate.fit is not None]


def _join(case: Case, base: Fit, laws: list[Candidate], guided: Guided) -> None:
    """The first law again, by multiple shooting along what it was screened on, where every one's fit has gone astray:
    what is found there to first order may be out of reach of a run from the beginning."""
    if not laws or any(not astray(law.fit) for law in laws if law.fit is not None):
        return
    first = laws[0]
    courses = {r.piece: p.along.values for r, p in zip(case.fit, guided.pieces, strict=True)}
    free = [*base.estimate.free, *first.free]
    found = joined(first.machine, case, base.noise, free, base.fixed, first.start, courses)
    whole = found is not None and found.machine is first.machine
    if whole and (first.fit is None or found.deviance() < first.fit.deviance()):
        first.fit = found


def _offered(
    locator: Locator, site: Site, progress: Progress, wide: bool, short: bool
) -> Iterator[tuple[list[Proposal], Guided]]:  # fmt: skip
    """Laws to be fitted at a place, as they are asked for, and what they were screened along."""
    try:
        guided = guide(locator, site)
        progress(f"screening laws at {site.location}")
        for offered in proposals(locator, site, guided, TRIED, apart=wide, short=short):
            yield offered, guided
    except (NotNumeric, SimulationError, np.linalg.LinAlgError):
        return


def _best(fitted: list[Proposal], base: Fit) -> Proposal | None:
    return min(fitted, key=_scorer(fitted, base)) if fitted else None


def _shortest(fitted: list[Proposal], best: Proposal, base: Fit) -> Proposal:
    """Of laws that the data does not tell from the best one the best of the fewest numbers."""
    scored = _scorer([*fitted, best], base)
    untold = [p for p in (*fitted, best) if scored(p) < scored(best) + TIE]
    return min(untold, key=lambda p: (len(p.candidate.free), scored(p)))


def _in_its_balance(fitted: list[Proposal], best: Proposal, base: Fit, location: str) -> Proposal:
    """Of laws of no more numbers that the data does not tell from the best one that in the place's own balance: an
    input is off only where that says more (what is behind a coil's voltage is behind its current)."""
    own = [p for p in fitted if p.law.site.location == location and len(p.candidate.free) <= len(best.candidate.free)]
    if best.law.site.location == location or not own:
        return best
    scored = _scorer([best, *own], base)
    first = min(own, key=scored)
    return first if scored(first) < scored(best) + TIE else best


def _scorer(fitted: list[Proposal], base: Fit) -> Callable[[Proposal], float]:
    """Deviance and price of a law, samples discounted alike."""
    correlation = common_correlation(p.candidate.fit for p in fitted)
    return lambda p: rival_score(p.candidate, base, correlation)
