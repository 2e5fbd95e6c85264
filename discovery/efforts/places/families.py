"""Places that are elements of one array: what is missing at one may be missing at all.

Instances of a class that stand by themselves are none: a law that holds in all of them at once may be short for what is
missing at one, and at another.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
import re

from lacuna.discovery.efforts.places.sites import Site

_INDEX = re.compile(r"\[[^\]]*\]")


def families(sites: Sequence[Site], acting: Iterable[int]) -> list[tuple[Site, tuple[int, ...]]]:
    """(a place that is all of a family, the numbers of these) of places that are `acting` and differ by an index."""
    of: dict[tuple, dict[str, int]] = {}
    for k in acting:
        if (found := _membership(sites[k])) is not None:
            of.setdefault(found[0], {}).setdefault(found[1], k)
    return [
        (_every([sites[k] for k in own.values()], tuple(own)), tuple(own.values()))
        for own in of.values() if len(own) > 1
    ]  # fmt: skip


def _every(parts: list[Site], members: tuple[str, ...]) -> Site:
    return Site("every", _label(members[0]), parts=tuple(parts), members=members, term=_whole([p.term for p in parts]))


def _whole(terms: list[str]) -> str:
    """What is added to all equations of an array or a loop, with @ for an array of what they lack; @ where each has a
    text of its own."""
    loop = re.fullmatch(r"\(if (\w+) == 1 then @ else 0\)", terms[0])
    if loop and all(t == f"(if {loop[1]} == {k} then @ else 0)" for k, t in enumerate(terms, 1)):
        return f"@[{loop[1]}]"
    rows = ("{" + ", ".join("@" if n == k else "0" for n in range(len(terms))) + "}" for k in range(len(terms)))
    return "{@}" if all(map(str.__eq__, terms, rows)) else "@"


def _membership(site: Site) -> tuple[tuple, str] | None:
    """(family, member) of a site: of equations by what they say, of components by where they stand."""
    if site.kind == "equation":
        named, key = site.left if site.term != "@" else site.instance, (site.kind, site.span)
    elif site.kind in ("node", "branch"):
        named, key = site.left if site.kind == "node" else site.label, (site.kind, site.port.flow)
    else:
        return None
    return ((*key, _INDEX.sub("[:]", named)), named) if len(_INDEX.findall(named)) == 1 else None


def _label(member: str) -> str:
    return re.sub(r"^der\((.*)\)$", r"\1", _INDEX.sub("[:]", member))


def meant(name: str, here: str, there: str) -> str:
    """What a name that is said of one element of an array is of another one."""
    return name.replace(_INDEX.search(here)[0], _INDEX.search(there)[0])


def said_of_all(text: str, members: Sequence[str]) -> str:
    """A text about the first element with `:` for its index."""
    return text.replace(_INDEX.search(members[0])[0], "[:]") if members else text


def is_shared(name: str, here: str) -> bool:
    """Whether a name can be said of every element: it has no index but this one's own."""
    index = _INDEX.search(here)[0]
    return all(found == index for found in _INDEX.findall(name))
