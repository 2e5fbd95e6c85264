"""The two places at which something is missing: each the best beside an effort of any course at the other one.

Places are taken in turn, each the best beside the other, until none moves: the evidence of the two rises with every
turn.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from lacuna.discovery.efforts.find import Found, alike, is_family, simplest
from lacuna.discovery.efforts.guide import guide
from lacuna.discovery.efforts.instruments import NATS
from lacuna.discovery.efforts.law_at import TRIED
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.efforts.located import Locator, Site
from lacuna.discovery.fit.evidence import LEFT
from lacuna.discovery.law.law_screen import Proposal

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
