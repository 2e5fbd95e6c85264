"""Places that are elements of one array, or one equation in several instances of its class: what is missing at one may
be missing at all.

Members are told apart by their names: an index, or the path of the instance.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
import re

from lacuna.discovery.efforts.places.sites import Site

_INDEX = re.compile(r"\[[^\]]*\]")


def families(sites: Sequence[Site], acting: Iterable[int]) -> list[tuple[Site, tuple[int, ...]]]:
    """(a place that is all of a family, the numbers of these) of places that are `acting` and differ by an index or an
    instance."""
    of: dict[tuple, dict[str, int]] = {}
    for k in acting:
        if (found := _membership(sites[k])) is not None:
            of.setdefault(found[0], {}).setdefault(found[1], k)
    return [
        (_every([sites[k] for k in own.values()], tuple(own)), tuple(own.values()))
        for own in of.values() if len(own) > 1
    ]  # fmt: skip


def _every(parts: list[Site], members: tuple[str, ...]) -> Site:
    return Site("every", _label(members), parts=tuple(parts), members=members, term=_whole([p.term for p in parts]))


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
        if site.term == "@" and named and "[" not in named:
            return key, named
    elif site.kind in ("node", "branch"):
        named, key = site.left if site.kind == "node" else site.label, (site.kind, site.port.flow)
    else:
        return None
    return ((*key, _INDEX.sub("[:]", named)), named) if len(_INDEX.findall(named)) == 1 else None


def _label(members: Sequence[str]) -> str:
    if not _INDEX.search(members[0]):
        return ", ".join(members)
    return re.sub(r"^der\((.*)\)$", r"\1", _INDEX.sub("[:]", members[0]))


def meant(name: str, here: str, there: str) -> str:
    """What a name that is said of one member is of another one."""
    index = _INDEX.search(here)
    return name.replace(index[0], _INDEX.search(there)[0]) if index else _inside(here).sub(there, name)


def said_of_all(text: str, members: Sequence[str]) -> str:
    """A text about the first element with `:` for its index; of instances it is said of the first."""
    index = _INDEX.search(members[0]) if members else None
    return text.replace(index[0], "[:]") if index else text


def is_shared(name: str, members: Sequence[str]) -> bool:
    """Whether a name can be said of every member: it has no index but the first one's own, or is not inside of a
    further instance."""
    index = _INDEX.search(members[0])
    if index:
        return all(found == index[0] for found in _INDEX.findall(name))
    return not any(_inside(other).search(name) for other in members[1:])


def _inside(instance: str) -> re.Pattern[str]:
    """Where a name goes into an instance."""
    return re.compile(rf"(?<![\w.\]]){re.escape(instance)}(?=\.)")
