"""Places that the data can tell apart, and what they are called."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
import re

import numpy as np

from lacuna.discovery.efforts.latent.along import Along
from lacuna.discovery.efforts.places.sites import Site

ORDER = {"node": 0, "equation": 1, "branch": 2, "edge": 3, "signal": 4, "exchange": 5, "parameter": 6, "input": 7}


@dataclass(frozen=True)
class Place:
    """Sites that the data cannot tell apart, the one that an amendment uses first; `columns` is its input's. `other`
    are those of them where the same is done by an effort of another course: a law may be short in the one and long in
    the other (the command of a valve, and what flows through it). So is an input, whose laws are told of it; where it
    enters in proportion they read `only` the input, all other laws being the same in the balance. What changes no
    state is a `reading`: that is off there, or its sensor, which is the same. A family of places (elements of an
    array), where the same law holds in all, is a place of its own with the `columns` of them all; one course in all
    of them may be what none of the others is (`as_one`)."""

    location: str
    sites: tuple[Site, ...]
    columns: tuple[int, ...]
    unit: str
    other: tuple[Place, ...] = ()
    only: str = ""
    reading: bool = False
    as_one: bool = False

    def named(self, location: str) -> bool:
        """Whether a law at this place may have that location."""
        return location in (self.location, *(o.location for o in self.other))


def told_apart(places: list[Place]) -> list[Place]:
    """The places, those that one state would name told apart: it names the only node or balance of its own. Others are
    named by the component that has most ports there (either end of a shaft whose twist is a state) or by what their
    equation says. Two of one name could not both be what is missing."""
    names = [p.location for p in places]
    return [_renamed(p, _own_name(p, names)) if _is_second(p, places) else p for p in places]


def _is_second(place: Place, places: list[Place]) -> bool:
    """Whether another place has as good a right to its name: a better one, where that is of the component itself."""
    site, same = place.sites[0], [p for p in places if p.location == place.location and p is not place]
    if (own := _is_of(place)) != any(map(_is_of, same)):
        return not own
    others = [p.sites[0].kind for p in same]
    joins = site.kind == "node" and site.left != "" and "branch" in others  # a spring, to which a mass is joined
    return joins or any(ORDER[kind] <= ORDER[site.kind] for kind in others)


def _is_of(place: Place) -> bool:
    """Whether it is past a component of its name, or in an equation of that."""
    return any(place.location in ((s.label,) if s.kind == "branch" else (s.instance,)) for s in place.sites)


def _own_name(place: Place, taken: list[str]) -> str:
    site, name = place.sites[0], ""
    if site.kind == "node":
        owners = [e.rpartition(".")[0] for s in place.sites if s.kind == "node" for e in s.ends]
        free = [owner for owner in dict.fromkeys(owners) if owner not in taken] or owners
        name = site.left or max(free, key=owners.count)
    elif site.kind == "equation":
        name = own_name(site)
    return name if re.fullmatch(r"[\w.\[\]]+", name) and name not in taken else place.location


def own_name(site: Site) -> str:
    """What an equation says something of."""
    name = site.label.replace(": ", ".", 1) if site.instance else site.label
    first = re.search(r"\bder\(([\w.]+)\)", site.label)  # its own coordinate, where masses are coupled
    return site.left or (first[1] if first and not site.instance else name.partition("=")[0].strip())


def name_there(site: Site, location: str) -> str:
    """What a place of that name is called where something is done at one of its sites: an input and an equation of
    another component have names of their own, a coefficient of another component that of this, and any where nothing of
    that name is in its equations."""
    if site.kind == "input":
        return site.label
    if site.kind in ("equation", "parameter") and site.instance and not f"{location}.".startswith(f"{site.instance}."):
        return own_name(site) if site.kind == "equation" else site.instance
    read = rf"(?<![\w.]){re.escape(location)}(?![\w.])"
    alone = site.kind == "parameter" and "." not in site.label
    return site.label if alone and not any(re.search(read, part.label) for part in site.parts) else location


def touches(site: Site, location: str) -> bool:
    """Whether a site is in the balance of a state, or joins a component, of that name."""
    if site.kind == "equation":
        return f"der({location})" in (site.left or site.label) or site.instance == location
    return any(end.rpartition(".")[0] == location for end in site.ends)


def adjoins(one: Site, other: Site) -> bool:
    """Whether two sites are at one component, by ports that carry the same: a force in a damper, on what it holds."""
    if one.port and other.port:
        same = (one.port.flow, one.port.potential) == (other.port.flow, other.port.potential)
        return same and bool(_joined(one) & _joined(other))
    return any(a.instance and a.instance in _joined(b) for a, b in ((one, other), (other, one)))


def _joined(site: Site) -> set[str]:
    """The components that are joined there."""
    return {owner for end in site.ends if (owner := end.rpartition(".")[0])}


def size_of(name: str, along: Sequence[Along]) -> float:
    """RMS of a variable along runs; 0 where there is none of that name."""
    courses = [np.atleast_1d(a.values[name]) for a in along if name in a.values]
    return float(np.sqrt(np.mean(np.concatenate(courses) ** 2))) if courses else 0.0


def weightiest(order: list[int], sites: Sequence[Site], weights: np.ndarray) -> list[int]:
    """Sites alike, of those that are one equation in several instances that first whose value does most: of two
    resistors in series what is off is sooner in the larger one."""
    order, kind_of = list(order), [(s.kind, s.span) for s in sites]
    for kind in dict.fromkeys(kind_of[k] for k in order if sites[k].instance):
        slots = [n for n, k in enumerate(order) if kind_of[k] == kind]
        for n, k in zip(slots, sorted((order[n] for n in slots), key=lambda k: -weights[k]), strict=True):
            order[n] = k
    return order


def _renamed(place: Place, name: str) -> Place:
    others = (replace(o, location=name) if o.location == place.location else o for o in place.other)
    return replace(place, location=name, other=tuple(others))
